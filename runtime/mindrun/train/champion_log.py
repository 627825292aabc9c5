"""The log of champions: the weights of each champion of each attempt, from the generation that found it.

The file begins with a line that names the format, and the number of weights; a row has attempt, generation and the
CRC-32 of the row, and the weights. Where it is full, no more champions are kept, and the training goes on: a new one
comes about every ten generations, so that 1,600 weights (examples/collect) take some 400,000 of them.
"""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from struct import Struct
from zlib import crc32

import numpy as np

from mindrun.files.regular_files import read_whole
from mindrun.graph.weights import Weights
from mindrun.train.lesson_state import LessonState
from mindrun.train.progress import AppendedFiles, Position

CHAMPION_ROWS = "champions.rows"
MAGIC = b"mind champions 1\n"
LENGTH, ROW = Struct("<I"), Struct("<III")  # how many weights; attempt, generation, checksum
MAX_ROWS_BYTES = 1 << 28


@dataclass(frozen=True, slots=True)
class Champion:
    """The best of an attempt from a generation on; both count from 1."""

    attempt: int
    generation: int
    genome: Weights

    @property
    def position(self) -> Position:
        return self.attempt, self.generation


class ChampionLog(AppendedFiles):
    """The file, begun with the champions that it has up to `state`; `warn` is told where it is full."""

    def __init__(self, folder: Path, state: LessonState, warn: Callable[[str], None]) -> None:
        count = state.champions.shape[1]
        here = state.attempt + 1, state.now.population.generation
        kept = [each for each in read_champions(folder) if len(each.genome) == count and each.position <= here]
        super().__init__({folder / CHAMPION_ROWS: MAGIC + LENGTH.pack(count) + b"".join(map(_row, kept))})
        self._left, self._warn = rows_that_fit(count) - len(kept), warn
        self._last = kept[-1] if kept else None

    def append(self, genome: Weights, position: Position) -> None:
        """Add the champion with which a generation ends, unless it was that before."""
        last = self._last
        if last is not None and last.attempt == position[0] and np.array_equal(last.genome, genome):
            return
        self._last = Champion(*position, genome)
        self._left -= 1
        if self._left >= 0:
            self._add(_row(self._last))
        elif self._left == -1:
            self._warn(f"{CHAMPION_ROWS} is full: later champions are not kept by their generation")


def rows_that_fit(weights: int) -> int:
    """How many champions of so many weights the file keeps."""
    return (MAX_ROWS_BYTES - len(MAGIC) - LENGTH.size) // (ROW.size + 4 * weights)


def read_champions(folder: Path) -> list[Champion]:
    """The whole rows of a run's file; none where there is no such file, and none behind a row that is damaged."""
    found = list[Champion]()
    try:
        data = read_whole(folder / CHAMPION_ROWS, MAX_ROWS_BYTES)
    except OSError:
        return found
    begin = len(MAGIC) + LENGTH.size
    if not data.startswith(MAGIC) or len(data) < begin:
        return found
    count = LENGTH.unpack_from(data, len(MAGIC))[0]
    size = ROW.size + 4 * count
    for at in range(begin, len(data) - size + 1, size):
        attempt, generation, _ = ROW.unpack_from(data, at)
        champion = Champion(attempt, generation, np.frombuffer(data, "<f4", count, at + ROW.size))
        last = found[-1].position if found else (0, 0)
        if _row(champion) != data[at : at + size] or not last < champion.position:
            break
        found.append(champion)
    return found


def _row(champion: Champion) -> bytes:
    weights = np.ascontiguousarray(champion.genome, "<f4").tobytes()
    return ROW.pack(*champion.position, crc32(weights, crc32(b"%d %d" % champion.position))) + weights
