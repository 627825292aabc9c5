"""Where runs end, for reading: how they ended, where the robot ran into something, and what to do about it."""

from collections import Counter
from collections.abc import Iterable, Iterator
from statistics import median
from textwrap import fill
from typing import Any

from rich.console import Group, RenderableType
from rich.text import Text

from mindlang.attribution.report import LINE_CHARACTERS
from mindlang.run.summary import aligned

MAX_NAMED = 3  # of the skills or things in a cell
HEAD = ("touched at", "left", "right", "unseen", "room", "what it ran into")
LEGEND = """\
at: from straight ahead; unseen: the rays to both sides of it had read more room
than it went in the last tick; room: by the nearer of them, units, median"""
Ends = list[dict[str, Any]]
Place = tuple[str, float, float]  # what the claw held, if that touched, else between which degrees


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
