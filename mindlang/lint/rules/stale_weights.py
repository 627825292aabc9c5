"""A skill whose weights were taught to another declaration of it.

What it reads or sends, or its function, has changed since it was taught, so the weights in the lock no longer fit:
`build`, `run` and `bench` refuse it. Teach it again, or take the change back; `mindc edit` with `--keep-weights` lets
a skill that only reads or influences more go on as before.
"""

from mindlang.lint.examples import LEARNS, LOCK
from mindlang.lint.study import Finding, Found, Study
from mindlang.lock.status import mismatches

GOOD = f"{LEARNS}{LOCK}"
BAD = GOOD.replace("width 3", "width 4").replace("left_wheel |", "left_wheel right_wheel |")


def check(study: Study) -> Found:
    """Skills that the lock knows with another signature; notes on subskills, as `mindc status` has them, are none."""
    for skill in study.graph.skills:
        entry = study.lock.get(skill.name)
        if entry and skill.function.learns and not skill.like and (found := mismatches(study.graph, skill, entry)):
            first = f"Unfreeze {skill.name} first: then " if skill.frozen else ""
            message = f"The weights of {skill.name} are stale: {'; '.join(found)}."
            yield Finding(study.skills[skill.name].span, message, f"{first}mindc train teaches it again.")
