"""A sensor or memory with the name of a measure.

Where both have one name the sensor is meant, so in rewards the measure can no longer be said: with a sensor called so
`rewards forward per tick` pays what it reads, and no longer for moving forward.
"""

from mindrun.kinds.registry import arguments, kinds

from mindlang.lint.study import Finding, Found, Study

GOOD = """
sensor ahead is range_finder at 0 deg
task Course in arena
  lasts 9 s
  rewards forward + ahead per tick
"""
BAD = GOOD.replace("ahead", "forward")


def check(study: Study) -> Found:
    measures = {name for name, kind in kinds("measure").items() if not any(a.required for a in arguments(kind))}
    parts = [*study.mind.names.declarations("sensor"), *study.mind.names.declarations("memory")]
    for name in (declaration.header.name for name, declaration in parts if name in measures):
        hint = f"Give it another name: {study.main.edit('rename', name.text, 'NAME')}"
        yield Finding(name.span, f"{name.text} hides the measure of that name in rewards.", hint)
