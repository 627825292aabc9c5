"""The wiring of a mind to an environment: checks of its sensors and actuators, and its commands as actions."""

from collections import defaultdict
from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass
from itertools import accumulate
from typing import NamedTuple

import numpy as np

from mindrun.errors import MindError
from mindrun.graph.graph import Graph
from mindrun.kinds.environment import Slot
from mindrun.numbers.arrays import Doubles, Integers, Singles
from mindrun.sim.outside.parts import Place, SpacePart, Spaces, found

WRAP = "Wrap the environment in one that has numbers instead, registered in a module beside the mind."


class Misfit(NamedTuple):
    """A code, the name of a sensor or an actuator (empty: of the task), a sentence, and what to do."""

    code: str
    name: str
    message: str
    hint: str


def misfits(spaces: Spaces, sensors: Mapping[str, Slot], actuators: Mapping[str, Slot]) -> Iterator[Misfit]:
    """All sensors and actuators that do not fit the spaces of an environment, and actions that are missing."""
    parts, sinks = spaces.observed, spaces.acted
    for name, slot in sensors.items():
        yield from _of_place(name, "observation", slot, parts)
    wrong = [misfit for name, slot in actuators.items() for misfit in _of_actuator(name, slot, sinks)]
    for other in () if wrong else spaces.others:
        yield Misfit("unfit-action", "", f"The environment takes {other or 'something'}, which is no number.", WRAP)
    yield from wrong or _of_all(actuators.values(), sinks)


def _of_place(name: str, noun: str, slot: Slot, parts: Mapping[str, SpacePart]) -> Iterator[Misfit]:
    _, part, index = found(parts, slot)
    if part is None:
        known = [each for each in parts if each]
        said = f"has no part called {slot.part}" if slot.part else "has several parts" if known else "is no number"
        first = _written(known[0], (0,)) if known else "0"
        hint = f"Its parts are {', '.join(known)}: write {noun} {first}." if known else f"Write {noun} 0."
        hint = hint if parts else WRAP
        yield Misfit("unknown-slot", name, f"The {noun} of the environment {said}.", hint)
    elif slot.last is not None:
        if not (len(index) == 1 and index[0] <= slot.last < len(part.low)):
            hint = f"It has {len(part.low)}, which are counted through: 0 to {len(part.low) - 1}."
            yield Misfit("unknown-slot", name, f"The environment has no {noun}s {slot}.", hint)
    elif part.place(index) is None:
        several = "s" * (part.axes != (1,))
        hint = f"It has {' times '.join(map(str, part.axes))} number{several}: {part.indices()}."
        yield Misfit("unknown-slot", name, f"The environment has no {noun} {slot}.", hint)


def _of_actuator(name: str, slot: Slot, parts: Mapping[str, SpacePart]) -> Iterator[Misfit]:
    _, part, index = found(parts, slot)
    place = part.place(index) if part else None
    if part is None or place is None:
        yield from _of_place(name, "action", slot, parts)
    elif slot.chosen is None:
        yield from _of_number(name, slot, part, place)
    elif not part.is_choice:
        hint = "Write one actuator for each of them: action 0."
        yield Misfit("unfit-action", name, "The environment takes numbers, and no choices.", hint)
    elif not part.low[place] <= slot.chosen <= part.high[place]:
        hint = f"Its choices are {part.low[place]:.0f} to {part.high[place]:.0f}."
        yield Misfit("unknown-slot", name, f"The environment has no choice {slot.chosen}.", hint)


def _of_number(name: str, slot: Slot, part: SpacePart, place: int) -> Iterator[Misfit]:
    if part.is_choice:
        hint = f"Write one actuator for each that is to be chosen: choice {part.low[place]:.0f}."
        yield Misfit("unfit-action", name, "The environment takes one of a few actions, and no numbers.", hint)
    elif not slot.has_two_ends:
        yield Misfit("open-range", name, "An action has a range with two ends.", "Write range -1 to 1.")
    elif slot.range is None and not np.isfinite([part.low[place], part.high[place]]).all():
        message = "The environment does not say how large this action may be."
        yield Misfit("open-range", name, message, "Say it: range -1 to 1.")
    elif slot.range and not part.low[place] <= slot.range.first < slot.range.last <= part.high[place]:
        hint = f"Write a range within {part.low[place]:g} to {part.high[place]:g}."
        yield Misfit("out-of-range", name, "The range goes beyond what the environment takes.", hint)


