"""The robots of one world as a `pettingzoo.ParallelEnv`, an agent each."""

from pathlib import Path
from typing import Any

import numpy as np
from gymnasium.error import ResetNeeded
from gymnasium.spaces import Box
from gymnasium.utils import EzPickle
from gymnasium.utils.seeding import np_random
from mindrun.errors import MindError
from pettingzoo import ParallelEnv

from mindlang.compiler.diagnostic import listed
from mindlang.environments.episodes import Floats, check_render_mode, episodes_of, image_of, to_layouts, unit_box
from mindlang.pictures.canvas import Image

ONE_RUN = np.ones(1, np.bool_)
Infos = dict[str, dict[str, Any]]
Step = tuple[dict[str, Floats], dict[str, float], dict[str, bool], dict[str, bool], Infos]


class ParallelTask(ParallelEnv[str, Floats, Floats], EzPickle):
    """A task of a mind, in which each robot of the world is an agent, and commands its actuators, or plays a skill.

    The agents are `robot_0` for the robot that the mind is of, and `robot_1`, `robot_2` … for those that the task
    contains, in the order of the source. All have the spaces of a `TaskEnv`, of every reading that a skill of any robot
    reads.

    `reset(seed=3)` begins the layout of `mindc run --seed 3`; without a seed, layouts are drawn. The reward of an agent
    is what the reward lines pay its robot in the tick, and 0 for a robot with `paid 0`; the mean over all others,
    summed over an episode, is the score of the run. The task's ends terminate an episode for all agents in the same
    step, its time truncates it for all. Pickled by its arguments: a copy begins anew.
    """

    metadata: dict[str, Any] = {"render_modes": ["rgb_array"]}  # noqa: RUF012  # as pettingzoo has it

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
        frames = round(1 / episodes.setup.ready.policy.graph.tick)
        self.metadata = self.metadata | {"name": episodes.setup.task.name, "render_fps": frames}
        self.possible_agents = [f"robot_{number}" for number in range(episodes.lanes.robots)]
        self.agents: list[str] = []
        seen, sent = len(episodes.readings), episodes.actions
        self.observation_spaces = {agent: unit_box(seen) for agent in self.possible_agents}
        self.action_spaces = {agent: unit_box(sent) for agent in self.possible_agents}
        self.state_space = unit_box(seen * len(self.possible_agents))
        self._stream = np_random()[0]

    def observation_space(self, agent: str) -> Box:
        """The readings of an agent's robot, each in 0..1."""
        return self.observation_spaces[agent]

    def action_space(self, agent: str) -> Box:
        """The commands of an agent, or the outputs of the skill that it plays, each in 0..1."""
        return self.action_spaces[agent]

    def reset(self, seed: int | None = None, options: dict[str, Any] | None = None) -> tuple[dict[str, Floats], Infos]:
        """Begin another episode with all agents; each `info["layout"]` is the seed by which `mindc run` repeats it."""
        if seed is not None:
            self._stream = np_random(seed)[0]
        self._episodes.begin(ONE_RUN, to_layouts([seed], [self._stream]))
        self.agents = [*self.possible_agents]
        layout = int(self._episodes.seeds[0])
        return self._seen(), {agent: {"layout": layout} for agent in self.agents}

    def step(self, actions: dict[str, Floats]) -> Step:
        """Step by one tick, with an action for each agent; with the last step of an episode, `info` has its outcome."""
        if not self.agents:
            raise ResetNeeded("the episode has ended, or none has begun: call reset()")
        if idle := [agent for agent in self.agents if agent not in actions]:
            raise MindError(f"there is no action for {listed(idle)}", "give one for each of `agents`")
        agents = self.agents
        rewards, [terminated], [truncated] = self._episodes.step([actions[agent] for agent in agents])
        is_over = bool(terminated or truncated)
        self.agents = [] if is_over else agents
        return (
            self._seen(),
            dict(zip(agents, rewards.tolist(), strict=True)),
            dict.fromkeys(agents, bool(terminated)),
            dict.fromkeys(agents, bool(truncated)),
            {agent: self._episodes.outcome(0) if is_over else {} for agent in agents},
        )

    def state(self) -> Floats:
        """The readings of all robots, one after the other, as they were last seen."""
        return self._readings.ravel()

    def render(self) -> Image | None:
        """The world as it is, [height, width, 3] as red, green, blue."""
        return image_of(self._episodes, 0) if self.render_mode == "rgb_array" else None

    def _seen(self) -> dict[str, Floats]:
        self._readings = self._episodes.sense()
        return dict(zip(self.possible_agents, self._readings.copy(), strict=True))
