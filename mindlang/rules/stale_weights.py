"""A skill whose weights were taught to another declaration of it.

What it reads or sends, or its function, has changed since it was taught, so the weights in the lock no longer fit:
`build`, `run` and `bench` refuse it. Teach it again, or take the change back; `mindc edit` with `--keep-weights` lets
a skill that only reads or influences more go on as before.
"""

from mindlang.linting.study import Finding, Found, Study
from mindlang.lock.arrange import arrange
from mindlang.lock.status import Stale, status

HEADER = "# mind lock 1: what has been taught.\n"
LEARNS = """
sensor eye is range_finder at 0 deg
skill Go is mlp
  reads eye
  drives left_wheel
"""
TAUGHT = f"weights {'0' * 64} | task Course master Go generations 9 population 9 seed 1 score 1.0"
GOOD = (f"{LEARNS}-- mind.lock --\n{HEADER}Go is mlp hidden 2 width 3 | reads eye | sends left_wheel | {TAUGHT}\n",)
BAD = (
    f"{LEARNS}-- mind.lock --\n{HEADER}"
    f"Go is mlp hidden 2 width 4 | reads eye | sends left_wheel right_wheel | {TAUGHT}\n",
)


def check(study: Study) -> Found:
    """Skills that the lock knows with another signature."""
    if not study.lock:
        return
    for name, found in status(arrange(study.graph, study.lock), study.lock).items():
        if isinstance(found, Stale):
            skill = study.skills[name]
            first = f"Unfreeze {name} first: then " if skill.frozen else ""
            hint = f"{first}mindc train teaches it again."
            message = f"The weights of {name} are stale: {'; '.join(found.differences)}."
            yield Finding(skill.declaration.header.name.span, message, hint)
