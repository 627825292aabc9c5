"""Observations → readings, commands → actions: the mind's side of an environment, as arrays."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mindrun.errors import MindError
from mindrun.graph import Graph
from mindrun.sim.outside import making
from mindrun.sim.outside.fitting import misfits
from mindrun.sim.outside.parts import Part, parts_of
from mindrun.slot import Slot

Floats = NDArray[np.float64]
Commands = NDArray[np.float32]  # [actuators, lanes]


@dataclass(frozen=True, slots=True)
class Source:
    """Numbers that are taken out of one part of an observation, at `places`, to the slots `to`."""

    name: str
    shape: tuple[int, ...]
    places: NDArray[np.int64]
    to: NDArray[np.int64]


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

    def of(self, commands: Commands) -> NDArray[Any]:
        """That part of the actions, one for each lane [lanes, *shape]."""
        given, lanes = commands[self.rows].astype(np.float64), commands.shape[1]
        if self.part.choices is None:
            found = np.zeros((lanes, len(self.part.low)))
            found[:, self.places] = (self.low[:, None] + given * (self.high - self.low)[:, None]).T
        else:
            found = np.zeros((lanes, len(self.part.low)), np.int64)
            for place in np.unique(self.places):
                here = self.places == place
                found[:, place] = self.numbers[here][given[here].argmax(axis=0)]
        return found.astype(self.part.dtype).reshape(lanes, *self.part.shape)


@dataclass(frozen=True, slots=True)
class Wiring:
    """The slots that are observed, in the order of the sensors that read them: their rows among the readings."""

    environment: str
    rows: NDArray[np.int64]
    names: tuple[str, ...]
    low: Floats
    high: Floats
    sources: tuple[Source, ...]
    sinks: tuple[Sink, ...]

    def take(self, observation: Any, out: Floats) -> None:
        """The numbers of an observation that are read, into `out` [slots]; ValueError where it has another shape."""
        for source in self.sources:
            found = np.asarray(_inside(observation, source.name))
            if found.shape != source.shape:
                what = f"the part {source.name} of an observation" if source.name else "an observation"
                raise ValueError(f"{what} has the shape {found.shape}, and its space says {source.shape}")
            out[source.to] = found.reshape(-1)[source.places]

    def actions(self, commands: Commands) -> Sequence[Any]:
        """One action for each lane."""
        found = {sink.name: sink.of(commands) for sink in self.sinks}
        if "" in found:
            return list(found[""])
        return [_nested({name: values[lane] for name, values in found.items()}) for lane in range(commands.shape[1])]


def wiring_of(graph: Graph, environment: str) -> Wiring:
    """How a mind is wired to an environment; MindError where it does not fit."""
    observed, acted = making.spaces(environment)
    sensors = {sensor.name: slot for sensor in graph.sensors if (slot := sensor.kind.slot)}
    actuators = {actuator.name: slot for actuator in graph.actuators if (slot := actuator.kind.slot)}
    for found in misfits(observed, acted, sensors, actuators):
        raise MindError(f"{found.name}: {found.message}".removeprefix(": "), found.hint)
    rows = [sensor.start for sensor in graph.sensors if sensor.name in sensors]
    ends = np.array([_ends(slot) for slot in sensors.values()], np.float64).reshape(-1, 2)
    driven = [(row, actuators[each.name]) for row, each in enumerate(graph.actuators) if each.name in actuators]
    return Wiring(
        environment,
        np.array(rows, np.int64),
        tuple(sensors),
        ends[:, 0],
        ends[:, 1],
        _sources(parts_of(observed), list(sensors.values())),
        tuple(_sink(name, part, driven) for name, part in parts_of(acted).items()),
    )


def _sources(parts: Mapping[str, Part], slots: Sequence[Slot]) -> tuple[Source, ...]:
    found = []
    for name in dict.fromkeys(slot.part for slot in slots):
        to = [number for number, slot in enumerate(slots) if slot.part == name]
        places = [parts[name].place(slots[number].index) for number in to]
        found.append(Source(name, parts[name].shape, np.array(places, np.int64), np.array(to, np.int64)))
    return tuple(found)


def _sink(name: str, part: Part, driven: Sequence[tuple[int, Slot]]) -> Sink:
    mine = [(row, slot) for row, slot in driven if slot.part == name]
    rows, slots = [row for row, _ in mine], [slot for _, slot in mine]
    places = np.array([part.place(slot.index) for slot in slots], np.int64)
    said = [_ends(slot) if slot.range else (part.low[i], part.high[i]) for slot, i in zip(slots, places, strict=True)]
    low, high = np.array(said, np.float64).reshape(-1, 2).T
    numbers = np.array([slot.chosen or 0 for slot in slots], np.int64)
    return Sink(name, part, np.array(rows, np.int64), places, low, high, numbers)


def _ends(slot: Slot) -> tuple[float, float]:
    assert slot.range is not None
    return slot.range.first, slot.range.last


def _inside(observation: Any, name: str) -> Any:
    for key in name.split(".") if name else ():
        observation = observation[key]
    return observation


def _nested(found: Mapping[str, Any]) -> dict[str, Any]:
    action: dict[str, Any] = {}
    for name, value in found.items():
        *above, last = name.split(".")
        inner = action
        for key in above:
            inner = inner.setdefault(key, {})
        inner[last] = value
    return action
