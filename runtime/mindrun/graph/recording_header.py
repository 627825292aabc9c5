"""The first line of a recording: what its columns are, in JSON, with a checksum of its own."""

import json
import re
import zlib
from collections.abc import Sequence
from dataclasses import dataclass, fields, replace
from pathlib import Path
from typing import Annotated, Any, Self

import numpy as np

from mindrun.errors import MindError
from mindrun.files.strict_json import are_names, is_whole, parsed
from mindrun.graph.codec import decode, encode
from mindrun.graph.graph import Graph, Task
from mindrun.graph.named_readings import physical
from mindrun.graph.tasks import robots_in, things_of
from mindrun.graph.validate import MAX_SEED, MAX_TICK_SECONDS, MIN_TICK_SECONDS
from mindrun.kinds.registry import left_out
from mindrun.numbers.arrays import Doubles
from mindrun.numbers.quantity import NUMBER, SECONDS, Quantity

FORMAT = "mind recording 3"
MAX_HEADER_BYTES = 1 << 20
COLUMNS = Quantity("a number of columns", {"": 1.0}, low=0, high=MAX_HEADER_BYTES, whole=True)
TICK = replace(SECONDS, low=MIN_TICK_SECONDS, high=MAX_TICK_SECONDS)
CHECKSUM_FIELD = b', "check": "'  # the checksum of the line before it, which is the last that it says
SHA256 = re.compile("[0-9a-f]{64}")
POSE_COLUMNS, THING_COLUMNS, BOX_COLUMNS = 3, 4, 4  # x, y, angle; x, y, size, turned; x, y, half of both sides
# Of the column `stopped`: who had every actuator at neutral. From BY_ACTUATOR on it is the guardian, of which the first
# actuator had failed, or the second, …; the last number stands for all that come after it, too.
NOT_STOPPED, BY_LOOP, BY_GUARDIAN, BY_ACTUATOR, BY_LAST = 0, 1, 2, 3, 255
GOES_ON = -3  # of the column `ended`; else as `Scores.ended_by`


class RecordingError(MindError):
    """A recording that cannot be read, or was made of something else."""


def by_guardian(actuator: int | None) -> int:
    """The value of `stopped` where the guardian had all at neutral: for that actuator, or another reason."""
    return BY_GUARDIAN if actuator is None else min(BY_ACTUATOR + actuator, BY_LAST)


def world_row(things: int, rewards: int, events: int) -> np.dtype[Any]:
    """The columns of a world after a tick: sums of reward lines and counts of events so far, the thing held or −1."""
    return np.dtype([
        ("pose", "<f8", (POSE_COLUMNS,)), ("things", "<f8", (things, THING_COLUMNS)), ("battery", "<f8"),
        ("rewards", "<f8", (rewards,)), ("events", "<u8", (events,)), ("held", "<i4"), ("ended", "<i4"),
        ("touching", "u1"),
    ])  # fmt: skip


def world_row_of(task: Task) -> np.dtype[Any]:
    """The columns of a task's world after a tick."""
    things = len(things_of(task))
    return world_row(things, len(task.rewards), len(task.events))


@dataclass(frozen=True, slots=True)
class RecordedWorld:
    """The simulated world of a recording: the task and the seed that it is of, and how many columns there are of it.

    `boxes` [n] are its obstacles, x, y and half of both sides, `begin` the pose and then each thing as the recording
    begins; None is what is nowhere. Of several robots in the world the rows are of one, by its number from 0 on: they
    have its pose and its claw, what it senses, thinks and sends, and what it is paid.
    """

    task: str
    seed: int
    things: Annotated[int, COLUMNS]
    rewards: Annotated[int, COLUMNS]
    events: Annotated[int, COLUMNS]
    boxes: Annotated[tuple[tuple[float, float, float, float] | None, ...], NUMBER]
    begin: Annotated[tuple[float | None, ...], NUMBER]
    robot: Annotated[int, COLUMNS] = left_out(0)

    @classmethod
    def of(cls, task: Task, seed: int, boxes: Doubles, begin: Sequence[float], robot: int = 0) -> Self:
        """The world of a run of a task, with its obstacles [boxes, 4] and what `begin` has."""
        things = (len(begin) - POSE_COLUMNS) // THING_COLUMNS
        there = tuple(float(number) if abs(number) < NUMBER.high else None for number in begin)
        standing = tuple(
            (x, y, half_x, half_y) if abs(x) < NUMBER.high else None for x, y, half_x, half_y in boxes.tolist()
        )
        return cls(task.name, seed, things, len(task.rewards), len(task.events), standing, there, robot)

    @property
    def row(self) -> np.dtype[Any]:
        """The columns that the world has in each tick."""
        return world_row(self.things, self.rewards, self.events)


