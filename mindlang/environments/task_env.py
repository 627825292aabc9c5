"""One robot as a `gymnasium.Env`, or many side by side as a `gymnasium.vector.VectorEnv`: each a world of its own."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from operator import index
from pathlib import Path
from typing import TYPE_CHECKING, Any, SupportsIndex

import numpy as np
from gymnasium import Env
from gymnasium.error import ResetNeeded
from gymnasium.utils import EzPickle
from gymnasium.utils.seeding import np_random
from gymnasium.vector import AutoresetMode, VectorEnv
from gymnasium.vector.utils import batch_space
from mindrun.errors import MindError
from mindrun.numbers.arrays import Bools
from numpy.typing import NDArray

from mindlang.environments.episodes import (
    Episodes,
    Floats,
    check_render_mode,
    episodes_of,
    image_of,
    to_actions,
    to_layouts,
    unit_box,
)
from mindlang.pictures.canvas import Image
from mindlang.run.setup import layouts as children

if TYPE_CHECKING:
    from mindlang.environments.live_view import LiveView

ONE_LANE = np.ones(1, np.bool_)
Seeds = SupportsIndex | Sequence[SupportsIndex | None] | NDArray[np.integer] | None
Step = tuple[Floats, NDArray[np.float64], Bools, Bools, dict[str, Any]]


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
        self._episodes = episodes = _alone(episodes_of(Path(file), task, master, skill, 1))
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


class TaskVectorEnv(VectorEnv[Floats, Floats, NDArray[Any]], EzPickle):
    """`num_envs` episodes of a task: those that as many `TaskEnv`s would have, to the bit.

    `reset(seed=n)` gives robot i the layout of `mindc run --seed n/i`, from 1 on, which no other seed has. After an
    episode the next step begins another one and ignores the action ("NextStep"); with `autoreset_mode="SameStep"` the
    last step does, and `info["final_obs"]` has what was seen.
    """

    metadata: dict[str, Any] = {"render_modes": ["rgb_array"]}  # noqa: RUF012  # as gymnasium has it

    def __init__(
        self,
        file: str | Path,
        task: str | None = None,
        master: str | None = None,
        skill: str | None = None,
        render_mode: str | None = None,
        *,
        num_envs: int = 1,
        autoreset_mode: str | AutoresetMode = AutoresetMode.NEXT_STEP,
    ) -> None:
        EzPickle.__init__(
            self, file, task, master, skill, render_mode, num_envs=num_envs, autoreset_mode=autoreset_mode
        )
        check_render_mode(render_mode, self.metadata)
        if not isinstance(num_envs, SupportsIndex) or index(num_envs) < 1:
            raise MindError(f"there cannot be {num_envs!r} robots", "num_envs is a whole number, 1 or more")
        mode = AutoresetMode(autoreset_mode)
        if mode == AutoresetMode.DISABLED:
            raise MindError("episodes cannot be begun one by one", 'autoreset_mode is "NextStep" or "SameStep"')
        self._episodes = episodes = _alone(episodes_of(Path(file), task, master, skill, num_envs))
        frames = round(1 / episodes.setup.ready.policy.graph.tick)
        self.metadata = self.metadata | {"autoreset_mode": mode, "render_fps": frames}
        self.num_envs, self.render_mode = num_envs, render_mode
        self.single_observation_space = unit_box(len(episodes.readings))
        self.single_action_space = unit_box(episodes.actions)
        self.observation_space = batch_space(self.single_observation_space, num_envs)
        self.action_space = batch_space(self.single_action_space, num_envs)
        self._at_once = mode == AutoresetMode.SAME_STEP
        self._streams: list[np.random.Generator] = []
        self._over = np.zeros(num_envs, np.bool_)

    def reset(self, *, seed: Seeds = None, options: dict[str, Any] | None = None) -> tuple[Floats, dict[str, Any]]:
        """Begin another episode everywhere; `info["layout"]` has the seeds by which `mindc run` repeats them."""
        if options and "reset_mask" in options:
            raise MindError("episodes cannot be begun one by one", "reset() without reset_mask begins all")
        seeds = _seeds(seed, self.num_envs)
        before = self._streams or [np_random()[0] for _ in seeds]
        self._streams = [
            stream if one is None else np_random(one)[0] for stream, one in zip(before, seeds, strict=True)
        ]
        everywhere = np.ones(self.num_envs, np.bool_)
        self._episodes.begin(everywhere, to_layouts(seeds, self._streams))
        self._over[:] = False
        return self._episodes.sense(), self._begun(everywhere, {})

    def step(self, actions: Floats) -> Step:
        """Step all robots by one tick; `info` has the outcomes of what has ended, and the layouts of what has begun."""
        if not self._streams:
            raise ResetNeeded("no episode has begun: call reset()")
        rewards, terminated, truncated = self._episodes.step(actions)
        infos: dict[str, Any] = {}
        if self._at_once:
            begins = terminated | truncated
            if begins.any():
                for lane, seen in zip(np.flatnonzero(begins).tolist(), self._episodes.last_seen(begins), strict=True):
                    self._add_info(infos, {"final_obs": seen, "final_info": self._outcome(lane)}, lane)
        else:
            begins = self._over
            rewards[begins], terminated[begins], truncated[begins] = 0.0, False, False
            self._over = terminated | truncated
            for lane in np.flatnonzero(self._over).tolist():
                infos = self._add_info(infos, self._outcome(lane), lane)
        if begins.any():
            chosen = np.flatnonzero(begins).tolist()
            self._episodes.begin(begins, to_layouts([None] * len(chosen), [self._streams[i] for i in chosen]))
            infos = self._begun(begins, infos)
        return self._episodes.sense(), rewards, terminated, truncated, infos

    def render(self) -> tuple[Image, ...] | None:
        """The world of each robot, [height, width, 3] as red, green, blue."""
        if self.render_mode != "rgb_array":
            return None
        return tuple(image_of(self._episodes, lane) for lane in range(self.num_envs))

    def _outcome(self, lane: int) -> dict[str, Any]:
        """The outcome of a lane's episode, with its layout as an int, which may be too large for numpy's."""
        return self._episodes.outcome(lane) | {"layout": self._episodes.seeds[lane]}

    def _begun(self, lanes: Bools, infos: dict[str, Any]) -> dict[str, Any]:
        for lane in np.flatnonzero(lanes).tolist():
            infos = self._add_info(infos, {"layout": self._episodes.seeds[lane]}, lane)
        return infos


def _alone(episodes: Episodes) -> Episodes:
    """The episodes; MindError where several robots are in the world of each."""
    if episodes.lanes.robots > 1:
        name, robots = episodes.setup.task.name, episodes.lanes.robots
        raise MindError(
            f"{name} has {robots} robots, and this has one agent",
            "mindlang.environments.ParallelTask has an agent for each",
        )
    return episodes


def _seeds(given: Seeds, count: int) -> list[int | None]:
    """The seed of each robot; MindError where they are none, or not so many."""
    given = given.tolist() if isinstance(given, np.ndarray) else given
    match given:
        case None:
            return [None] * count
        case SupportsIndex():
            return [*children(index(given), count)]
        case str() | bytes() | Mapping():
            raise MindError(f"{given!r:.60} is no seed", "a seed is a whole number, 0 or more")
    try:
        seeds = [None if each is None else index(each) for each in given]
    except TypeError as error:
        raise MindError(f"{given!r:.60} are no seeds", "a seed is a whole number, 0 or more") from error
    if len(seeds) != count:
        raise MindError(f"there are {len(seeds)} seeds for {count} robots", "give one, or one for each")
    return seeds
