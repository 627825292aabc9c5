"""Observations → readings, commands → actions: the mind's side of an environment, as arrays."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mindrun.errors import MindError
from mindrun.graph import Graph
from mindrun.sim.outside import making
from mindrun.sim.outside.fitting import misfits
from mindrun.sim.outside.parts import Part, formed, found, parts_of
from mindrun.slot import Slot

Floats = NDArray[np.float64]
Commands = NDArray[np.float32]  # [actuators, lanes]
NUMBERS = "biuf"  # kinds of arrays: truth values, whole numbers, others


@dataclass(frozen=True, slots=True)
class Source:
    """Numbers that are taken out of one part of an observation, at `places`, to the slots `to`."""

    name: str
    part: Part
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
    """The slots that are observed, in the order of the sensors that read them: their rows among the readings.

    `folder` is where a module before the name of the environment is looked for first, `acted` the space of actions.
    """

    environment: str
    folder: Path | None
    rows: NDArray[np.int64]
    names: tuple[str, ...]
    low: Floats
    high: Floats
    sources: tuple[Source, ...]
    sinks: tuple[Sink, ...]
    acted: Any

    def take(self, observation: Any, out: Floats) -> None:
        """The numbers of an observation that are read, into `out` [slots]; ValueError where it has another shape."""
        for source in self.sources:
            seen = np.asarray(_inside(observation, source.part.path))
            if seen.shape != source.part.shape or seen.dtype.kind not in NUMBERS:
                raise ValueError(_flaw(source, seen))
            out[source.to] = seen.reshape(-1)[source.places]

    def actions(self, commands: Commands) -> Sequence[Any]:
        """One action for each lane."""
        parts = {sink.name: sink.of(commands) for sink in self.sinks}
        lanes = range(commands.shape[1])
        return [formed(self.acted, {name: values[lane] for name, values in parts.items()}) for lane in lanes]


def wiring_of(graph: Graph, environment: str, folder: Path | None = None) -> Wiring:
    """How a mind is wired to an environment; MindError where it does not fit."""
    observed, acted = making.spaces(environment, folder)
    sensors = {sensor.name: slot for sensor in graph.sensors if (slot := sensor.kind.slot)}
    actuators = {actuator.name: slot for actuator in graph.actuators if (slot := actuator.kind.slot)}
    for misfit in misfits(observed, acted, sensors, actuators):
        raise MindError(f"{misfit.name}: {misfit.message}".removeprefix(": "), misfit.hint)
    rows = [sensor.start for sensor in graph.sensors if sensor.name in sensors]
    ends = np.array([_ends(slot) for slot in sensors.values()], np.float64).reshape(-1, 2)
    driven = [(row, actuators[each.name]) for row, each in enumerate(graph.actuators) if each.name in actuators]
    sinks = parts_of(acted)
    return Wiring(
        environment,
        folder,
        np.array(rows, np.int64),
        tuple(sensors),
        ends[:, 0],
        ends[:, 1],
        _sources(parts_of(observed), list(sensors.values())),
        tuple(_sink(name, sinks, driven) for name in sinks),
        acted,
    )


def _sources(parts: Mapping[str, Part], slots: Sequence[Slot]) -> tuple[Source, ...]:
    sources, there = [], [found(parts, slot) for slot in slots]
    for name in dict.fromkeys(name for name, _, _ in there):
        to = [number for number, (of, _, _) in enumerate(there) if of == name]
        places = [parts[name].place(there[number][2]) for number in to]
        sources.append(Source(name, parts[name], np.array(places, np.int64), np.array(to, np.int64)))
    return tuple(sources)


def _sink(name: str, parts: Mapping[str, Part], driven: Sequence[tuple[int, Slot]]) -> Sink:
    part, there = parts[name], [(row, slot, *found(parts, slot)) for row, slot in driven]
    mine = [(row, slot, index) for row, slot, of, _, index in there if of == name]
    rows, slots = [row for row, _, _ in mine], [slot for _, slot, _ in mine]
    places = np.array([part.place(index) for _, _, index in mine], np.int64)
    said = [_ends(slot) if slot.range else (part.low[i], part.high[i]) for slot, i in zip(slots, places, strict=True)]
    low, high = np.array(said, np.float64).reshape(-1, 2).T
    numbers = np.array([slot.chosen or 0 for slot in slots], np.int64)
    return Sink(name, part, np.array(rows, np.int64), places, low, high, numbers)


def _flaw(source: Source, seen: NDArray[Any]) -> str:
    """What is wrong with what was seen in the place of a part."""
    what = f"the part {source.name} of an observation" if source.name else "an observation"
    if seen.shape != source.part.shape:
        return f"{what} has the shape {seen.shape}, and its space says {source.part.shape}"
    return f"{what} is of {seen.dtype}, which are no real numbers"


def _ends(slot: Slot) -> tuple[float, float]:
    assert slot.range is not None
    return slot.range.first, slot.range.last


def _inside(observation: Any, path: Sequence[Any]) -> Any:
    for key in path:
        observation = observation[key]
    return observation