@dataclass(frozen=True, slots=True)
class About:
    """The header of a recording: the SHA-256 of its bundle, the master, the names of its columns, its world if any.

    The actuators and skills that are `by_hand` were commanded, and given influence, by a person in all ticks in which
    the robot was not stopped: `sent` has those commands, beside the mind's own in `commands`.
    """

    bundle: str
    master: str
    tick: Annotated[float, TICK]
    sensors: tuple[str, ...]
    actuators: tuple[str, ...]
    skills: tuple[str, ...]
    readings: Annotated[int, COLUMNS]
    world: RecordedWorld | None = None
    by_hand: tuple[str, ...] = ()

    @classmethod
    def of(cls, graph: Graph, bundle: str, master: str, sensors: Sequence[str]) -> Self:
        """The header for a graph and these wired sensors."""
        actuators = tuple(actuator.name for actuator in graph.actuators)
        skills = tuple(skill.name for skill in graph.skills)
        return cls(bundle, master, graph.tick, tuple(sensors), actuators, skills, graph.width)

    def refuse_another(self, bundle: str, graph: Graph) -> None:
        """RecordingError unless the recording was made with the bundle of this SHA-256, which has this graph."""
        if self.bundle != bundle:
            raise RecordingError(
                f"this was recorded with another bundle ({self.bundle[:8]}…, not {bundle[:8]}…)",
                "take the bundle that was running",
            )
        worlds = [(task.name, world_row_of(task), n) for task in graph.tasks for n in range(robots_in(task))]
        expected = replace(About.of(graph, bundle, self.master, self.sensors), world=self.world, by_hand=self.by_hand)
        if (
            self != expected
            or not {*self.by_hand} <= {*self.actuators, *self.skills}
            or self.master not in self.skills
            or not set(self.sensors) <= physical(graph).keys()
            or (self.world and (self.world.task, self.world.row, self.world.robot) not in worlds)
        ):
            raise RecordingError("this has other columns than its bundle: it was recorded by something else")

    @property
    def row(self) -> np.dtype[Any]:
        """The columns of a tick: number, time, who had all at neutral, if armed; what was read, thought and sent."""
        sensors, skills, actuators = (len(names) for names in (self.sensors, self.skills, self.actuators))
        return np.dtype([
            ("tick", "<u8"), ("time", "<f8"), ("stopped", "u1"), ("armed", "u1"),
            ("faults", "u1", (sensors,)), ("ages", "<f4", (sensors,)), ("readings", "<f4", (self.readings,)),
            ("influence", "<f4", (skills,)), ("commands", "<f4", (actuators,)), ("sent", "<f4", (actuators,)),
            *([("world", self.world.row)] if self.world else []), ("check", "<u4"),
        ])  # fmt: skip


NAME_LISTS = ("sensors", "actuators", "skills", "by_hand")


def line_of(about: About) -> bytes:
    """The first line; RecordingError where it would be longer than one that is read."""
    said = {"format": FORMAT, **encode(about)}
    if about.world is None:
        del said["world"]
    if not about.by_hand:
        del said["by_hand"]
    line = _sealed(json.dumps(said, allow_nan=False).encode()[:-1] + CHECKSUM_FIELD)
    if len(line) > MAX_HEADER_BYTES:
        raise RecordingError("this world has too many things and obstacles to be recorded")
    return line


def about_of_line(line: bytes, path: Path) -> About:
    """The header in a first line; RecordingError where it is none of a recording, or damaged."""
    try:
        plain = parsed(line, MAX_HEADER_BYTES)
        if not isinstance(plain, dict) or plain.get("format") != FORMAT:
            raise ValueError(_foreign(plain))
        if line != _sealed(line):
            raise RecordingError(f"{path} is damaged in its first line")
        found = _typed({"by_hand": []} | {each.name: plain[each.name] for each in fields(About) if each.name in plain})
        return replace(found, world=_world(plain["world"])) if "world" in plain else found
    except ValueError as error:
        raise RecordingError(f"{path} is no recording of this mindrun: {error}") from error


def _foreign(plain: object) -> str:
    """Why a recording with such a first line cannot be read."""
    version = plain.get("format") if isinstance(plain, dict) else None
    if not isinstance(version, str) or not version.startswith("mind recording"):
        return "it is of another form"
    return f"it is a {version!r:.40}, not a {FORMAT!r}; record it again, or take the version that recorded it"


def _sealed(line: bytes) -> bytes:
    """The line with the checksum of all before it."""
    said = line.rpartition(CHECKSUM_FIELD)[0]
    return said + CHECKSUM_FIELD + f"{zlib.crc32(said):08x}".encode() + b'"}\n'


def _typed(plain: dict[str, Any]) -> About:
    """A header from plain data; ValueError where that is none."""
    about: About = decode(About, plain | {"world": None}, "it")
    if not SHA256.fullmatch(about.bundle):
        raise ValueError("it does not say of which bundle it is")
    if not all(are_names(plain[name]) for name in NAME_LISTS):
        raise ValueError("its columns have no names")
    return about


def _world(plain: object) -> RecordedWorld:
    """A world from plain data; ValueError where that is none."""
    if not isinstance(plain, dict) or not is_whole(plain.get("seed"), high=MAX_SEED):
        raise ValueError("it does not say what its world is, or which seed it is of")
    world: RecordedWorld = decode(RecordedWorld, plain | {"seed": 0}, "its world")  # a seed may have 64 bits
    if len(world.begin) != POSE_COLUMNS + THING_COLUMNS * world.things:
        raise ValueError("its world does not say how it began")
    return replace(world, seed=plain["seed"])
