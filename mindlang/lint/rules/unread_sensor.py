"""A sensor that nobody reads.

It is computed in every tick and comes to nothing; and whoever reads the file will think that it matters. A sensor is
read by skills, by other sensors (`derivative of`) and by rewards.
"""

from mindlang.lint.study import Finding, Found, Study, removal

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
BAD = GOOD[0].replace("  reads eye\n", "").replace("at eye", "at 1")


def check(study: Study) -> Found:
    for part in study.mind.sensors:
        is_needed = study.is_exhausted and part.kind.battery
        if ("sensor", part.name) not in study.used and not is_needed:
            fix = removal(study.mind.names.table["sensor"][part.name], is_safe=True)
            hint = f"Add reads {part.name} to a skill, or take the sensor out."
            yield Finding(part.span, f"Nobody reads {part.name}.", hint, fix=fix)
