"""Environments that end the program, raise what is no ordinary exception, or say of themselves what is none."""

from typing import Any

import gymnasium
import numpy as np
from gymnasium import spaces

from tests.outside import worlds


class Speechless(Exception):  # noqa: N818  # it is named by what it does
    """An exception that raises another one where it is shown."""

    def __str__(self) -> str:
        """Nothing."""
        raise RuntimeError("no words")


class Failing(worlds.Line):
    """Raises `error` where it is told to: in `make`, `spaces`, `reset`, `step`, `render` or `close`."""

    def __init__(self, render_mode: str | None = None, place: str = "", error: Any = None) -> None:
        self._place, self._error = place, error
        super().__init__(render_mode)
        self._fail("make")

    def _fail(self, place: str) -> None:
        if self._place == place:
            raise self._error

    @property
    def observation_space(self) -> Any:  # type: ignore[override]
        """As ever."""
        self._fail("spaces")
        return worlds.INFINITE

    def reset(self, *, seed: int | None = None, options: Any = None) -> tuple[Any, dict[str, Any]]:
        """As ever."""
        self._fail("reset")
        return super().reset(seed=seed)

    def step(self, action: Any) -> tuple[Any, Any, bool, bool, dict[str, Any]]:
        """As ever."""
        self._fail("step")
        return super().step(action)

    def render(self) -> Any:
        """As ever."""
        self._fail("render")
        return super().render()

    def close(self) -> None:
        """As ever."""
        self._fail("close")


class Saying(worlds.Line):
    """Observes what it was made with."""

    def __init__(self, render_mode: str | None = None, said: Any = None) -> None:
        self._said = said
        super().__init__(render_mode)

    def observed(self) -> Any:
        """That."""
        return self._said


class Box(spaces.Box):
    """A space of somebody's own that is a Box."""


class Odd(worlds.Line):
    """Takes and observes other spaces."""

    def __init__(self, render_mode: str | None = None, observed: Any = None, acted: Any = None) -> None:
        super().__init__(render_mode)
        self.observation_space, self.action_space = observed, acted


class Changing(worlds.Line):
    """Takes and observes other spaces once it has been made by a compiler and by a rollout."""

    made = 0

    def __init__(self, render_mode: str | None = None, observed: Any = None, acted: Any = None) -> None:
        super().__init__(render_mode)
        Changing.made += 1
        if Changing.made > 1:
            self.observation_space, self.action_space = observed, acted


class OwnBox(worlds.Line):
    """The same, whose spaces are of a class of its own."""

    observation_space = Box(-np.inf, np.inf, (2,), np.float64)
    action_space = Box(-1.0, 2.0, (1,), np.float32)


class Loud(worlds.Line):
    """The same, which writes on the descriptor of standard output, as code in C does."""

    def step(self, action: Any) -> tuple[Any, Any, bool, bool, dict[str, Any]]:
        """As ever."""
        import ctypes
        import os

        os.write(1, b"step from C\n")
        ctypes.CDLL(None).puts(b"kept back by C")
        return super().step(action)


ERRORS = {
    "exit": SystemExit(0),
    "exit-words": SystemExit("bye"),
    "base": BaseException("mine"),
    "generator": GeneratorExit(),
    "speechless": Speechless(),
    "stop": StopIteration(),
}


def named(world: type[worlds.Line], **made: Any) -> str:
    """The name of a world that is made so."""
    name = f"hostile/{world.__name__}{len(gymnasium.registry)}-v0"
    gymnasium.register(name, world, kwargs=made)
    return name
