"""Influence that is over what nobody there drives.

`influences Stop over throttle` counts for the throttle alone. Where neither Stop nor a skill below it drives that, the
line does nothing. Name what Stop drives, or take `over` out: then it counts for all.
"""

from mindlang.compiler.hierarchy import with_descendants
from mindlang.compiler.syntax import Influences
from mindlang.lint.study import Finding, Found, Study

PARTS = """
master Live
skill Go is rule
  drives left_wheel at 1
  drives right_wheel at 1
skill Stop is rule
  drives left_wheel at 0.5
skill Live is rule
  influences Go at 1
"""
GOOD = f"{PARTS}  influences Stop over left_wheel at 1\n"
BAD = f"{PARTS}  influences Stop over left_wheel and right_wheel at 1\n"


def check(study: Study) -> Found:
    driven = {skill.name: {edge.target for edge in skill.edges if edge.to != "skill"} for skill in study.mind.skills}
    for _, edge in study.edges:
        if not isinstance(edge.fact, Influences) or not edge.over:
            continue
        moved = {name for skill in with_descendants(study.mind.influences, {edge.target}) for name in driven[skill]}
        for name in (each for each in edge.fact.over or () if each.text not in moved):
            hint = f"Name what it drives: {', '.join(sorted(moved)) or 'nothing'}."
            yield Finding(name.span, f"Neither {edge.target} nor a skill below it drives {name.text}.", hint)
