"""A hand on the wheel: the commands of actuators and the influence of skills that a person says while a mind runs.

Each number that was said counts for HAND_SECONDS. A hand of which one is missing or older has let go; while it has, a
robot stands at neutral, and a simulated world stands still.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from time import monotonic
from typing import Literal

import numpy as np

from mindrun.engine.changes import UNCHANGED, Changed
from mindrun.errors import MindError, nearest
from mindrun.graph.graph import Graph
from mindrun.graph.skill_sets import reachable
from mindrun.numbers.arrays import Singles

HAND_SECONDS = 0.5
Role = Literal["left", "right", "ahead", "turn", ""]  # of what moves the robot: by which keys it is driven
Said = Mapping[str, float]  # numbers by the names of what a hand holds


@dataclass(frozen=True, slots=True)
class Held:
    """An actuator or a skill that a hand holds: its place among those, and the number where no key is pressed."""

    name: str
    is_skill: bool
    place: int
    neutral: float
    role: Role

    def refusal(self, value: float) -> str:
        """The reason why a number cannot be said of it, empty where it can."""
        return "" if 0 <= value <= 1 else "it is a number from 0 to 1"


class Hand:
    """The hand that holds some actuators and skills, by their names. One that holds nothing never lets go.

    Any thread may say a number, or ask.
    """

    def __init__(self, held: Mapping[str, Held], clock: Callable[[], float] = monotonic) -> None:
        self.held = held
        self._clock = clock
        self._said: dict[str, tuple[float, float]] = {}

    @property
    def names(self) -> tuple[str, ...]:
        """The names of what it holds."""
        return tuple(self.held)

    @property
    def holds_influence(self) -> bool:
        """True if it holds a skill."""
        return any(each.is_skill for each in self.held.values())

    def say(self, name: str, value: float) -> None:
        """Let a number be this from now on; MindError where it is none from 0 to 1."""
        if why := self.held[name].refusal(value):
            raise MindError(f"{name} cannot be {value:g}: {why}")
        self._said[name] = value, self._clock()

    def now(self) -> Said | None:
        """The numbers that count now; None where the hand has let go."""
        now = self._clock()
        said = {name: value for name, (value, at) in self._said.items() if now - at <= HAND_SECONDS}
        return said if len(said) == len(self.held) else None

    def influence(self, said: Said | None) -> Changed:
        """The change of a tick, for an engine: the influence of each skill held, none where the hand has let go."""
        skills = (each for each in self.held.values() if each.is_skill)
        return {**UNCHANGED, "influence": {each.place: (said or {}).get(each.name, 0.0) for each in skills}}

    def exchanged(self, commands: Singles, said: Said) -> Singles:
        """The commands [actuators] of a mind with those of the hand in their places."""
        found = commands.copy()
        for each in self.held.values():
            if not each.is_skill:
                found[each.place] = np.float32(said[each.name])
        return found


NO_HAND = Hand({})


def hand_on(graph: Graph, master: str, names: Sequence[str], clock: Callable[[], float] = monotonic) -> Hand:
    """The hand on actuators, and skills below a master, of those names; MindError where one is neither."""
    return Hand({name: _held(graph, master, name) for name in names}, clock)


def _held(graph: Graph, master: str, name: str) -> Held:
    for place, actuator in enumerate(graph.actuators):
        if actuator.name == name:
            kind = actuator.kind
            roles: dict[str | None, Role] = {"wheel": kind.mounted or "", "motor": "ahead", "steering": "turn"}
            return Held(name, False, place, kind.neutral, roles.get(kind.drive, ""))
    below = [skill.name for skill in reachable(graph, master) if skill.name != master]
    if name in below:
        return Held(name, True, graph.skill_numbers[name], 0.0, "")
    if name == master:
        raise MindError(f"{name} is in charge: nothing influences it", "name actuators, or a skill below it")
    known = [*(actuator.name for actuator in graph.actuators), *below]
    near = nearest(name, known)
    hint = f"did you mean {near}?" if near else f"there is {', '.join(known)}"
    raise MindError(f"there is no actuator, and no skill below {master}, called {name}", hint)
