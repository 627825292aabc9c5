"""A number or a scene that nothing says.

No line says the number, no task is in the scene and no scene is like it: it changes nothing. One of a file that others
use may be there for them.
"""

from mindlang.lint.study import Finding, Found, Study, removal

ELSEWHERE = True
GOOD = (
    "number far is 12\nsensor eye is range_finder at 0 deg range far\n",
    "scene Rocks is arena\ntask Course in Rocks\n  lasts 9 s\n",
)
BAD = ("number far is 12\n", "scene Rocks is arena\ntask Course in arena\n  lasts 9 s\n")


def check(study: Study) -> Found:
    for name, number in study.mind.names.numbers.items():
        if ("number", name) not in study.used:
            fix = removal(number, f"Remove {name}", is_safe=True)
            yield Finding(number.name.span, f"Nothing says {name}.", "Say it somewhere, or take it out.", fix=fix)
    for name, scene in study.mind.names.declarations("scene"):
        if ("scene", name) not in study.used:
            hint = f"Write task NAME in {name}, or take it out."
            fix = removal(scene, is_safe=True)
            yield Finding(scene.header.name.span, f"No task is in {name}.", hint, fix=fix)
