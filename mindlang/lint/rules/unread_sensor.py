"""A sensor that nobody reads.

It is computed in every tick and comes to nothing; and whoever reads the file will think that it matters. A sensor is
read by skills, by other sensors (`derivative of`) and by rewards.
"""

from mindlang.compiler.diagnostic import Fix
from mindlang.editing.insertion import without_declarations
from mindlang.lint.study import Finding, Found, Study

ELSEWHERE = True
GOOD = (
    """
sensor eye is range_finder at 0 deg
skill Go is rule
  reads eye
  drives left_wheel at eye
""",
    """
sensor charge is battery
task Rest in plain
  lasts 9 s
  rewards charge per tick
""",
)
BAD = (
    """
sensor eye is range_finder at 0 deg
skill Go is rule
  drives left_wheel at 1
""",
)


def check(study: Study) -> Found:
    """Sensors that stand in no line but their own."""
    for name, declaration in study.mind.names.declarations("sensor"):
        is_needed = study.is_exhausted and study.sensors[name].battery
        if name not in study.used.get("sensor", set()) and not is_needed:
            fix = Fix(f"Remove {name}", without_declarations([declaration]))
            hint = f"Add reads {name} to a skill, or take the sensor out."
            yield Finding(declaration.header.name.span, f"Nobody reads {name}.", hint, fix=fix)
