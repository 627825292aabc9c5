"""An influence that is learned, but makes no difference.

A command is the mean of what the skills that drive an actuator send, weighted by their influence (Eq. 3). With only one
skill that ever drives it the weight cancels: that skill acts fully as long as its influence is above zero. A learned
influence on it is an output that costs weights and blurs the learning of the others. Say `influences Grab at 1`, or let
another skill drive the actuator as well.
"""

from collections import Counter

from mindlang.compiler.diagnostic import Fix
from mindlang.editing.insertion import replace_span
from mindlang.lint.study import Finding, Found, Study

HIERARCHY = """
sensor eye is range_finder at 0 deg
sensor front is range_finder at 0 deg
actuator left_wheel is wheel side left neutral 0.5
actuator claw is gripper neutral 0
master Live
skill Go is rule
  drives left_wheel at 1
skill Shy is rule
  reads eye
  drives left_wheel at eye
skill Grab is rule
  drives claw at 1
skill Live is mlp
  reads eye
  influences Go
  influences Shy
"""
GOOD = f"{HIERARCHY}  influences Grab at 1\n"
BAD = f"{HIERARCHY}  influences Grab\n"


def check(study: Study) -> Found:
    sent = (edge for name in study.active for edge in study.skills[name].edges)
    drivers = Counter(edge.target for edge in sent if edge.to != "skill")
    alone: dict[str, str] = {}  # what moves nothing that other active skills move too, with something that it moves
    for skill in study.children_first:
        moved = [alone.get(edge.target, "") if edge.to == "skill" else edge.target for edge in skill.edges]
        if all(drivers[name] == 1 for name in moved):
            alone[skill.name] = moved[0]
    for skill, edge in study.edges:
        if (
            skill.chooses
            or skill.name not in study.active
            or edge.to != "skill"
            or edge.at is not None
            or edge.target not in alone
        ):
            continue
        message = f"How much influence {skill.name} has on {edge.target} makes no difference, only whether it has any."
        unless = "unless it is to learn when it is on and when off (# noqa)"
        mend, fix = "let another skill drive it, too", None
        if sum(other.at is None for other in skill.edges) > 1:
            mend = f"write influences {edge.target} at 1"
            fix = Fix("Write at 1", (replace_span(edge.fact.span, f"{edge.fact.span.text} at 1"),), is_safe=False)
        hint = f"Nobody else drives {alone[edge.target]}, so its command is the same (Eq. 3): {mend}, {unless}."
        yield Finding(edge.fact.span, message, hint, fix=fix)
