"""What a sensor has read in a recording, tick by tick, as changes of another run."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from mindrun.engine.changes import Change, ChangeError, change_of
from mindrun.graph.bundle import Bundle
from mindrun.graph.graph import Graph, Sensor
from mindrun.graph.named_readings import physical
from mindrun.graph.recording_header import About, RecordingError
from mindrun.robot.recording import read
from mindrun.terminal.command_line import command_line
from mindrun.terminal.tick_count import ticks as in_words

from mindlang.run.recording import measured_in, running_bundle

RECORDING_SUFFIX = ".rec"


def is_recording(said: str) -> bool:
    """Whether this is `day.rec`, or `day.rec,ball.bundle`, and no numbers."""
    return said.partition(",")[0].endswith(RECORDING_SUFFIX)


def recorded_readings(
    graph: Graph, name: str, said: str, own: Path | None, first: int, last: int | None
) -> tuple[Change, ...]:
    """A sensor that reads in each tick from `first` on what it has read in this tick of a recording, while that lasts.

    `said` is the recording and, behind a comma, the bundle or source that was running, without which that is `own`.
    MindError where one cannot be read, the recording is of another bundle, or the sensor is another there.
    """
    file, _, bundle = said.partition(",")
    path = Path(file)
    [begin, *_] = change_of(graph, "reading", name, [[0.0]], first, last)  # or it says what is wrong
    about, parts = read(path)
    mind = _bundle(path, about, Path(bundle) if bundle else own, name, bool(bundle))
    sensor = _sensor(path, about, mind, name)
    ours = next(each for each in graph.sensors if each.name == name)
    if sensor.width != ours.width:
        many = "1 reading" if sensor.width == 1 else f"{sensor.width} readings"
        raise ChangeError(f"{name} has {many} in {path}, and {ours.width} here", "take a recording of the same sensor")
    if about.tick != graph.tick:
        raise ChangeError(
            f"a tick of {path} is {about.tick:g} s, and one of this run {graph.tick:g} s",
            "take a recording of a mind with the same tick",
        )
    columns = slice(sensor.start, sensor.start + sensor.width)
    nothing = np.zeros((0, sensor.width), np.float32)  # a recording may have no row
    rows = np.concatenate([nothing, *(part["readings"][:, columns] for part in parts)])
    if len(rows) < first:
        raise ChangeError(f"{path} has {in_words(len(rows))}: there is no tick {first:,}", "say an earlier one")
    end = len(rows) if last is None else min(last, len(rows))
    read_then = rows[first - 1 : end].astype(float).T.tolist()
    return tuple(Change("reading", begin.row + k, tuple(column), first, end) for k, column in enumerate(read_then))


def _bundle(path: Path, about: About, running: Path | None, name: str, is_said: bool) -> Bundle:
    """The bundle of a recording, which knows where the readings of each sensor stand in a row."""
    hint = f"say the bundle that was running behind it: {command_line('--sensor', f'{name}={path},NAME.bundle')}"
    if running is None:
        raise ChangeError(f"nobody says which bundle was running when {path} was recorded", hint)
    try:
        return running_bundle(running, about)
    except RecordingError as error:
        if is_said:
            raise
        raise ChangeError(f"{path}: {error}", hint) from error


def _sensor(path: Path, about: About, mind: Bundle, name: str) -> Sensor:
    """A sensor whose readings are in a recording."""
    is_physical = name in physical(mind.graph)
    found = next((sensor for sensor in mind.graph.sensors if sensor.name == name), None)
    is_there = found is not None and measured_in(about, mind)[found.start]
    if found is None or not is_there or (about.lacks_readings and not is_physical):
        raise ChangeError(f"{path} has no readings of {name}", f"it has those of {', '.join(about.sensors)}")
    return found
