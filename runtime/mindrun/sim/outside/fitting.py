"""Whether sensors and actuators fit an environment: what is wrong with each, before anything is stepped."""

from collections.abc import Collection, Iterator, Mapping
from typing import Any, NamedTuple

import numpy as np

from mindrun.sim.outside.parts import Part, parts_of
from mindrun.slot import Slot


class Misfit(NamedTuple):
    """The name of a sensor or an actuator (empty: of the task), a code, a sentence, and what to do."""

    name: str
    code: str
    message: str
    hint: str


def misfits(observed: Any, acted: Any, sensors: Mapping[str, Slot], actuators: Mapping[str, Slot]) -> Iterator[Misfit]:
    """What does not fit the spaces of an environment."""
    parts, sinks = parts_of(observed), parts_of(acted)
    for name, slot in sensors.items():
        yield from _of_place(name, "observation", slot, parts)
    found = [misfit for name, slot in actuators.items() for misfit in _of_actuator(name, slot, sinks)]
    yield from found or _of_all(actuators.values(), sinks)


def _of_place(name: str, noun: str, slot: Slot, parts: Mapping[str, Part]) -> Iterator[Misfit]:
    part = parts.get(slot.part)
    if part is None:
        known = [each for each in parts if each]
        said = f"has no part called {slot.part}" if slot.part else "has several parts"
        hint = f"Its parts are {', '.join(known)}: write {noun} {known[0]} 0." if known else f"Write {noun} 0."
        yield Misfit(name, "unknown-slot", f"The {noun} of the environment {said}.", hint)
    elif part.place(slot.index) is None:
        several = "s" * (part.axes != (1,))
        hint = f"It has {' times '.join(map(str, part.axes))} number{several}: {part.indices()}."
        yield Misfit(name, "unknown-slot", f"The environment has no {noun} {slot}.", hint)


def _of_actuator(name: str, slot: Slot, parts: Mapping[str, Part]) -> Iterator[Misfit]:
    part = parts.get(slot.part)
    place = part.place(slot.index) if part else None
    if part is None or place is None:
        yield from _of_place(name, "action", slot, parts)
    elif slot.chosen is None:
        yield from _of_number(name, slot, part, place)
    elif part.choices is None:
        hint = "Write one actuator for each of them: action 0."
        yield Misfit(name, "unfit-action", "The environment takes numbers, and no choices.", hint)
    elif not part.low[place] <= slot.chosen <= part.high[place]:
        hint = f"Its choices are {part.low[place]:.0f} to {part.high[place]:.0f}."
        yield Misfit(name, "unknown-slot", f"The environment has no choice {slot.chosen}.", hint)


def _of_number(name: str, slot: Slot, part: Part, place: int) -> Iterator[Misfit]:
    if part.choices is not None:
        hint = f"Write one actuator for each that is to be chosen: choice {part.low[place]:.0f}."
        yield Misfit(name, "unfit-action", "The environment takes one of a few actions, and no numbers.", hint)
    elif not slot.has_two_ends:
        yield Misfit(name, "no-range", "An action has a range with two ends.", "Write range -1 to 1.")
    elif slot.range is None and not np.isfinite([part.low[place], part.high[place]]).all():
        message = "The environment does not say how large this action may be."
        yield Misfit(name, "no-range", message, "Say it: range -1 to 1.")


def _of_all(slots: Collection[Slot], parts: Mapping[str, Part]) -> Iterator[Misfit]:
    """Everything that an environment takes is given to it, and each number once."""
    for name, part in parts.items():
        for place in range(len(part.low)):
            there = Slot(name, tuple(map(int, np.unravel_index(place, part.axes))))
            given = [slot for slot in slots if (slot.part, slot.index) == (name, there.index)]
            if part.choices is None and len(given) > 1:
                yield Misfit("", "repeated-action", f"Two actuators are action {there}.", "Leave one of them out.")
            elif part.choices is None and not given:
                hint = f"Add it: actuator thrust is action {there} neutral 0.5."
                yield Misfit("", "missing-action", f"No actuator is action {there} of the environment.", hint)
            elif not given:
                written = f"{there if part.shape else name} {part.low[place]:.0f}".strip()
                hint = f"Add one for each: actuator wait is choice {written} neutral 0."
                yield Misfit("", "missing-action", "No actuator is a choice of the environment.", hint)
