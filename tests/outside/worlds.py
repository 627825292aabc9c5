"""Environments for the tests, registered with Gymnasium: plain arithmetic, and others that do what none may do."""

from typing import Any

import gymnasium
import numpy as np
from gymnasium.spaces import Box, Dict, Discrete, MultiDiscrete

INFINITE = Box(-np.inf, np.inf, (2,), np.float64)


class Line(gymnasium.Env[Any, Any]):
    """A point on a line that is pushed, and wanders a little; the reward is how near it is to 0; it ends beyond 3."""

    observation_space = INFINITE
    action_space = Box(-1.0, 2.0, (1,), np.float32)
    metadata = {"render_modes": ["rgb_array"]}  # noqa: RUF012  # as Gymnasium has it
    steps = 0
    closed = 0  # how many have been closed

    def __init__(self, render_mode: str | None = None) -> None:
        self.render_mode = render_mode

    def render(self) -> Any:
        """A white point in the dark, for as many columns as it is from the left."""
        image = np.zeros((40, 60, 3), np.uint8)
        image[18:22, int(np.clip(30 + 9 * self.place, 1, 58))] = 255
        return image

    def close(self) -> None:
        """Counted."""
        Line.closed += 1

    def reset(self, *, seed: int | None = None, options: Any = None) -> tuple[Any, dict[str, Any]]:
        """Anywhere between −1 and 1, at rest."""
        super().reset(seed=seed)
        self.place, self.speed, self.steps = float(self.np_random.uniform(-1, 1)), 0.0, 0
        return self.observed(), {}

    def step(self, action: Any) -> tuple[Any, Any, bool, bool, dict[str, Any]]:
        """Pushed by the action."""
        self.steps += 1
        self.speed += 0.1 * float(self.push(action)) + float(self.np_random.normal(0, 0.01))
        self.place += self.speed
        return self.observed(), -abs(self.place), abs(self.place) > 3, False, {}

    def push(self, action: Any) -> Any:
        """What an action does."""
        assert self.action_space.contains(action), action
        return action[0]

    def observed(self) -> Any:
        """Place and speed."""
        return np.array([self.place, self.speed])


class Parts(Line):
    """The same, of which everything is observed in parts, and which takes one of four actions."""

    observation_space = Dict({"point": Dict({"at": Box(-9, 9, (1, 2))}), "late": Discrete(2)})
    action_space = Discrete(4, start=1)

    def push(self, action: Any) -> Any:
        """To the left, not at all, to the right, twice."""
        assert self.action_space.contains(action), action
        return (-1, 0, 1, 2)[action - 1]

    def observed(self) -> Any:
        """Place and speed, and whether it has taken long."""
        return {"point": {"at": np.array([[self.place, self.speed]], np.float32)}, "late": np.int64(self.steps > 5)}


class Several(Line):
    """The same, of which two choices are taken at once: how far, and to where."""

    action_space = MultiDiscrete([3, 2])

    def push(self, action: Any) -> Any:
        """So much, to one side or the other."""
        assert self.action_space.contains(action), action
        return action[0] * (1 if action[1] else -1)


class Raising(Line):
    """The same, which fails in its third step."""

    def observed(self) -> Any:
        """Nothing, later on."""
        if self.steps == 3:
            raise RuntimeError("the motor is hot\nreally")
        return super().observed()


class Misshapen(Line):
    """The same, which observes other than it says."""

    def observed(self) -> Any:
        """Too much, later on."""
        return np.zeros(3) if self.steps == 2 else super().observed()


class Blind(Line):
    """The same, which observes nothing that is a number."""

    def observed(self) -> Any:
        """NaN, later on."""
        return super().observed() * (np.nan if self.steps else 1)


class Generous(Line):
    """The same, which pays what is no number."""

    def step(self, action: Any) -> tuple[Any, Any, bool, bool, dict[str, Any]]:
        """Paid with NaN."""
        observed, _, *rest = super().step(action)
        return observed, np.nan, *rest


class Impatient(Line):
    """The same, which breaks a run off in its fourth step."""

    def step(self, action: Any) -> tuple[Any, Any, bool, bool, dict[str, Any]]:
        """Truncated, then no step may follow."""
        if self.steps >= 4:
            raise RuntimeError("a step after the run was broken off")
        observed, reward, ended, _, info = super().step(action)
        return observed, reward, ended, self.steps == 4, info


class Unseen(Line):
    """The same, which cannot be made to be seen."""

    def __init__(self) -> None:
        super().__init__()


class Dark(Line):
    """The same, which cannot draw itself."""

    def render(self) -> Any:
        """Not possible."""
        raise ImportError("there is no pencil")


class Empty(Line):
    """The same, which draws nothing."""

    def render(self) -> Any:
        """Nothing."""
        return None


class Sparks(Line):
    """The same, in which every step leaves a spark, which grows old by being drawn."""

    def reset(self, *, seed: int | None = None, options: Any = None) -> tuple[Any, dict[str, Any]]:
        """None yet."""
        self.sparks: list[int] = []
        return super().reset(seed=seed, options=options)

    def step(self, action: Any) -> tuple[Any, Any, bool, bool, dict[str, Any]]:
        """One more."""
        self.sparks.append(5)
        return super().step(action)

    def render(self) -> Any:
        """As many bright rows as there are sparks."""
        image = super().render()
        self.sparks = [left - 1 for left in self.sparks if left]
        image[: len(self.sparks), :3] = 255
        return image


class Moody(Line):
    """The same, each of which has a shorter run than the one before."""

    made = 0

    def __init__(self, render_mode: str | None = None) -> None:
        super().__init__(render_mode)
        Moody.made += 1
        self.longest = max(2, 30 - 5 * Moody.made)

    def step(self, action: Any) -> tuple[Any, Any, bool, bool, dict[str, Any]]:
        """Broken off."""
        observed, reward, ended, _, info = super().step(action)
        return observed, reward, ended, self.steps >= self.longest, info


class Unmade(Line):
    """The same, which needs what is not installed."""

    def __init__(self, render_mode: str | None = None) -> None:
        raise ImportError("no physics here")


class Worn(Line):
    """The same, which is another one after each run: so is BipedalWalker."""

    runs = 0

    def reset(self, *, seed: int | None = None, options: Any = None) -> tuple[Any, dict[str, Any]]:
        """As ever, but a little further from where it was."""
        self.runs += 1
        super().reset(seed=seed)
        self.place += 0.01 * self.runs
        return self.observed(), {}


OTHERS = Raising, Misshapen, Blind, Generous, Impatient, Unseen, Dark, Empty, Sparks, Moody, Unmade
ALL = (Worn, Line, Parts, Several, *OTHERS)


def register() -> None:
    """Make them known, once; with a limit of steps that a mind does not have."""
    for cls in ALL:
        if name(cls) not in gymnasium.registry:
            gymnasium.register(name(cls), cls, max_episode_steps=7)


def name(cls: type[Line]) -> str:
    """What an environment is called."""
    return f"tests/{cls.__name__}-v0"
