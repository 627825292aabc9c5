"""The images of a run in an environment: the run is made again, in one that draws itself."""

from collections.abc import Callable
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from mindrun.graph.graph import Graph
from mindrun.numbers.arrays import Singles
from mindrun.sim.outside.making import BrokenEnvironmentError
from mindrun.sim.outside.subprocess_stepper import stepper_for
from mindrun.sim.outside.wiring import wiring_of

WITHOUT_PICTURES = "mindc run --trace and --record need no pictures of it."
UNKNOWN_FAILURES = "actuators fail in this task, and a recording does not say when"
TICKS_DRAWN_BEFORE = 10  # what is drawn may grow old by being drawn, such as the sparks of the lunar lander in 7 images

Sent = Callable[[int, int], Singles]


class SeenEpisode:
    """The images of a run, by the tick after which they are: the environment of that seed, given the same commands.

    `sent` gives the commands [ticks, actuators] behind a tick, 0 for the beginning, up to another one. Asked tick after
    tick, each step is made once.
    """

    def __init__(self, graph: Graph, environment: str, folder: Path | None, seed: int, sent: Sent) -> None:
        self._name, self._sent = environment, sent
        self._stepper = stepper_for(environment, folder)
        self._wiring = wiring_of(graph, self._stepper.spaces)
        [self._run] = self._stepper.begin(self._wiring.places, [seed], is_seen=True)
        self._tick = 0
        self._image: NDArray[np.uint8] | None = None  # after that tick

    def image(self, tick: int) -> NDArray[np.uint8]:
        """The image after a tick, 0 for the beginning [height, width, 3], red first.

        BrokenEnvironmentError where it draws nothing, or the run is another one when it is made again.
        """
        if tick == self._tick and self._image is not None:
            return self._image
        if tick < self._tick:
            self._stepper.reset([self._run])
            self._tick = 0
        for number, action in enumerate(self._wiring.actions(self._sent(self._tick, tick).T), self._tick + 1):
            if self._run.is_over:
                said = f"the environment {self._name} does not do the same again: there is no picture of this run"
                raise BrokenEnvironmentError(said, f"It was over after tick {self._tick:,} now. {WITHOUT_PICTURES}")
            self._stepper.step([self._run], action[None])
            self._tick, self._image = number, None
            if tick - TICKS_DRAWN_BEFORE <= number < tick:
                self._drawn()
        self._image = self._drawn()
        return self._image

    def _drawn(self) -> NDArray[np.uint8]:
        try:
            found = self._stepper.image(self._run)
        except BrokenEnvironmentError as error:
            hint = f"{error.why or error} {WITHOUT_PICTURES}"
            raise BrokenEnvironmentError(f"the environment {self._name} cannot be drawn", hint) from error
        if found.ndim != 3 or found.shape[2] != 3 or 0 in found.shape or found.dtype != np.uint8:
            raise BrokenEnvironmentError(f"the environment {self._name} draws no pictures", WITHOUT_PICTURES)
        return found
