"""Where runs end: by what, under whose control, where on its body the robot ran into something, and what rays had read.

A run that is over is made again, alone, and its last tick is looked at.
"""

from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import asdict, dataclass
from math import atan2, degrees, hypot, pi
from statistics import median
from textwrap import fill
from typing import Any

import numpy as np
from mindrun.graph.run_scores import Scores
from mindrun.sim.codes import GOING_ON
from mindrun.sim.numbering import boxes_by_name
from mindrun.sim.rollout import Rollout
from mindrun.sim.trace import Touch, last_touch, trace
from rich.console import Group, RenderableType
from rich.text import Text

from mindlang.attribution.answer import LINE_CHARACTERS
from mindlang.run.outcome import TIME, ended_by
from mindlang.run.recorded_run import RecordedRun, recorded
from mindlang.run.setup import RunSetup
from mindlang.run.summary import aligned

ARENA_WALL = "wall"  # what has no name of its own
SECTOR_DEGREES = 45  # at most, where no ray is between
MAX_NAMED = 3  # of the skills or things in a cell
HEAD = ("touched at", "left", "right", "unseen", "room", "what it ran into")
LEGEND = """\
at: from straight ahead; unseen: the rays to both sides of it had read more room
than it went in the last tick; room: by the nearer of them, units, median"""
Ends = list[dict[str, Any]]
Place = tuple[str, float, float]  # what the claw held, if that touched, else between which degrees


@dataclass(frozen=True, slots=True)
class RunInto:
    """A touch in the last tick: its direction in degrees from straight ahead, left is positive, and what was touched.

    `by` is what the claw held, if that touched it. `between` are the rays to both sides, or multiples of 45 degrees if
    nearer, of a touch on the right as if it were on the left. `room` is the least that these rays had read before that
    tick, in world units; None without rays, or of what is held. `is_unseen` says whether that is more than what touched
    went in that tick, and is None, too, where nobody knows the room.
    """

    angle: float
    what: str
    by: str | None
    between: tuple[float, float]
    room: float | None
    is_unseen: bool | None


@dataclass(frozen=True, slots=True)
class RunEnd:
    """The end of a run: its number, from 1 on, and seed; its last tick; the skill that moved the robot most then."""

    run: int
    seed: int
    tick: int
    ended_by: str
    in_control: str | None
    run_into: RunInto | None


def run_ends(setup: RunSetup, rollout: Rollout, seeds: Sequence[int], scores: Scores) -> Iterator[RunEnd]:
    """The end of each run that did not last its time; of an environment nobody knows more than what ended it."""
    for number in np.flatnonzero(scores.ended_by[0] != GOING_ON).tolist():
        by = ended_by(setup.task, int(scores.ended_by[0, number])) or TIME
        in_control, run_into = None, None
        if not setup.task.scene.environment:
            made = trace(rollout, seeds[number], robot=setup.robot)
            run = recorded(setup, made)
            in_control = [*run.movers, None][run.in_control(last=1)[0]]
            touch = last_touch(rollout, made.state, setup.robot) if run.ticks in run.collisions else None
            run_into = _run_into(run, touch) if touch else None
        yield RunEnd(number + 1, seeds[number], int(scores.ticks[0, number]), by, in_control, run_into)


def ends_data(setup: RunSetup, seed: int, scores: Scores, ends: Sequence[RunEnd]) -> dict[str, Any]:
    """The contents of `--json`: how many of the runs from a seed ended how, and each end."""
    runs = scores.ticks.shape[1]
    lasted = [TIME] * (runs - len(ends))
    return {
        "task": setup.task.name,
        "master": setup.master,
        "seed": seed,
        "runs": runs,
        "environment": setup.task.scene.environment,
        "ended": dict(Counter([*(end.ended_by for end in ends), *lasted]).most_common()),
        "ends": [asdict(end) for end in ends],
    }


def _run_into(run: RecordedRun, touch: Touch) -> RunInto:
    angle = degrees(atan2(touch.aside, touch.ahead))
    what = next((name for name, boxes in boxes_by_name(run.task).items() if touch.box in boxes), ARENA_WALL)
    by = run.contents[touch.thing].name if touch.thing >= 0 else None
    rays, (dx, dy, turned) = _rays(run, what), (run.body[-1] - run.body[-2]).tolist()
    beside = [min(rays, key=lambda ray: side * (ray - angle) % 360) for side in (1, -1)] if rays and not by else []
    room = min((rays[ray] for ray in beside), default=None)
    went = hypot(dx, dy) + abs(turned) * hypot(touch.ahead, touch.aside)
    return RunInto(angle, what, by, _sector(rays, angle), room, None if room is None else room > went)


def _rays(run: RecordedRun, what: str) -> dict[float, float]:
    """The last readings, in world units, of the rays that see a thing of this name, by their angle in degrees."""
    return {
        round(degrees((angle + pi) % (2 * pi) - pi), 3): float(run.readings[-1, place]) * sensor.kind.reach
        for sensor in run.graph.sensors
        if what in (sensor.kind.things or (what,))
        and np.isfinite(run.readings[-1, sensor.start])  # else nobody reads it
        for place, angle in enumerate(sensor.kind.rays, sensor.start)
    }


