"""What happens in the world of a run: the events of its task, and touching, where no event of the task says it."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np
from mindrun.graph.graph import Task
from mindrun.kinds.registry import names
from numpy.typing import NDArray

from mindlang.run import outcome
from mindlang.view.texts import shown

TOUCH, COLLISION = "touch", "collision"  # kinds of events


@dataclass(slots=True)
class WorldEvents:
    """The events of a task's world, found in the rows of its recording one part after the other."""

    task: Task
    _counts: NDArray[np.uint64] = field(init=False)
    _touched: bool = False

    def __post_init__(self) -> None:
        self._counts = np.zeros(len(self.task.events), np.uint64)

    def data(self) -> list[dict[str, str]]:
        """Their texts and kinds."""
        kinds = self._kinds()
        found = [
            {"text": shown(text), "kind": kind} for text, kind in zip(outcome.events(self.task), kinds, strict=True)
        ]
        return found if self._knows_touch() else [*found, {"text": "touch", "kind": TOUCH}]

    def in_rows(self, rows: NDArray[Any]) -> NDArray[np.bool_]:
        """Which of them happen [ticks, events] in rows that follow those of the call before."""
        world = rows["world"]
        counts = np.concatenate([self._counts[None], world["events"]])
        touching = np.concatenate([[self._touched], world["touching"] != 0])
        self._counts, self._touched = counts[-1], bool(touching[-1])
        happened = [counts[1:] != counts[:-1]]
        if not self._knows_touch():
            happened.append((touching[1:] & ~touching[:-1])[:, None])
        return np.concatenate(happened, axis=1)

    def _knows_touch(self) -> bool:
        """Whether touching goes without saying: an event says it, or there is nothing to touch."""
        return COLLISION in self._kinds() or bool(self.task.scene.environment)

    def _kinds(self) -> list[str]:
        return [names()[type(event)] for event in self.task.events]
