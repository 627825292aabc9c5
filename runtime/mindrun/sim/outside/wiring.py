"""Observations → readings, commands → actions: the mind's side of an environment, as arrays."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mindrun.errors import MindError
from mindrun.graph.graph import Graph
from mindrun.kinds.slot import Slot
from mindrun.sim.outside.fitting import misfits
from mindrun.sim.outside.parts import Part, Spaces, found
from mindrun.sim.outside.taking import Place

Floats = NDArray[np.float64]
Commands = NDArray[np.float32]  # [actuators, lanes]
Action = Mapping[str, Any]  # the values of the parts of an action, by their names


@dataclass(frozen=True, slots=True)
class Sink:
    """What the commands `rows` make of one part of an action.

    Of numbers: low + command · (high − low) at `places`. Of choices: at each of the `places` that of the `numbers` of
    which the command is the largest.
    """

    name: str
    part: Part
    rows: NDArray[np.int64]
    places: NDArray[np.int64]
    low: Floats
    high: Floats
    numbers: NDArray[np.int64]

    def of(self, commands: Commands) -> Sequence[Any]:
        """That part of the actions, one for each lane: arrays of its shape; a choice of a single place is a number."""
        given, lanes = commands[self.rows].astype(np.float64), commands.shape[1]
        if self.part.choices is None:
            found = np.zeros((lanes, len(self.part.low)))
            found[:, self.places] = (self.low[:, None] + given * (self.high - self.low)[:, None]).T
        else:
            found = np.zeros((lanes, len(self.part.low)), np.int64)
            for place in np.unique(self.places):
                here = self.places == place
                found[:, place] = self.numbers[here][given[here].argmax(axis=0)]
        found = found.astype(self.part.dtype).reshape(lanes, *self.part.shape)
        has_numbers = bool(self.part.shape) or self.part.choices is not None
        return [*found] if has_numbers else [np.asarray(each) for each in found]


@dataclass(frozen=True, slots=True)
class Wiring:
    """The slots that are observed, in the order of the sensors that read them: their rows among the readings, and the
    `places` of their numbers in an observation.
    """

    rows: NDArray[np.int64]
    names: tuple[str, ...]
    low: Floats
    high: Floats
    places: tuple[Place, ...]
    sinks: tuple[Sink, ...]

    def actions(self, commands: Commands) -> Sequence[Action]:
        """One action for each lane."""
        parts = {sink.name: sink.of(commands) for sink in self.sinks}
        return [{name: values[lane] for name, values in parts.items()} for lane in range(commands.shape[1])]


def wiring_of(graph: Graph, spaces: Spaces) -> Wiring:
    """How a mind is wired to an environment of these spaces; MindError where it does not fit."""
    sensors = {sensor.name: slot for sensor in graph.sensors if (slot := sensor.kind.slot)}
    actuators = {actuator.name: slot for actuator in graph.actuators if (slot := actuator.kind.slot)}
    for misfit in misfits(spaces, sensors, actuators):
        raise MindError(f"{misfit.name}: {misfit.message}".removeprefix(": "), misfit.hint)
    rows = [sensor.start for sensor in graph.sensors if sensor.name in sensors]
    ends = np.array([_ends(slot) for slot in sensors.values()], np.float64).reshape(-1, 2)
    driven = [(row, actuators[each.name]) for row, each in enumerate(graph.actuators) if each.name in actuators]
    return Wiring(
        np.array(rows, np.int64),
        tuple(sensors),
        ends[:, 0],
        ends[:, 1],
        tuple(_place(spaces.observed, slot) for slot in sensors.values()),
        tuple(_sink(name, spaces.acted, driven) for name in spaces.acted),
    )


def _place(parts: Mapping[str, Part], slot: Slot) -> Place:
    name, part, index = found(parts, slot)
    place = part.place(index) if part else None
    assert place is not None
    return name, place


def _sink(name: str, parts: Mapping[str, Part], driven: Sequence[tuple[int, Slot]]) -> Sink:
    part, there = parts[name], [(row, slot, *found(parts, slot)) for row, slot in driven]
    mine = [(row, slot, index) for row, slot, of, _, index in there if of == name]
    rows, slots = [row for row, _, _ in mine], [slot for _, slot, _ in mine]
    places = np.array([part.place(index) for _, _, index in mine], np.int64)
    said = [_ends(slot) if slot.range else (part.low[i], part.high[i]) for slot, i in zip(slots, places, strict=True)]
    low, high = np.array(said, np.float64).reshape(-1, 2).T
    numbers = np.array([slot.chosen or 0 for slot in slots], np.int64)
    return Sink(name, part, np.array(rows, np.int64), places, low, high, numbers)


def _ends(slot: Slot) -> tuple[float, float]:
    assert slot.range is not None
    return slot.range.first, slot.range.last
