"""Observations → readings, commands → actions: the mind's side of an environment, as arrays."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mindrun.actuators.action import Action
from mindrun.actuators.choice import Choice
from mindrun.errors import MindError
from mindrun.graph import Graph
from mindrun.quantity import UNSAID
from mindrun.sensors.observation import Observation
from mindrun.sim.environments import making
from mindrun.sim.environments.fitting import misfits
from mindrun.sim.environments.parts import Part, parts_of

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

    Of numbers: low + command · (high − low) at `places`. Of choices: at each of the `places` that of the `numbers` whose
    command is the largest.
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
    sensors = {s.name: s.kind for s in graph.sensors if isinstance(s.kind, Observation)}
    actuators = {a.name: a.kind for a in graph.actuators if isinstance(a.kind, Action | Choice)}
    for found in misfits(observed, acted, sensors, actuators):
        raise MindError(f"{found.name}: {found.message}".removeprefix(": "), found.hint)
    rows = [sensor.start for sensor in graph.sensors if sensor.name in sensors]
    ranges = [kind.range for kind in sensors.values()]
    return Wiring(
        environment,
        np.array(rows, np.int64),
        tuple(sensors),
        np.array([each.first for each in ranges], np.float64),
        np.array([each.last for each in ranges], np.float64),
        _sources(parts_of(observed), list(sensors.values())),
        _sinks(parts_of(acted), [(row, a.kind) for row, a in enumerate(graph.actuators) if a.name in actuators]),
    )


def _sources(parts: Mapping[str, Part], sensors: Sequence[Observation]) -> tuple[Source, ...]:
    found = []
    for name in dict.fromkeys(sensor.part for sensor in sensors):
        mine = [(slot, sensor) for slot, sensor in enumerate(sensors) if sensor.part == name]
        places = [parts[name].place(sensor.observation) for _, sensor in mine]
        slots = [slot for slot, _ in mine]
        found.append(Source(name, parts[name].shape, np.array(places, np.int64), np.array(slots, np.int64)))
    return tuple(found)


def _sinks(parts: Mapping[str, Part], actuators: Sequence[tuple[int, Any]]) -> tuple[Sink, ...]:
    found = []
    for name, part in parts.items():
        mine = [(row, kind) for row, kind in actuators if kind.part == name]
        index = [kind.action if isinstance(kind, Action) else kind.choice[:-1] or (0,) for _, kind in mine]
        places = np.array([part.place(each) for each in index], np.int64)
        ends = [_ends(kind, part, place) for (_, kind), place in zip(mine, places.tolist(), strict=True)]
        low, high = np.array(ends, np.float64).reshape(-1, 2).T
        numbers = [kind.choice[-1] if isinstance(kind, Choice) else 0 for _, kind in mine]
        rows = np.array([row for row, _ in mine], np.int64)
        found.append(Sink(name, part, rows, places, low, high, np.array(numbers, np.int64)))
    return tuple(found)


def _ends(kind: Any, part: Part, place: int) -> tuple[float, float]:
    if isinstance(kind, Action) and kind.range != UNSAID:
        return kind.range.first, kind.range.last
    return float(part.low[place]), float(part.high[place])


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
