"""A body that lacks what it needs to go where it wants.

A car goes where it is driven and steered: with a motor alone it stays on one line, with a steering alone it stands.
A holonomic body moves in the directions in which thrusters push it: where all push along one line, it stays on that.
"""

from itertools import combinations

from mindrun.kinds.actuators.actuator import ActuatorKind

from mindlang.compiler.model import Part
from mindlang.lint.study import Finding, Found, Study

GOOD = (
    """
body Robot is car
actuator engine is motor neutral 0.5
actuator wheels is steering neutral 0.5
skill Go is rule
  drives engine at 1
  drives wheels at 0.4
""",
    """
body Robot is holonomic
actuator ahead is thruster neutral 0.5
actuator aside is thruster facing 90 deg neutral 0.5
skill Go is rule
  drives ahead at 1
  drives aside at 1
""",
)
BAD = (
    GOOD[0].replace("actuator wheels is steering neutral 0.5\n", "").replace("  drives wheels at 0.4\n", ""),
    GOOD[0].replace("actuator engine is motor neutral 0.5\n", "").replace("  drives engine at 1\n", ""),
    GOOD[1].replace("facing 90 deg", "facing 180 deg"),
)
LEAST_SINE = 1e-6  # of the angle between two directions
LACKS = {
    "steering": ("drives a car that nothing steers: it stays on one line.", "Add an actuator that is steering."),
    "motor": ("steers a car that nothing drives: it stands still.", "Add an actuator that is motor."),
}


def check(study: Study) -> Found:
    body, moving = study.mind.body.kind, [part for part in study.mind.actuators if part.kind.drive]
    there = {part.kind.drive for part in moving}
    if "steering" in body.drives and len(there) == 1:
        for drive, (message, hint) in LACKS.items():
            if drive not in there:
                yield Finding(moving[0].span, f"{moving[0].name} {message}", hint)
    elif body.drives == ("thruster",) and moving and not _is_planar(study, moving):
        last, name = moving[-1], study.mind.body.name
        message = f"{last.name} and all other thrusters push along one line, and {name} stays on it."
        if len(moving) == 1:
            message = f"{last.name} is the only thruster, and {name} moves along one line alone."
        yield Finding(last.span, message, "Add a thruster that is facing elsewhere, or turn one: facing 90 deg.")


def _is_planar(study: Study, thrusters: list[Part[ActuatorKind]]) -> bool:
    rows = [part.kind.row(study.mind.body.kind) for part in thrusters]
    crossed = (a["ahead"] * b["aside"] - a["aside"] * b["ahead"] for a, b in combinations(rows, 2))
    return any(abs(sine) > LEAST_SINE for sine in crossed)
