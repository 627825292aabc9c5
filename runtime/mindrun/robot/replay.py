"""A recording computed again: the same bits on any machine, or the first tick that differs."""

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mindrun.engine.changes import UNCHANGED, ChangedEngine
from mindrun.graph.bundle import digest, read_bundle
from mindrun.graph.skill_sets import reachable
from mindrun.numbers.short_repr import ShortRepr
from mindrun.robot.recording import About, RecordingError, read

Singles = NDArray[np.float32]


@dataclass(frozen=True, slots=True, repr=False)
class Replayed(ShortRepr):
    """The result of a replay: how many ticks were computed again, and the first difference, its tick and a sentence."""

    ticks: int
    differs: tuple[int, str] | None


def replay_recording(
    recording: Path | str, bundle: Path | str, told: Callable[[int], None] = lambda ticks: None
) -> Replayed:
    """Compute a recorded drive again with the bundle that was running; `told` is told of the ticks so far.

    MindError where one of the two cannot be read, or the recording was made with another bundle. Runs the Python code
    of the bundle's procedures.
    """
    path, file = Path(recording), Path(bundle)
    mind = read_bundle(file)
    about, _ = read(path)
    return replay(path, digest(file), ChangedEngine(mind.policy, mind.procedures, about.master), told)


def replay(
    path: Path, bundle: str, engine: ChangedEngine, told: Callable[[int], None] = lambda ticks: None
) -> Replayed:
    """Compute the ticks of a recording with a bundle of that SHA-256; RecordingError where it was made with another."""
    about, parts = read(path)
    about.refuse_another(bundle, engine.graph)
    ticks = 0
    try:
        for rows in parts:
            for _ in computed_again(path, about, rows, engine, ticks + 1):
                ticks += 1
            told(ticks)
    except DifferenceError as error:
        return Replayed(ticks, (error.tick, error.what))
    if not ticks:
        raise RecordingError(f"{path} has no tick in it")
    return Replayed(ticks, None)


class DifferenceError(RecordingError):
    """A recording that is not what its bundle computes: the tick that its row says, and what differs in it."""

    def __init__(self, path: Path, row: int, tick: int, what: str) -> None:
        super().__init__(f"tick {row:,} of {path} is not what its bundle computes: {what}")
        self.tick, self.what = tick, what


def computed_again(
    path: Path, about: About, rows: Iterable[Any], engine: ChangedEngine, first: int = 1
) -> Iterator[Any]:
    """Rows of a recording, computed again by an engine that has computed those before; the first is number `first`.

    With each the engine has what was read, of virtual sensors and memories too, and who had influence; what a hand gave
    is taken from the row. Where a row says the first tick again, the mind was begun anew. DifferenceError where
    commands or influence are not those that were recorded, to the bit.
    """
    skills = tuple(skill.name for skill in reachable(engine.graph, about.master))
    reached = [about.skills.index(name) for name in skills]  # that others have no influence was written as 0 once
    by_hand = [about.skills.index(name) for name in about.by_hand if name in about.skills]
    for number, row in enumerate(rows, first):
        if row["tick"] == 0:
            engine.reset()
        given = {place: float(row["influence"][place]) for place in by_hand}
        commands = engine.tick_with(row["readings"], {**UNCHANGED, "influence": given})
        what = _difference(about.actuators, commands, row["commands"])
        what = what or _difference(skills, engine.influence[reached], row["influence"][reached])
        if what:
            raise DifferenceError(path, number, int(row["tick"]), what)
        yield row


def _difference(names: tuple[str, ...], now: Singles, then: Singles) -> str:
    """The first difference, in words; "" where all bits are the same."""
    if now.tobytes() == then.tobytes():
        return ""
    pairs = zip(names, now, then, strict=True)
    name, a, b = next((name, a, b) for name, a, b in pairs if a.tobytes() != b.tobytes())
    return f"{name} is {a:.9g} and was {b:.9g}"
