"""Whether sensors and actuators fit an environment: what is wrong with each, before anything is stepped."""

from collections.abc import Iterable, Iterator, Mapping
from typing import Any, NamedTuple

import numpy as np

from mindrun.actuators.action import Action
from mindrun.actuators.choice import Choice
from mindrun.quantity import UNSAID
from mindrun.sensors.observation import Observation
from mindrun.sim.environments.parts import Part, parts_of


class Misfit(NamedTuple):
    """The name of a sensor or an actuator (empty: of the task), a code, a sentence, and what to do."""

    name: str
    code: str
    message: str
    hint: str


def misfits(
    observed: Any, acted: Any, sensors: Mapping[str, Observation], actuators: Mapping[str, Action | Choice]
) -> Iterator[Misfit]:
    """What does not fit the spaces of an environment."""
    parts = parts_of(observed)
    for name, sensor in sensors.items():
        yield from _of_place(name, "observation", sensor.part, sensor.observation, parts)
    sinks = parts_of(acted)
    sound = True
    for name, actuator in actuators.items():
        for found in _of_actuator(name, actuator, sinks):
            sound = False
            yield found
    if sound:
        yield from _of_all(actuators.values(), sinks)


def _of_place(
    name: str, noun: str, part: str, index: tuple[int, ...], parts: Mapping[str, Part]
) -> Iterator[Misfit]:
    if part not in parts:
        known = ", ".join(each for each in parts if each)
        said = f"The {noun} of the environment has no part called {part}." if part else f"The {noun} has several parts."
        hint = f"Its parts are {known}: write {noun} {known.split(', ')[0]} 0." if known else f"Write {noun} 0."
        yield Misfit(name, "unknown-slot", said, hint)
    elif parts[part].place(index) is None:
        written, axes = " ".join(map(str, index)), parts[part].axes
        hint = f"It has {' times '.join(map(str, axes))} number{'s' * (axes != (1,))}: {parts[part].indices()}."
        yield Misfit(name, "unknown-slot", f"The environment has no {noun} {f'{part} {written}'.strip()}.", hint)


def _of_actuator(name: str, kind: Action | Choice, parts: Mapping[str, Part]) -> Iterator[Misfit]:
    chosen = parts.get(kind.part)
    if isinstance(kind, Action) and chosen and chosen.choices is not None:
        hint = f"Write one actuator for each that is to be chosen: choice {chosen.low[0]:.0f}."
        yield Misfit(name, "unfit-action", "The environment takes one of a few actions, and no numbers.", hint)
    elif isinstance(kind, Action):
        yield from _of_place(name, "action", kind.part, kind.action, parts)
        place = chosen.place(kind.action) if chosen else None
        if chosen and place is not None and kind.range == UNSAID and not _is_bounded(chosen, place):
            message = "The environment does not say how large this action may be."
            yield Misfit(name, "no-range", message, "Say it: range -1 to 1.")
        elif kind.range != UNSAID and not (kind.range.by is None and kind.range.first < kind.range.last):
            yield Misfit(name, "no-range", "An action has a range with two ends.", "Write range -1 to 1.")
    elif chosen and chosen.choices is None:
        hint = "Write one actuator for each of them: action 0."
        yield Misfit(name, "unfit-action", "The environment takes numbers, and no choices.", hint)
    else:
        yield from _of_choice(name, kind, parts)


def _of_choice(name: str, kind: Choice, parts: Mapping[str, Part]) -> Iterator[Misfit]:
    part = parts.get(kind.part)
    index = kind.choice[:-1] or (0,)
    if part is None or part.place(index) is None:
        yield from _of_place(name, "action", kind.part, index, parts)
        return
    place = part.place(index)
    if not part.low[place] <= kind.choice[-1] <= part.high[place]:
        hint = f"Its choices are {part.low[place]:.0f} to {part.high[place]:.0f}."
        yield Misfit(name, "unknown-slot", f"The environment has no choice {kind.choice[-1]}.", hint)


def _of_all(kinds: Iterable[Action | Choice], parts: Mapping[str, Part]) -> Iterator[Misfit]:
    """Everything that an environment takes is given to it, and each number once."""
    given: dict[str, list[int]] = {name: [] for name in parts}
    for kind in kinds:
        index = kind.action if isinstance(kind, Action) else kind.choice[:-1] or (0,)
        place = parts[kind.part].place(index)
        if place is not None and not (isinstance(kind, Choice) and place in given[kind.part]):
            given[kind.part].append(place)
    for name, part in parts.items():
        for place in range(int(np.prod(part.axes))):
            index = " ".join(str(i) for i in np.unravel_index(place, part.axes))
            said = f"{name} {index}".strip()
            if given[name].count(place) > 1:
                yield Misfit("", "repeated-action", f"Two actuators are action {said}.", "Leave one of them out.")
            elif place not in given[name] and part.choices is None:
                hint = f"Add it: actuator thrust is action {said} neutral 0.5."
                yield Misfit("", "missing-action", f"No actuator is action {said} of the environment.", hint)
            elif place not in given[name]:
                where = said if part.shape or name else ""
                hint = f"Add one for each: actuator wait is choice {f'{where} {part.low[place]:.0f}'.strip()} neutral 0."
                yield Misfit("", "missing-action", "No actuator is a choice of the environment.", hint)


def _is_bounded(part: Part, place: int) -> bool:
    return bool(np.isfinite(part.low[place]) and np.isfinite(part.high[place]))
