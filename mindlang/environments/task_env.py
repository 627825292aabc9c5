"""One robot as a `gymnasium.Env`."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from gymnasium import Env
from gymnasium.error import ResetNeeded
from gymnasium.utils import EzPickle

from mindlang.environments.episodes import (
    Floats,
    check_render_mode,
    episodes_of,
    image_of,
    to_actions,
    to_layouts,
    unit_box,
)
from mindlang.pictures.canvas import Image

if TYPE_CHECKING:
    from mindlang.environments.live_view import LiveView

ONE_LANE = np.ones(1, np.bool_)


class TaskEnv(Env[Floats, Floats], EzPickle):
    """A task of a mind, in which an agent commands the actuators, or plays the skill of that name.

    `reset(seed=3)` begins the layout of `mindc run --seed 3`; without a seed, layouts are drawn. The task's ends
    terminate an episode, its time truncates it. Pickled by its arguments: a copy begins anew.

    With `render_mode="human"` the page of `mindc view` shows each step in real time, until `close`; `address` says
    where.
    """

    metadata: dict[str, Any] = {"render_modes": ["rgb_array", "human"]}  # noqa: RUF012  # as gymnasium has it

    def __init__(
        self,
        file: str | Path,
        task: str | None = None,
        master: str | None = None,
        skill: str | None = None,
        render_mode: str | None = None,
    ) -> None:
        EzPickle.__init__(self, file, task, master, skill, render_mode)
        check_render_mode(render_mode, self.metadata)
        self._episodes = episodes = episodes_of(Path(file), task, master, skill, 1)
        self.render_mode = render_mode
        self.metadata = self.metadata | {"render_fps": round(1 / episodes.setup.ready.policy.graph.tick)}
        self.observation_space, self.action_space = unit_box(len(episodes.readings)), unit_box(episodes.actions)
        self._goes_on = False
        self._view: LiveView | None = None
        if render_mode == "human":
            from mindlang.environments.live_view import LiveView  # serves a page: imported where one is asked for

            self._view = LiveView(episodes)

    def reset(self, *, seed: int | None = None, options: dict[str, Any] | None = None) -> tuple[Floats, dict[str, Any]]:
        """Begin another episode; `info["layout"]` is the seed by which `mindc run` repeats it."""
        super().reset(seed=seed)
        self._episodes.begin(ONE_LANE, to_layouts([seed], [self.np_random]))
        self._goes_on = True
        layout = int(self._episodes.seeds[0])
        if self._view:
            self._view.begin(layout)
        return self._episodes.sense()[0], {"layout": layout}

    def step(self, action: Floats) -> tuple[Floats, float, bool, bool, dict[str, Any]]:
        """Step by one tick; with the last of an episode, `info` has its outcome."""
        if not self._goes_on:
            raise ResetNeeded("the episode has ended, or none has begun: call reset()")
        [reward], [terminated], [truncated] = self._episodes.step(to_actions(action, self.action_space.shape)[None])
        self._goes_on = not (terminated or truncated)
        if self._view:
            self._view.show()
        info = {} if self._goes_on else self._episodes.outcome(0)
        return self._episodes.sense()[0], float(reward), bool(terminated), bool(truncated), info

    def render(self) -> Image | None:
        """The world as it is, [height, width, 3] as red, green, blue."""
        return image_of(self._episodes, 0) if self.render_mode == "rgb_array" else None

    @property
    def address(self) -> str | None:
        """Where a browser sees what `render_mode="human"` shows, from the first episode on."""
        return self._view.address if self._view else None

    def close(self) -> None:
        if self._view:
            self._view.close()
