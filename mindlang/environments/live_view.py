"""`render_mode="human"`: the page of `mindc view`, to which each tick of an episode is added when it is made."""

from collections.abc import Iterator
from dataclasses import replace
from logging import getLogger
from math import nan
from queue import Empty, SimpleQueue
from typing import Any

import numpy as np
from mindrun.engine.engine import procedure_sources
from mindrun.graph.bundle import Bundle
from mindrun.graph.graph import Edge
from mindrun.graph.policy import Policy
from mindrun.graph.recording_header import About
from mindrun.kinds.functions.function import Rule
from mindrun.robot.loop import Rate
from numpy.typing import NDArray

from mindlang.environments.episodes import Episodes, as_run
from mindlang.run.recording import recorded_rows, recorded_task, world_of
from mindlang.view.server import BackgroundView, open_browser
from mindlang.view.viewed import Viewed
from mindlang.view.viewed_rows import viewed_rows

Rows = NDArray[Any]
LOOK_SECONDS = 0.05  # after which a thread that waits for a tick looks whether anybody still wants it
SOME, NONE = (("number", 0.5),), (("number", nan),)  # values of edges: any, and nothing sent

log = getLogger(__name__)


class LiveView:
    """The page of `mindc view` for episodes of one lane, in real time: `show` waits until the next tick is due."""

    def __init__(self, episodes: Episodes) -> None:
        self._episodes = episodes
        self._served: BackgroundView | None = None
        self._rate = Rate(episodes.setup.ready.policy.graph.tick)
        self._coming: SimpleQueue[Rows | None] = SimpleQueue()

    @property
    def address(self) -> str | None:
        """Where the page is; None before the first episode."""
        return self._served.address if self._served else None

    def begin(self, seed: int) -> None:
        """An episode has begun with this layout: it is what the page shows from now on."""
        self._end_episode()
        self._about, self._ticks = _about(self._episodes, seed), 0
        viewed = _viewed(self._episodes, self._about, self._coming)
        viewed.grow()
        if self._served:
            self._served.show(viewed)
        else:
            self._served = BackgroundView(viewed)
            tell = log.info if open_browser(self._served.address) else log.warning
            tell("the environment is seen at %s", self._served.address)
        self._rate.begin()

    def show(self) -> None:
        """Add the tick that has been made, which has not been followed by sensing, and wait until it is over."""
        self._ticks += 1
        run = as_run(self._episodes, 0)
        row = recorded_rows(self._about, self._ticks, run, run.events)
        row["world"]["ended"] = run.ended
        if not self._episodes.played:  # no skill has any influence: not one of them acts
            row["influence"] = 0.0
        self._coming.put(row)
        self._rate.wait()

    def close(self) -> None:
        """Serve it no more: a page that is open keeps what it has."""
        self._end_episode()
        if self._served:
            self._served.close()
            self._served = None

    def _end_episode(self) -> None:
        self._coming.put(None)
        self._coming = SimpleQueue()


def _about(episodes: Episodes, seed: int) -> About:
    graph, world = episodes.setup.ready.policy.graph, episodes.lanes.world_columns(0)
    things = world["things"]
    begun = world_of(episodes.setup, seed, episodes.lanes.boxes(0), world["pose"], things[:, :-1], things[:, -1])
    return replace(About.of(graph, "", episodes.setup.master, ()), world=begun)


def _viewed(episodes: Episodes, about: About, coming: "SimpleQueue[Rows | None]") -> Viewed:
    setup, policy = episodes.setup, _shown_policy(episodes)
    bundle = Bundle(policy, procedure_sources(policy.graph, setup.folder, setup.master))
    played = f"{episodes.played} played" if episodes.played else "commanded"
    title = f"{setup.task.name} with {setup.master} in charge, {played} by a program"
    rows = ((row, row["readings"]) for row in _rows(coming, np.zeros(0, about.row)))
    task = recorded_task(about, bundle)
    return viewed_rows(title, "environment", about, bundle, task, setup.folder, rows, None)


def _rows(coming: "SimpleQueue[Rows | None]", nothing: Rows) -> Iterator[Rows]:
    """Rows until None comes; none where nothing has come for a while."""
    while True:
        try:
            row = coming.get(timeout=LOOK_SECONDS)
        except Empty:
            row = nothing
        if row is None:
            return
        yield row


def _shown_policy(episodes: Episodes) -> Policy:
    """The mind in which nobody computes what a program does instead.

    What it sends as a skill to other skills is in no row: nothing is shown of it.
    """
    graph, weights = episodes.lanes.rollout.graph, dict(episodes.setup.ready.policy.weights)
    skills = [*graph.skills]
    if episodes.played:
        weights.pop(episodes.played, None)
        number = graph.skill_numbers[episodes.played]
        edges = tuple(map(_outside, skills[number].edges))
        skills[number] = replace(skills[number], function=Rule(), edges=edges)
    return Policy(replace(graph, skills=tuple(skills)), weights)


def _outside(edge: Edge) -> Edge:
    if edge.output is None:
        return edge
    return replace(edge, output=None, value=NONE if edge.to == "skill" else SOME)
