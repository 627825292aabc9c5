"""A run or a recording while it is seen: rows that come chunk by chunk, and answers about those that are there."""

from __future__ import annotations

import base64
from collections.abc import Callable, Iterator, Mapping, Sequence, Set
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path
from typing import Any

import cv2
import numpy as np
from mindrun.engine.think import Hierarchy, hierarchy
from mindrun.errors import MindError, reason
from mindrun.graph.graph import Graph, Skill, Task
from mindrun.graph.policy import Policy
from mindrun.graph.weights import reachable
from mindrun.sim.outside.seen import UNKNOWN_FAILURES, SeenEpisode, Sent
from numpy.typing import NDArray

from mindlang.run.edge_flow import EdgeFlows
from mindlang.view.messages import AskColumns, AskRows, Change, RefusedError
from mindlang.view.rows import (
    DOUBLE_BLOCK,
    FLOW,
    SINGLE_BLOCK,
    Chunk,
    Columns,
    Doubles,
    RowBlocks,
    Singles,
    TickNumbers,
    columns_frame,
    rows_frame,
    rows_that_fit,
)
from mindlang.view.texts import error_text, shown

Drawing = Callable[[Sent], SeenEpisode]
Image = NDArray[np.uint8]
FLOW_ROWS = 1024  # of a curve of what an edge transmits
MAX_COMPUTED_EDGES = 200_000  # in one answer, so that nobody waits long for another's
MAX_KEPT_BYTES = 2 << 30  # of rows, of a run and of all that are beside it
Answer = dict[str, Any]


def drawing_of(graph: Graph, task: Task | None, folder: Path, seed: int) -> Drawing | None:
    """What draws the run of a task; None where its world is no environment."""
    if task is None or not task.scene.environment:
        return None
    return _undrawn if task.fails else partial(SeenEpisode, graph, task.scene.environment, folder, seed)


def _undrawn(sent: Sent) -> SeenEpisode:
    raise MindError(UNKNOWN_FAILURES, "mindc run --picture and --video draw such a run")


def data_url(image: Image, kind: str, quality: tuple[int, ...] = ()) -> str:
    """An image [height, width, 3], red first, as an address that a page takes it from; `kind` is png or webp."""
    done, data = cv2.imencode(f".{kind}", image[:, :, ::-1], quality)
    assert done
    return f"data:image/{kind};base64,{base64.b64encode(bytes(data)).decode()}"


@dataclass(frozen=True, slots=True)
class SeenMind:
    """The mind of a run: the `skills` that its master reaches, made ready with the sources of their procedures.

    `begins` are the ticks in which it was begun anew; of a recording they come with the rows.
    """

    policy: Policy
    master: str
    skills: Sequence[Skill]
    hierarchy: Hierarchy
    begins: Set[int]

    @classmethod
    def of(cls, policy: Policy, sources: Mapping[str, str], master: str, begins: Set[int] = frozenset({1})) -> SeenMind:
        """The mind with that master; WeightsError or ProcedureError where a skill cannot be made ready."""
        skills = reachable(policy.graph, master)
        return cls(policy, master, skills, hierarchy(policy, sources, master), begins)

    @property
    def edges(self) -> int:
        """How many edges its skills have."""
        return sum(len(skill.edges) for skill in self.skills)


