"""An actuator that nobody drives.

It gets its `neutral` value in every tick. A wheel that nobody drives stands still or, worse, pushes; a claw never
closes. Let a skill drive it, or take it out if the robot has no such part.
"""

from mindlang.compiler.diagnostic import Fix
from mindlang.editing.insertion import without_declarations
from mindlang.lint.study import Finding, Found, Study

ELSEWHERE = True
GOOD = (
    """
skill Go is rule
  drives left_wheel at 1
  drives right_wheel at 1
""",
)
BAD = (
    """
skill Go is rule
  drives left_wheel at 1
""",
)


def check(study: Study) -> Found:
    """Actuators that stand in no line but their own."""
    for part in study.mind.actuators:
        if part.name not in study.used.get("actuator", set()):
            declaration = study.mind.names.table["actuator"][part.name]
            fix = Fix(f"Remove {part.name}", without_declarations([declaration]), is_safe=False)
            hint = f"Add drives {part.name} to a skill, or take the actuator out."
            message = f"Nobody drives {part.name}: it stays at {part.kind.neutral:g}."
            yield Finding(part.span, message, hint, fix=fix)
