"""The text of a map, as `contains walls is map` reads it, and what was done to get there."""

from dataclasses import dataclass
from pathlib import Path

from mindrun.errors import MindError, reason
from mindrun.files.regular_files import read_whole
from mindrun.kinds.things.map import FLOOR, MAX_MAP_CELLS, START, WALL, Map
from mindrun.kinds.things.thing import MAX_OBSTACLES

METRE_CM = 100.0


class MapError(MindError):
    """A file of which no map can be made."""


def data_of(path: Path, most: int, hint: str = "") -> bytes:
    """All of a file of at most so many bytes; MapError says why it cannot be read."""
    try:
        return read_whole(path, most)
    except (OSError, ValueError) as error:  # a name of a file cannot be any text
        raise MapError(f"{path} cannot be read: {reason(error)}.", hint) from error


@dataclass(frozen=True, slots=True)
class MapText:
    """The lines of a map, the side of a square of it in metres, and sentences that say what was done and rounded."""

    lines: tuple[str, ...]
    cell: float
    said: tuple[str, ...]

    @property
    def fits(self) -> bool:
        """True if a world takes so many squares, and so many walls."""
        squares = len(self.lines) * len(self.lines[0])
        return squares <= MAX_MAP_CELLS and Map(self.lines).obstacles(None) <= MAX_OBSTACLES

    def source(self, name: str) -> tuple[str, ...]:
        """Lines of a mind in which the map, called so, stands with what its letters place; a square is one unit."""
        letters = sorted({each for line in self.lines for each in line} - {WALL, FLOOR, START})
        return (
            f"unit {METRE_CM * self.cell:.6g} cm",
            f"scene Walled is arena size {len(self.lines[0])} {len(self.lines)}",
            f'  contains walls is map from "{name}" cell 1',
            *(f"  contains {'goal' if each in 'gG' else each.lower()} is zone size 1" for each in letters),
        )
