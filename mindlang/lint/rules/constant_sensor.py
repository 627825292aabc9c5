"""A sensor that always reads the same.

A claw that no skill closes never holds anything, a sine of one or two ticks is met where it is 0.5 only, a battery
without drain stays as it is, and what never changes has no derivative. Whoever reads such a sensor learns nothing.
"""

from mindlang.lint.study import Finding, Found, Study

BALL = """
sensor holding is held of ball
task Carry in arena
  contains ball is item
  lasts 9 s
"""
GOOD = (
    f"actuator claw is gripper neutral 0\nskill Go is rule\n  drives claw at 1\n{BALL}",
    "sensor pulse is sine period 2 s\n",
)
BAD = (
    BALL,
    "sensor pulse is sine period 1/30 s\n",
    "sensor charge is battery drain 0\nsensor hunger is derivative of charge\ntask Run in arena\n  lasts 9 s\n",
)


def check(study: Study) -> Found:
    for part in study.mind.sensors:
        constant = study.any_world.constant(part.name)
        if constant is not None:
            yield Finding(part.span, f"{part.name} always reads {constant:g}.", f"{part.kind.remedy}, or take it out.")
