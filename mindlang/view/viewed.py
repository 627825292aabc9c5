"""A run or a recording while it is seen: rows that come chunk by chunk, and answers about those that are there."""

import base64
from collections.abc import Callable, Iterator, Mapping
from typing import Any

import cv2
import numpy as np
from mindrun.engine.think import Hierarchy
from mindrun.errors import MindError, reason
from mindrun.graph.graph import Graph
from mindrun.robot.hand import Hand
from mindrun.sim.outside.seen import SeenEpisode, Sent
from numpy.typing import NDArray

from mindlang.run.edge_flow import EdgeFlows
from mindlang.view.messages import AskChange, AskColumns, AskRows, RefusedError, error_text, shown
from mindlang.view.rows import (
    DOUBLE_BLOCK,
    SINGLE_BLOCK,
    Columns,
    Doubles,
    RowBlocks,
    Singles,
    TickNumbers,
    columns_frame,
    rows_frame,
    rows_per_frame,
)

Drawing = Callable[[Sent], SeenEpisode]
Image = NDArray[np.uint8]
FLOW_ROWS = 1024  # of a curve of what an edge transmits
MAX_COMPUTED_EDGES = 200_000  # in one answer, so that nobody waits long for another's
MAX_KEPT_BYTES = 2 << 30  # of rows, of a run and of all that are beside it


def data_url(image: Image, kind: str, quality: tuple[int, ...] = ()) -> str:
    """An image [height, width, 3], red first, as an address that a page takes it from; `kind` is png or webp."""
    done, data = cv2.imencode(f".{kind}", image[:, :, ::-1], quality)
    assert done
    return f"data:image/{kind};base64,{base64.b64encode(bytes(data)).decode()}"


class Viewed:
    """A run that is seen: `about` does not change, and `growth` adds some rows each time, from tick 0 on.

    `happened` has pairs of a tick and the number of an event, `stops` of a tick and the breakpoint that holds there; in
    the ticks of `begins` the mind was begun anew. `drawing` is of its environment. What `is_live` grows without being
    asked. `forked` makes the same run with a change, and says that in words; RefusedError where that cannot be, None
    where nothing can be changed. The `hand` drives it here, and `anew` makes the run of another seed; `watched` makes
    the run seen through another robot. One thread lets it `grow`; others may ask at the same time.
    """

    def __init__(
        self,
        about: Mapping[str, Any],
        columns: Columns,
        growth: "Callable[[Viewed], Iterator[bool]]",
        graph: Graph,
        mind: Hierarchy,
        drawing: Drawing | None = None,
        is_live: bool = False,
    ) -> None:
        self.about, self.columns, self.is_live, self.drawing = about, columns, is_live, drawing
        self.begins: set[int] = set()
        self.flows = EdgeFlows(
            graph, mind, lambda ticks: (self.group("readings", ticks), self.group("influence", ticks)), self.begins
        )
        self.forked: Callable[[AskChange], tuple[Viewed, str]] | None = None
        self.hand: Hand | None = None
        self.anew: Callable[[int | None], Viewed] | None = None
        self.watched: Callable[[int], Viewed] | None = None
        self.blocks = RowBlocks()
        self.happened: list[tuple[int, int]] = []
        self.stops: list[tuple[int, str]] = []
        self.over = False
        self.ended_by: str | None = None
        self.failed: str | None = None
        self._growth = growth(self)
        self._seen: SeenEpisode | None = None

    @property
    def known(self) -> int:
        return self.blocks.rows - 1

    @property
    def kept_bytes(self) -> int:
        return self.blocks.kept_bytes + self.flows.kept_bytes

    def grow(self, bytes_elsewhere: int = 0) -> None:
        """Add some rows; where a procedure fails, or memory ends, the run is over and `failed` says why.

        `bytes_elsewhere` are those of other runs, whose rows are kept at the same time.
        """
        has_grown = False
        if bytes_elsewhere + self.kept_bytes > MAX_KEPT_BYTES:
            self.failed = f"more than {MAX_KEPT_BYTES >> 30} GiB of rows, of a run and its forks together, are not kept"
        else:
            try:
                has_grown = next(self._growth, False)
            except MindError as error:
                self.failed = error_text(error)
            except OSError as error:
                self.failed = shown(reason(error))
        self.over = self.over or not has_grown

    def rows(self, asked: AskRows) -> bytes:
        """A frame of rows: as many as are known and fit."""
        fit = rows_per_frame(self.columns.width(DOUBLE_BLOCK), self.columns.width(SINGLE_BLOCK))
        ticks = self.blocks.ticks(asked.first, asked.below, asked.every, min(fit, self._computed_rows))
        return rows_frame(asked, self.doubles(ticks), self.singles(ticks))

    def some_columns(self, asked: AskColumns) -> bytes:
        """A frame of columns; RefusedError where there is no such column."""
        for block, index in asked.columns:
            if index >= self.columns.width(block):
                raise RefusedError(f"there is no column {index} in block {block}")
        kept = self.columns.kept_singles
        blocks, indices = np.array(asked.columns).T
        is_flow = (blocks == SINGLE_BLOCK) & (indices >= kept)
        most = rows_per_frame(len(asked.columns), 0)
        most = min(most, FLOW_ROWS, self._computed_rows) if is_flow.any() else most
        ticks = self.blocks.ticks(asked.first, asked.below, asked.every, most)
        values = np.empty((len(ticks), len(asked.columns)))
        for kept_block in (DOUBLE_BLOCK, SINGLE_BLOCK):
            chosen = (blocks == kept_block) & ~is_flow
            values[:, chosen] = self.blocks.kept(kept_block, ticks, indices[chosen])
        if is_flow.any():
            values[:, is_flow] = self.flows.transmitted(ticks)[:, indices[is_flow] - kept]
        return columns_frame(asked, values)

    def doubles(self, ticks: TickNumbers) -> Doubles:
        return self.blocks.kept(DOUBLE_BLOCK, ticks)

    def singles(self, ticks: TickNumbers) -> Singles:
        """The singles [ticks, columns] with what each edge transmits."""
        return np.concatenate([self.blocks.kept(SINGLE_BLOCK, ticks), self.flows.transmitted(ticks)], axis=1)

    def image(self, tick: int) -> Image:
        """The environment's image after a tick [height, width, 3], red first.

        RefusedError where nothing does, or the tick is not known; MindError where it cannot.
        """
        if self.drawing is None or tick > self.known:
            raise RefusedError("there is no image of this tick")
        if self._seen is None:
            self._seen = self.drawing(self._sent)
        return self._seen.image(tick)

    def _sent(self, first: int, last: int) -> Singles:
        """The commands that reached the actuators after tick `first`, up to `last`; of a run, the mind's own."""
        return self.group("sent" if "sent" in self.columns else "commands", np.arange(first + 1, last + 1))

    def group(self, name: str, ticks: TickNumbers) -> NDArray[Any]:
        """The columns [ticks, count] of a group that is kept."""
        return self.blocks.kept(self.columns[name].block, ticks, self.columns[name].places)

    @property
    def _computed_rows(self) -> int:
        return max(1, MAX_COMPUTED_EDGES // max(1, len(self.flows.links)))