def _sector(rays: Iterable[float], angle: float) -> tuple[float, float]:
    """The degrees between which an angle is: of rays, or multiples of 45; on the right as if it were on the left."""
    edges = [*range(-180, 181, SECTOR_DEGREES), *(ray if angle >= 0 else -ray for ray in rays)]
    low = max(edge for edge in edges if edge <= abs(angle) and edge < 180)
    return low, min(edge for edge in edges if edge > low)


def ends_text(found: dict[str, Any]) -> RenderableType:
    """The ends of runs, 80 characters wide where names let it."""
    runs, ends = found["runs"], found["ends"]
    title = f" with {found['master']} in charge, {runs:,} run{'s' * (runs != 1)} from seed {found['seed']}"
    parts = [Text.assemble((found["task"], "bold"), title), Text(), _ways(found), Text()]
    if not (places := _by_place(ends)):
        return Group(*parts, *_said(_nothing_touched(found), found, ends))
    rows = [_row(place, touching) for place, touching in sorted(places.items())]
    place, most = max(places.items(), key=lambda each: len(each[1]))
    said = _said(_conclusion(place, most, sum(map(len, places.values()))), found, most)
    return Group(*parts, aligned(rows, (0, 5), HEAD), Text(f"\n{LEGEND}\n", "dim"), *said)


def _said(sentence: str, found: dict[str, Any], ends: Ends) -> Iterator[Text]:
    """A sentence, and how to see the first of some ends, if any."""
    yield Text(fill(sentence, LINE_CHARACTERS), "bold")
    for end in ends[:1]:
        yield Text(
            f"mindc view --seed {found['seed']}/{end['run']} shows one: {end['ended_by']}, in tick {end['tick']:,}."
        )


def _ways(found: dict[str, Any]) -> Text:
    """How runs ended, and which skills moved the robot most in their last tick."""
    rows = [
        (f"{runs:,}", name, _often(end["in_control"] for end in found["ends"] if end["ended_by"] == name))
        for name, runs in found["ended"].items()
    ]
    return aligned(rows, (1, 2), ("runs", "ended by", "moved at the end by" * any(named for *_, named in rows)))


def _often(names: Iterable[str | None]) -> str:
    """Names with how often each is there, the most frequent first."""
    times = Counter(name for name in names if name).most_common()
    rest = sum(count for _, count in times[MAX_NAMED:])
    named = [f"{name} {count:,}" for name, count in times[:MAX_NAMED]]
    return ", ".join([*named, *[f"others {rest:,}"] * bool(rest)])


def _by_place(ends: Ends) -> dict[Place, Ends]:
    found: dict[Place, Ends] = {}
    for end in ends:
        if touch := end["run_into"]:
            place = (touch["by"], 0.0, 0.0) if touch["by"] else ("", *touch["between"])
            found.setdefault(place, []).append(end)
    return found


def _row(place: Place, ends: Ends) -> tuple[str, ...]:
    """The cells of a place: touches on the left and right, those unseen, the room that rays had read, with what."""
    touches = [end["run_into"] for end in ends]
    left, rooms = sum(touch["angle"] >= 0 for touch in touches), [each["room"] for each in touches]
    seen = ("–", "–") if None in rooms else (f"{sum(each['is_unseen'] for each in touches):,}", f"{median(rooms):.2f}")
    by, low, high = place
    name = f"with the {by} it held" if by else f"{low:g} to {high:g}°"
    return (name, f"{left:,}", f"{len(ends) - left:,}", *seen, _often(touch["what"] for touch in touches))


def _nothing_touched(found: dict[str, Any]) -> str:
    if not found["ends"]:
        return "Nothing ended any run: all lasted their time."
    if found["environment"]:
        return f"What touched what, only {found['environment']} knows: it is an environment of Gymnasium."
    return "No run ended as the robot ran into something."


def _conclusion(place: Place, most: Ends, touching: int) -> str:
    """Where most of the touches are, what rays read of them, and what to do."""
    by, low, high = place
    touches = [end["run_into"] for end in most]
    skill = Counter(end["in_control"] for end in most).most_common(1)[0][0] or "a skill"
    away = f"have {skill} keep farther away"
    said = f"{len(most):,} of {touching:,} touches are "
    if by:
        return f"{said}of the {by} that the claw held, which no sensor feels: {away}."
    left = sum(touch["angle"] >= 0 for touch in touches)
    side = f"{left:,} on the left" if 2 * left >= len(most) else f"{len(most) - left:,} on the right"
    said += f"between {low:g} and {high:g}° ({side}), "
    if any(touch["room"] is None for touch in touches):
        return f"{said}and no range finder is read: let a skill read one, or {away}."
    if 2 * (unseen := sum(touch["is_unseen"] for touch in touches)) > len(most):
        return f"{said}where no ray looks, {unseen:,} of them unseen: let a ray look there, or {away}."
    return f"{said}where rays had read what came: {away}."
