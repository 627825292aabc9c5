"""Environments that are stepped in this process: a worker's, and those that a program has registered itself."""

from collections.abc import Mapping, Sequence
from functools import cached_property
from pathlib import Path
from typing import Any

from mindrun.sim.outside import making
from mindrun.sim.outside.asking import Asked, Asking
from mindrun.sim.outside.episode import Episode
from mindrun.sim.outside.parts import Spaces, spaces_of
from mindrun.sim.outside.taking import Place, Taking, taking_of
from mindrun.work.last_step import LastStep


class Here:
    """Steps environments of that name here; a module before it is looked for in `folder` first."""

    def __init__(self, environment: str, folder: Path | None = None) -> None:
        self.environment, self._folder = environment, folder
        self._asking = Asking(environment)
        self._takings: dict[tuple[Place, ...], Taking] = {}

    @cached_property
    def spaces(self) -> Spaces:
        """What it observes and takes."""
        return spaces_of(*making.spaces(self.environment, self._folder))

    def run(self, places: Sequence[Place], seed: int, is_seen: bool = False) -> Episode:
        """A new environment for the run of a seed, of which the numbers at these places are read."""
        key = tuple(places)
        if key not in self._takings:
            self._takings[key] = taking_of(self.spaces.observed, key)
        _, acted = making.spaces(self.environment, self._folder)
        return Episode(self._asking, self._folder, seed, self._takings[key], acted, self.spaces, is_seen)

    def step(self, runs: Sequence[Episode], actions: Sequence[Mapping[str, Any]]) -> None:
        """Step one after the other."""
        for run, action in zip(runs, actions, strict=True):
            run.step(action)

    def asked(self) -> Asked | None:
        """What has not been answered, seen from another thread."""
        return self._asking.asked()

    def break_off(self) -> None:
        """Nothing: what is asked of this process has to answer."""

    def write_steps(self, last_step: LastStep) -> None:
        """Write each step there from now on."""
        self._asking.last_step = last_step
