"""An influence that is learned, but makes no difference.

A command is the mean of what the skills that drive an actuator send, weighted by their influence (Eq. 3). With only one
skill that ever drives it the weight cancels: that skill acts fully as long as its influence is above zero. A learned
influence on it is an output that costs weights and blurs the learning of the others. Say `influences Grab at 1`, or let
another skill drive the actuator as well.
"""

from mindlang.compiler.diagnostic import Fix
from mindlang.compiler.model import Edge, Skill
from mindlang.editing.insertion import instead
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
GOOD = (f"{HIERARCHY}  influences Grab at 1\n",)
BAD = (f"{HIERARCHY}  influences Grab\n",)


def check(study: Study) -> Found:
    """Learned influences below which no actuator or memory has a second driver."""
    only = _only_drivers(study)
    alone = _alone(study, only)
    for skill in (each for each in study.mind.skills if not each.like):
        if skill.name in study.active:
            for edge in skill.edges:
                if edge.to == "skill" and edge.at is None and edge.target in alone:
                    yield _finding(skill, edge, alone[edge.target])


def _only_drivers(study: Study) -> set[str]:
    """The actuators and memories that a single active skill drives."""
    drivers: dict[str, int] = {}
    for name in study.active:
        for edge in study.skills[name].edges:
            if edge.to != "skill":
                drivers[edge.target] = drivers.get(edge.target, 0) + 1
    return {name for name, count in drivers.items() if count == 1}


def _alone(study: Study, only: set[str]) -> dict[str, str]:
    """The skills that move nothing that others move too, each with something that it moves."""
    found: dict[str, str] = {}
    for skill in study.children_first:
        moved = [found.get(edge.target) if edge.to == "skill" else edge.target for edge in skill.edges]
        if all(name in only for name in moved):
            found[skill.name] = moved[0] or ""
    return found


def _finding(skill: Skill, edge: Edge, moved: str) -> Finding:
    learned = sum(other.at is None for other in skill.edges)
    fix = Fix("Write at 1", (instead(edge.fact.span, f"{edge.fact.span.text} at 1"),), is_safe=False)
    message = f"How much influence {skill.name} has on {edge.target} makes no difference, only whether it has any."
    same = f"Nobody else drives {moved}, so its command is the same (Eq. 3)"
    hint = f"{same}: write influences {edge.target} at 1, unless it is to learn when it is on and when off (# noqa)."
    if learned == 1:
        hint = f"{same}: let another skill drive it, too, unless it is to learn when it is on and when off (# noqa)."
    return Finding(edge.fact.span, message, hint, fix=fix if learned > 1 else None)