def _of_all(slots: Collection[Slot], parts: Mapping[str, SpacePart]) -> Iterator[Misfit]:
    """Misfits where an action of the environment has no actuator, or a number has two."""
    places = [(name, index) for name, _, index in (found(parts, slot) for slot in slots)]
    for name, part in parts.items():
        for place in range(len(part.low)):
            index = tuple(map(int, np.unravel_index(place, part.axes)))
            given = places.count((name, index))
            there = _written(name, index)
            if not part.is_choice and given > 1:
                yield Misfit("repeated-action", "", f"Two actuators are action {there}.", "Leave one of them out.")
            elif not part.is_choice and not given:
                hint = f"Add it: actuator thrust is action {there} neutral 0.5."
                yield Misfit("missing-action", "", f"No actuator is action {there} of the environment.", hint)
            elif not given:
                written = f"{_written(name, index if part.shape else ())} {part.low[place]:.0f}".strip()
                hint = f"Add one for each: actuator wait is choice {written} neutral 0."
                yield Misfit("missing-action", "", "No actuator is a choice of the environment.", hint)


def _written(name: str, index: tuple[int, ...]) -> str:
    """A place of a part as it is written: the numbers of a tuple's parts are indices."""
    is_of_tuple = name.rpartition(".")[2].isdigit()
    return " ".join([*name.split("."), *map(str, index)]) if is_of_tuple else f"{name} {Slot('', index)}".strip()


@dataclass(frozen=True, slots=True)
class EnvironmentWiring:
    """The numbers that a mind reads of an environment, and the actions that its commands are there.

    Of each number that its sensors read, in order: its row among the readings (`rows`), the name of the sensor, the
    ends of the range, and its place in an observation. An action is as many numbers as its parts have, one part after
    the other: of the commands `driven` least + command · (most − least) at the places `to`, and at others a choice:
    there it is the k-th of some numbers, where of the actuators in some rows the k-th has the largest command.
    """

    rows: Integers
    names: tuple[str, ...]
    low: Doubles
    high: Doubles
    places: tuple[Place, ...]
    action_numbers: int
    driven: Integers
    to: Integers
    least: Doubles
    most: Doubles
    choices: tuple[tuple[int, Integers, Integers], ...]

    def actions(self, commands: Singles) -> Doubles:
        """The actions [lanes, action_numbers] that commands [actuators, lanes] are."""
        given = commands.astype(np.float64)
        actions = np.zeros((commands.shape[1], self.action_numbers))
        numbers = self.least[:, None] + given[self.driven] * (self.most - self.least)[:, None]
        actions[:, self.to] = numbers.T
        for place, rows, choices in self.choices:
            actions[:, place] = choices[given[rows].argmax(axis=0)]
        return actions


def wiring_of(graph: Graph, spaces: Spaces) -> EnvironmentWiring:
    """The wiring of a mind to an environment of these spaces; MindError where it does not fit."""
    sensors = {sensor.name: slot for sensor in graph.sensors if (slot := sensor.kind.slot)}
    actuators = {actuator.name: slot for actuator in graph.actuators if (slot := actuator.kind.slot)}
    for misfit in misfits(spaces, sensors, actuators):
        raise MindError(f"{misfit.name}: {misfit.message}".removeprefix(": "), misfit.hint)
    sizes = [len(part.low) for part in spaces.acted.values()]
    firsts = dict(zip(spaces.acted, accumulate([0, *sizes]), strict=False))
    driven, chosen = list[tuple[float, ...]](), defaultdict[int, list[tuple[int, int]]](list)
    for row, each in enumerate(graph.actuators):
        if slot := each.kind.slot:
            [(name, place)] = _places(spaces.acted, slot)
            part, to = spaces.acted[name], firsts[name] + place
            if slot.chosen is None:
                driven.append((row, to, *(_ends(slot) if slot.range else (part.low[place], part.high[place]))))
            else:
                chosen[to].append((row, slot.chosen))
    read = [
        (sensor.start + number, sensor.name, place, _ends(slot))
        for sensor in graph.sensors
        if (slot := sensor.kind.slot)
        for number, place in enumerate(_places(spaces.observed, slot))
    ]
    low, high = np.array([ends for *_, ends in read], np.float64).reshape(-1, 2).T
    rows, places, least, most = np.array(driven, np.float64).reshape(-1, 4).T
    return EnvironmentWiring(
        rows=np.array([row for row, *_ in read], np.int64),
        names=tuple(name for _, name, *_ in read),
        low=low,
        high=high,
        places=tuple(place for _, _, place, _ in read),
        action_numbers=sum(sizes),
        driven=rows.astype(np.int64),
        to=places.astype(np.int64),
        least=least,
        most=most,
        choices=tuple((to, *np.array(pairs, np.int64).T) for to, pairs in chosen.items()),
    )


def _places(parts: Mapping[str, SpacePart], slot: Slot) -> list[Place]:
    """The place of the number that a slot is, or those of its numbers."""
    name, part, index = found(parts, slot)
    place = part.place(index) if part and slot.last is None else index[0]
    assert place is not None
    return [(name, each) for each in range(place, (place if slot.last is None else slot.last) + 1)]


def _ends(slot: Slot) -> tuple[float, float]:
    assert slot.range is not None
    return slot.range.first, slot.range.last
