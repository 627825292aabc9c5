"""A recording with something changed: what the mind would have sent for the readings that there were.

Open loop: other commands would have led to other readings, and nobody knows which.
"""

from dataclasses import dataclass, replace
from itertools import chain
from pathlib import Path
from typing import Any

import numpy as np
from mindrun.engine.changes import ChangedEngine, ChangeError, in_tick
from mindrun.graph.bundle import Bundle
from mindrun.graph.graph import Graph
from mindrun.graph.named_readings import physical
from mindrun.graph.wiring import read_by
from mindrun.robot.recording import About, read
from mindrun.robot.replay import computed_again
from mindrun.terminal.tick_count import ticks as in_words
from numpy.typing import NDArray

from mindlang.compiler.diagnostic import listed
from mindlang.run.recording import running_bundle
from mindlang.whatif.comparison import TickDifference, first_differences, mind_columns
from mindlang.whatif.request import Request, changes_of

OPEN_LOOP = "open loop: the readings are those of the recording, whatever other commands would have led to"


@dataclass(frozen=True, slots=True)
class OpenLoop:
    """The differences from a recording; ticks are counted from 1 over the whole recording.

    `sent` has by actuator how far its commands are from those recorded: ticks that differ, the mean, the most, when.
    """

    master: str
    ticks: int
    differences: list[TickDifference]
    sent: dict[str, dict[str, Any]]


def compare_recording(path: Path, bundle: Path, request: Request, other: Bundle | None = None) -> OpenLoop:
    """Compute a recording as it was and with changes, under another mind from a tick on where there is one.

    RecordingError where the recording was made with another bundle, or is not what this one computes; ChangeError where
    it ends before the tick. Runs the Python code of both minds' procedures.
    """
    about, parts = read(path)
    mind = running_bundle(bundle, about)
    theirs, master = (other, other.graph.master) if other else (mind, about.master)
    engine = ChangedEngine(theirs.policy, theirs.procedures, master)
    places = _places(about, mind.graph, theirs.graph, master, request.other or bundle.name)
    changes = changes_of(request, theirs.graph, master, bundle)

    def changed(number: int, row: Any) -> tuple[Any, ...]:
        if row["tick"] == 0:  # begun anew
            engine.reset()
        given = np.append(row["readings"], np.float32(np.nan))[places]
        commands = engine.tick_with(given, in_tick(changes, number))
        return engine.readings, engine.influence, commands

    ours = ChangedEngine(mind.policy, mind.procedures, about.master)
    computed = computed_again(path, about, chain.from_iterable(parts), ours)
    ticks = [
        ((ours.readings, ours.influence, row["commands"]), changed(number, row))
        for number, row in enumerate(computed, 1)
    ]
    if len(ticks) < request.tick:
        raise ChangeError(f"{path} has {in_words(len(ticks))}: there is no tick {request.tick:,}", "say an earlier one")
    begin = request.tick - 1  # another mind has read along before, and sent nothing
    whole = (
        mind_columns(graph, *map(np.array, zip(*(each[i] for each in ticks), strict=True)))
        for i, graph in enumerate((mind.graph, theirs.graph))
    )
    was, now = (
        {kind: {name: rows[begin:] for name, rows in of.items()} for kind, of in each.items()} for each in whole
    )
    differ = [replace(each, tick=each.tick + begin) for each in first_differences(was, now)]
    both = was["command"].keys() & now["command"].keys()
    sent = {name: _sent(rows, now["command"][name], begin) for name, rows in was["command"].items() if name in both}
    return OpenLoop(about.master, len(ticks), differ, sent)


def _places(about: About, graph: Graph, other: Graph, master: str, file: str) -> NDArray[np.intp]:
    """The place in a recorded row of each reading of a mind; the place after the last is what nobody measured."""
    known = {name: sensor for name, sensor in physical(graph).items() if name in about.sensors}
    wanted = physical(other)
    found = [name for name in wanted if name in known and known[name].width == wanted[name].width]
    read = read_by(other, master)
    missing = [name for name in wanted if name in read and name not in found]
    if missing:
        raise ChangeError(f"the recording has no {listed(missing, 'and')}, which {Path(file).name} reads")
    places = np.full(other.width, graph.width, np.intp)
    for name in found:
        sensor = wanted[name]
        places[sensor.start : sensor.start + sensor.width] = known[name].start + np.arange(sensor.width)
    return places


def _sent(was: NDArray[np.float32], now: NDArray[np.float32], begin: int) -> dict[str, Any]:
    apart = np.abs(now.astype(np.float64) - was)
    ticks = int(np.count_nonzero(apart))
    most_tick = begin + 1 + int(apart.argmax()) if ticks else None
    return {"ticks": ticks, "mean": float(apart.mean()), "most": float(apart.max()), "most_tick": most_tick}
