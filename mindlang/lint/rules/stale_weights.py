"""A skill whose weights were taught to another declaration of it.

What it reads or sends, or its function, has changed since it was taught, so the weights in the lock no longer fit:
`build`, `run` and `bench` refuse it. Teach it again, or take the change back; `mindc edit` with `--keep-weights` lets
a skill that only reads or influences more go on as before.
"""

from mindrun.graph.graph import Graph, Skill

from mindlang.lint.study import Finding, Found, Study
from mindlang.lock import Entry
from mindlang.lock.status import mismatches

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
    for skill in study.graph.skills:
        entry = None if skill.like else study.lock.get(skill.name)
        found = _differences(study.graph, skill, entry) if entry else ()
        if found:
            first = f"Unfreeze {skill.name} first: then " if skill.frozen else ""
            hint = f"{first}mindc train teaches it again."
            span = study.mind.names.table["skill"][skill.name].header.name.span
            yield Finding(span, f"The weights of {skill.name} are stale: {'; '.join(found)}.", hint)


def _differences(graph: Graph, skill: Skill, entry: Entry) -> tuple[str, ...]:
    """What of a skill's declaration its weights do not fit: as in `mindc status`, without its notes on subskills."""
    if not skill.function.learns:
        return ()
    return mismatches(graph, skill, entry)
