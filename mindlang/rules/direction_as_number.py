"""A direction that is compared as if it were a number on a line.

A compass or a bearing goes round: just behind on the left it reads 0, just behind on the right 1. So `when north > 90%`
is behind on the right alone, and a latch of one flips behind, however far apart its thresholds are. Compare with both
sides, or how far it is off: `computed at greatest of north (1 - north)` is 0.5 straight ahead and 1 behind.
"""

from collections import Counter
from collections.abc import Iterator, Set

from mindrun.sensors.sensor import directions

from mindlang.analysis.conditions import STRICT, TURNED, UPPER
from mindlang.analysis.intervals import interval, is_constant
from mindlang.analysis.study import Finding, Found, Study
from mindlang.compiler.model import Comparison, Reading, When

SENSORS = "sensor north is compass\nsensor off is computed at greatest of north (1 - north)\n"
SKILL = "skill Go is rule\n  reads north\n  drives left_wheel at 1 when"
GOOD = (
    f"{SENSORS}sensor behind is latch of off below 70% above 80%\n",
    f"{SENSORS}{SKILL} north > 90% or north < 10%\n",
    f"{SENSORS}{SKILL} north > 0.5\n",
    f"{SENSORS}{SKILL} north > 90% and north <= 1\n",
    f"{SENSORS}{SKILL} north > 1\n",
)
BAD = (
    f"{SENSORS}sensor behind is latch of north below 20% above 80%\n",
    f"{SENSORS}sensor calm is average of north over 5 ticks\nsensor behind is latch of calm below 20% above 80%\n",
    f"{SENSORS}{SKILL} north > 90%\n",
    f"{SENSORS}{SKILL} 0.2 > north otherwise 0\n",
    "sensor north is compass\ntask Course in arena\n  lasts 9 s\n  rewards 1 per tick when north >= 3/4\n",
)


def check(study: Study) -> Found:
    """Latches of directions, and conditions that hold behind the robot on one side."""
    known = directions(study.sensors)
    for sensor in study.mind.sensors:
        if sensor.kind.compares and sensor.kind.source in known:
            of = sensor.kind.source
            message = f"{of} is a direction: behind the robot it goes from 0 to 1, and {sensor.name} flips there."
            hint = f"Take how far it is off: computed at greatest of {of} (1 - {of}) is 0.5 ahead and 1 behind."
            yield Finding(sensor.span, message, hint)
    for skill in (each for each in study.mind.skills if not each.like):
        for edge in skill.edges:
            yield from _one_sided(edge.gate.when if edge.gate else None, known)
    for task in study.mind.tasks:
        for when in [*(reward.when for reward in task.rewards), *(end.when for end in task.ends)]:
            yield from _one_sided(when, known)


def _one_sided(when: When | None, known: Set[str]) -> Iterator[Finding]:
    """The directions of which a condition asks for one side of what is behind, and nothing else."""
    sides = [[side for each in all_ if (side := _side(each, known))] for all_ in (when.alternatives if when else ())]
    asked = Counter(reading.name for all_ in sides for reading, *_ in all_)
    for reading, compare, number in (side for all_ in sides for side in all_):
        is_left = compare in UPPER
        if asked[reading.name] == 1 and _is_behind(compare, number):
            here, there = ("left", "right") if is_left else ("right", "left")
            other = f"{reading.name} {TURNED[compare]} {1 - number:g}"
            same = f"{reading.name} {'>= 0' if is_left else '<= 1'}"
            message = f"{reading.name} is a direction, and this is behind on the {here} alone, not on the {there}."
            yield Finding(reading.span, message, f"Add or {other}, or, where one side is meant, and {same}.")


def _is_behind(compare: str, number: float) -> bool:
    """Whether a direction can be so to a number, and only behind the robot."""
    off = number if compare in UPPER else 1 - number
    return off <= 0.25 and (off > 0 or (off == 0 and compare not in STRICT))


def _side(each: Comparison, known: Set[str]) -> tuple[Reading, str, float] | None:
    """The direction that is compared with a number, how, and the number."""
    for side, other, compare in ((each.left, each.right, each.compare), (each.right, each.left, TURNED[each.compare])):
        match side.terms:
            case (Reading(name) as reading,) if name in known and is_constant(other):
                return reading, compare, interval(other)[0]
    return None
