"""Promises in the rows of a run that is seen: what became of each in a tick, and how often until then."""

from collections.abc import Collection

import numpy as np
from mindrun.engine.promises import BY_SKILL, PromiseWatcher
from mindrun.graph.graph import Graph
from numpy.typing import NDArray

from mindlang.run.promises import VERDICTS, judged
from mindlang.view.rows import Singles

PROMISE_COLUMNS = 1 + len(VERDICTS)  # of each promise: the verdict in a tick, and how often each came so far


class ViewedPromises:
    """The promises below a master, and what became of them in all rows so far."""

    def __init__(self, graph: Graph, master: str) -> None:
        self._watcher = PromiseWatcher(graph, master)
        self.texts = [f"{skill} {promise.text}" for skill, promise in self._watcher.promises]
        self._times = np.zeros((1, len(self.texts), len(VERDICTS)), np.int64)

    def feed(
        self, readings: Singles, influence: Singles, begins: Collection[int]
    ) -> tuple[NDArray[np.int64], NDArray[np.bool_]]:
        """The columns [rows, promises · PROMISE_COLUMNS] of the next rows, and where each is broken [rows, promises].

        In the rows of `begins` the mind begins anew.
        """
        verdict = judged(self._watcher, readings, influence, begins)[:, :, None]
        times = self._times + np.cumsum(verdict == [*VERDICTS.values()], axis=0)
        self._times = np.concatenate([self._times, times])[-1:]
        return np.concatenate([verdict, times], axis=2).reshape(
            len(verdict), PROMISE_COLUMNS * len(self.texts)
        ), verdict[:, :, 0] >= BY_SKILL
