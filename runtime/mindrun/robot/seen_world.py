"""How a simulated world stands, for the recording of a dry run: asked for beside the loop, which waits for nobody."""

from collections.abc import Iterator
from contextlib import contextmanager, suppress
from threading import Event, Thread
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mindrun.driver import DeviceError
from mindrun.graph.graph import Task
from mindrun.graph.recording_header import BOX_COLUMNS, GOES_ON, RecordedWorld, world_row_of
from mindrun.robot.drivers.simulated import WorldConnection
from mindrun.robot.simulated_world.protocol import BOXES, WORLD


class SeenWorld:
    """The world at a socket: `about` as it was first, `latest` as it was when a thread asked last."""

    def __init__(self, task: Task, seed: int, socket: str) -> None:
        self._row, self._link = world_row_of(task), WorldConnection(socket)
        self._latest = self._recorded = self._asked()
        self._wanted, self._is_over = Event(), False
        boxes = np.frombuffer(self._link.ask(BOXES), "<f8").reshape(-1, BOX_COLUMNS)
        begin = [*self._latest["pose"][0], *self._latest["things"][0].ravel()]
        self.about = RecordedWorld.of(task, seed, boxes, begin)

    def latest(self) -> NDArray[Any]:
        """The row of it [1] that was asked for when this was called last: a tick ago. Never waits.

        The thread asks anew at once, while the loop has nothing to do until its next tick.
        """
        self._wanted.set()
        self._recorded = self._latest
        return self._recorded

    @property
    def has_ended(self) -> bool:
        """Whether the row that `latest` returned last says how the run has ended."""
        return bool(self._recorded["ended"][0] != GOES_ON)

    @contextmanager
    def watched(self) -> Iterator[None]:
        """Let the thread ask as long as this lasts."""
        thread = Thread(target=self._watch, name="seen_world", daemon=True)
        thread.start()
        try:
            yield
        finally:
            self._is_over = True
            self._wanted.set()
            thread.join()
            self._link.close()

    def _watch(self) -> None:
        while self._wanted.wait() and not self._is_over:
            self._wanted.clear()
            with suppress(DeviceError):  # it answers next time; the loop says where it does not at all
                self._latest = self._asked()

    def _asked(self) -> NDArray[Any]:
        held = self._link.ask(WORLD)
        if len(held) != self._row.itemsize:
            raise DeviceError(f"the simulated world has {len(held)} bytes to be recorded, not {self._row.itemsize}")
        return np.frombuffer(held, self._row)
