"""Drives: what a mind or a hand did with a robot, read from recordings as readings and commands."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from hashlib import sha256
from itertools import pairwise
from pathlib import Path

import numpy as np
from mindrun.graph.graph import Graph
from mindrun.graph.named_readings import physical
from mindrun.graph.recording_header import About, RecordingError
from mindrun.robot.recording import read
from numpy.typing import NDArray

from mindlang.compiler.diagnostic import listed

Rows = NDArray[np.float32]  # [ticks, values]


@dataclass(frozen=True, slots=True)
class Drive:
    """A recording from a beginning to the next, or to its end, with the file's SHA-256; `first` is its first row.

    `readings` [ticks, graph.width], `influence` [ticks, skills] and `commands` [ticks, actuators] stand in the order of
    the mind that asks. Commands are those that reached the actuators, in the ticks in which they were sent; all are NaN
    where nobody knows them, as those of a robot that was stopped. `task` is that of its world, "" on a robot.
    """

    name: str
    digest: str
    first: int
    task: str
    readings: Rows
    influence: Rows
    commands: Rows

    def __len__(self) -> int:
        return len(self.readings)

    def part(self, rows: slice) -> "Drive":
        """Some of its rows, as a drive."""
        begin, end, _ = rows.indices(len(self))
        cut = (self.readings[begin:end], self.influence[begin:end], self.commands[begin:end])
        return Drive(self.name, self.digest, self.first + begin, self.task, *cut)


def read_drives(paths: Iterable[Path], graph: Graph) -> list[Drive]:
    """The drives in recordings of a mind with these sensors and actuators; its skills and weights may be others by now.

    RecordingError where one cannot be read, or is of another mind.
    """
    return [drive for path in paths for drive in _drives(path, graph)]


def _drives(path: Path, graph: Graph) -> list[Drive]:
    about, parts = read(path)
    _refuse_another(path, about, graph)
    rows = np.concatenate([*parts, np.zeros(0, about.row)])
    digest = sha256(path.read_bytes()).hexdigest()
    influence = np.full((len(rows), len(graph.skills)), np.nan, np.float32)
    for place, skill in enumerate(graph.skills):
        if skill.name in about.skills:
            influence[:, place] = rows["influence"][:, about.skills.index(skill.name)]
    commands = np.where(rows["stopped"][:, None] != 0, np.float32(np.nan), rows["sent"])
    task = about.world.task if about.world else ""
    is_late = about.world is not None and not about.by_hand  # a hand's commands are as it gave them
    begins = [0, *(np.flatnonzero(rows["tick"][1:] == 0) + 1).tolist(), len(rows)]
    return [
        Drive(path.name, digest, begin, task, rows["readings"][begin:end], influence[begin:end], sent)
        for begin, end in pairwise(begins)
        if begin < end
        for sent in [_when_sent(commands[begin:end], graph, is_late)]
    ]


def _when_sent(commands: Rows, graph: Graph, is_late: bool) -> Rows:
    """Commands in the ticks in which they were sent, where they stand in those in which they reached an actuator."""
    found = np.full_like(commands, np.nan)
    for place, actuator in enumerate(graph.actuators):
        delay = actuator.kind.delay if is_late else 0
        found[: max(0, len(commands) - delay), place] = commands[delay:, place]
    return found


def _refuse_another(path: Path, about: About, graph: Graph) -> None:
    """RecordingError unless rows of a recording mean what those of this mind would."""
    own = [name for name in physical(graph) if name in about.sensors]
    actuators = tuple(actuator.name for actuator in graph.actuators)
    if about.tick != graph.tick:
        why = f"its tick is {about.tick:g} s, and that of the mind {graph.tick:g} s"
    elif missing := sorted({*about.sensors} - {*own}):
        why = f"it has readings of {listed(missing, 'and')}, which the mind does not know"
    elif about.actuators != actuators:
        why = f"it drives {listed(about.actuators, 'and')}, and the mind {listed(actuators, 'and')}"
    elif about.readings != graph.width or tuple(own) != about.sensors:
        why = "its sensors are others, or in another order"
    else:
        return
    raise RecordingError(f"{path} is a recording of another mind: {why}", "take the source as it was, or record anew")


def in_words(drives: Sequence[Drive]) -> str:
    """The names of the recordings, each once: a.rec and b.rec, or a.rec, b.rec and 7 others."""
    names = [*dict.fromkeys(drive.name for drive in drives)]
    shown = names if len(names) <= MAX_NAMED else [*names[: MAX_NAMED - 1], f"{len(names) - MAX_NAMED + 1} others"]
    return listed(shown, "and")


MAX_NAMED = 3