@dataclass(eq=False, slots=True)
class Viewed:
    """`about` is what does not change, `chunks` what is still to come; the first chunk begins with tick 0.

    `forked` makes the same run with a change; RefusedError where that cannot be, None where nothing can be changed.
    `delay` says, where it is so, what has to be done first and takes a while. `drawing` is of its environment. One
    thread lets it `grow`; others may ask at the same time. What `is_live` grows without being asked.
    """

    about: Mapping[str, Any]
    columns: Columns
    chunks: Iterator[Chunk]
    mind: SeenMind
    forked: Callable[[Change], Fork] | None = None
    delay: Callable[[], str | None] = lambda: None
    is_live: bool = False
    drawing: Drawing | None = None
    blocks: RowBlocks = field(default_factory=RowBlocks)
    happened: list[tuple[int, int]] = field(default_factory=list)
    stops: list[tuple[int, str]] = field(default_factory=list)
    over: bool = False
    ended_by: str | None = None
    failed: str | None = None
    flows: EdgeFlows = field(init=False)
    _seen: SeenEpisode | None = None

    def __post_init__(self) -> None:
        """One walker of what flows, for all who ask; rows are ticks, and in the first of them nothing flows."""

        def rows(ticks: TickNumbers) -> tuple[Singles, Singles]:
            return self.group("readings", ticks), self.group("influence", ticks)

        self.flows = EdgeFlows(self.mind.policy.graph, self.mind.hierarchy, rows, self.mind.begins)

    @property
    def known(self) -> int:
        """The last tick that can be asked for."""
        return self.blocks.rows - 1

    @property
    def kept_bytes(self) -> int:
        """Of its rows, and of what flowed in them."""
        return self.blocks.kept_bytes + self.flows.kept_bytes

    def grow(self, bytes_elsewhere: int = 0) -> None:
        """One chunk more; where a procedure fails, or memory ends, the run is over and `failed` says why.

        `bytes_elsewhere` are those of other runs, whose rows are kept at the same time.
        """
        if bytes_elsewhere + self.kept_bytes > MAX_KEPT_BYTES:
            self.failed, self.over = (
                f"more than {MAX_KEPT_BYTES >> 30} GiB of rows, of a run and its forks together, are not kept",
                True,
            )
            return
        try:
            chunk = next(self.chunks, None)
        except MindError as error:
            self.failed = error_text(error)
            chunk = None
        except OSError as error:
            self.failed, chunk = shown(reason(error)), None
        if chunk is None:
            self.over = True
            return
        self.happened.extend(chunk.happened)
        self.stops.extend(chunk.stops)
        self.blocks.append(chunk)
        self.ended_by, self.over = chunk.ended_by, chunk.is_last

    def rows(self, asked: AskRows) -> bytes:
        """A frame of rows: as many as are known and fit."""
        fit = rows_that_fit(self.columns.width(DOUBLE_BLOCK), self.columns.width(SINGLE_BLOCK))
        ticks = self.blocks.ticks(asked.first, asked.below, asked.every, min(fit, self._computed_rows))
        header = asked.fork, asked.ask, asked.first, asked.every
        return rows_frame(*header, self.blocks.doubles(ticks), self.singles(ticks))

    def some_columns(self, asked: AskColumns) -> bytes:
        """A frame of columns; RefusedError where there is no such column."""
        for block, index in asked.columns:
            if index >= self.columns.width(block):
                raise RefusedError(f"there is no column {index} in block {block}")
        flows = any(block == SINGLE_BLOCK and index >= self.columns.kept_singles for block, index in asked.columns)
        most = rows_that_fit(len(asked.columns), 0)
        most = min(most, FLOW_ROWS, self._computed_rows) if flows else most
        ticks = self.blocks.ticks(asked.first, asked.below, asked.every, most)
        header = asked.fork, asked.ask, asked.first, asked.every
        return columns_frame(*header, self._asked(asked.columns, ticks))

    def _asked(self, asked: Sequence[tuple[int, int]], ticks: TickNumbers) -> Doubles:
        """Columns [ticks, asked] as doubles; nothing else is gathered."""
        kept = self.columns.kept_singles
        found = np.empty((len(ticks), len(asked)))
        blocks, indices = np.array(asked).T
        for chosen, read in (
            (blocks == DOUBLE_BLOCK, lambda columns: self.blocks.doubles(ticks, columns)),
            ((blocks == SINGLE_BLOCK) & (indices < kept), lambda columns: self.blocks.singles(ticks, columns)),
            (
                (blocks == SINGLE_BLOCK) & (indices >= kept),
                lambda columns: self._flow(ticks)[:, columns - kept],
            ),
        ):
            if chosen.any():
                found[:, chosen] = read(indices[chosen])
        return found

    def singles(self, ticks: TickNumbers) -> Singles:
        """The singles [ticks, columns] with what each edge transmits."""
        kept = self.blocks.singles(ticks)
        return np.concatenate([kept, self._flow(ticks)], axis=1) if FLOW in self.columns.groups else kept

    def _flow(self, ticks: TickNumbers) -> Singles:
        return self.flows.transmitted(ticks)

    def image(self, tick: int) -> Image:
        """What its environment draws after a tick [height, width, 3], red first.

        RefusedError where nothing does, or the tick is not known; MindError where it cannot.
        """
        if self.drawing is None or tick > self.known:
            raise RefusedError("there is no image of this tick")
        if self._seen is None:
            self._seen = self.drawing(self._sent)
        return self._seen.image(tick)

    def _sent(self, first: int, last: int) -> Singles:
        """What reached the actuators behind a tick, up to another one; of a run that is all that its rows have."""
        return self.group("sent" if "sent" in self.columns.groups else "commands", np.arange(first + 1, last + 1))

    def group(self, name: str, ticks: TickNumbers) -> NDArray[Any]:
        """The columns [ticks, count] of a group that is kept."""
        group = self.columns[name]
        columns = range(group.first, group.first + group.count)
        is_double = group.block == DOUBLE_BLOCK
        return self.blocks.doubles(ticks, columns) if is_double else self.blocks.singles(ticks, columns)

    @property
    def _computed_rows(self) -> int:
        """Of how many rows it is computed at once what each edge transmits."""
        return max(1, MAX_COMPUTED_EDGES // max(1, self.mind.edges))


@dataclass(frozen=True, slots=True)
class Fork:
    """A run beside another, from a tick on: what is changed, in words."""

    viewed: Viewed
    text: str
