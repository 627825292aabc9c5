"""An actuator that nobody drives.

It gets its `neutral` value in every tick. A wheel that nobody drives stands still or, worse, pushes; a claw never
closes. Let a skill drive it, or take it out if the robot has no such part.
"""

from mindlang.lint.study import Finding, Found, Study, removal

ELSEWHERE = True
GOOD = """
skill Go is rule
  drives left_wheel at 1
  drives right_wheel at 1
"""
BAD = GOOD.replace("  drives right_wheel at 1\n", "")


def check(study: Study) -> Found:
    for part in study.mind.actuators:
        if ("actuator", part.name) not in study.used:
            hint = f"Add drives {part.name} to a skill, or take the actuator out."
            message = f"Nobody drives {part.name}: it stays at {part.kind.neutral:g}."
            fix = removal(study.mind.names.table["actuator"][part.name])
            yield Finding(part.span, message, hint, fix=fix)
