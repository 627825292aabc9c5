"""Several wheels, and all of them on one side.

Such a robot can only turn on the spot: most often a line was copied and its `side` was not changed.
"""

from mindlang.compiler.diagnostic import Label
from mindlang.lint.study import Finding, Found, Study

GOOD = """
actuator left_wheel is wheel side left neutral 0.5
actuator right_wheel is wheel side right neutral 0.5
"""
BAD = GOOD.replace("side right", "side left")


def check(study: Study) -> Found:
    wheels = [(part, part.kind.mounted) for part in study.mind.actuators if part.kind.mounted]
    sides = {side for _, side in wheels}
    if len(wheels) > 1 and len(sides) == 1:
        (first, side), (last, _) = wheels[0], wheels[-1]
        other = "right" if side == "left" else "left"
        label = Label(first.span, "so is this one")
        hint = f"Write side {other} in one of them."
        yield Finding(last.span, f"{last.name} is on the {side}, and so are all wheels.", hint, (label,))
