"""Mazes as micromouse contests draw them: a post at each corner, + or o, walls of - and | between them, S and G."""

from collections import Counter
from dataclasses import dataclass
from itertools import product
from pathlib import Path

from mindrun.kinds.things.map import FLOOR, WALL

from mindlang.compiler.source import MAX_SOURCE_BYTES, decode_source
from mindlang.maps.map_text import METRE_CM, MapError, MapText, data_of

POSTS, GAP = "+o", " "
CLASSIC_CELLS = 16  # along a side of a maze whose cells are 18 cm wide; those of a larger one are half as wide
CLASSIC_METRES, CLASSIC_WALL_METRES = 0.18, 0.012
FORM = "A maze has posts, + or o, and walls of - and | from post to post: +---+---+"

Cell = tuple[int, int]  # its row and its column


def read_maze(path: Path) -> MapText:
    """The maze that is drawn in a text file; MapError says which character is none of one."""
    try:
        text = decode_source(data_of(path, MAX_SOURCE_BYTES))
    except ValueError as error:
        raise MapError(f"{path} {error}.", FORM) from error
    drawing = _drawing(path, text)
    letters = drawing.letters()
    found = (drawing.drawn(apart, letters) for apart in range(drawing.wide, 1, -1))
    if (fitting := next((each for each in found if each.fits), None)) is None:
        raise MapError(f"{path} has {drawing.columns} x {drawing.rows} cells, more than a world takes.")
    return fitting


def _drawing(path: Path, text: str) -> "_Drawing":
    """The drawing that begins with the first line of posts, and ends with the last."""
    lines = [line.rstrip() for line in text.split("\n")]
    above = next((number for number, line in enumerate(lines) if line), 0)
    left = len(lines[above]) - len(lines[above].lstrip())
    lines = [line[left:] for line in lines[above:]]
    first, posts = lines[0], [number for number, line in enumerate(lines) if line and line[0] in POSTS]
    columns = [number for number, mark in enumerate(first) if mark in POSTS]
    if len(posts) < 2 or len(columns) < 2 or min(posts[1], columns[1]) < 2 or columns[0] > 0 or posts[0] > 0:
        raise MapError(f"{path} is no drawing of a maze.", FORM)
    wide, high = columns[1], posts[1]
    rows, far = (len(lines[: posts[-1] + 1]) - 1) // high, (len(first) - 1) // wide
    drawing = _Drawing(path, tuple(line.ljust(far * wide + 1) for line in lines), wide, high, far, rows, above, left)
    drawing.check()
    return drawing


@dataclass(frozen=True, slots=True)
class _Drawing:
    """A drawing whose posts stand `wide` characters and `high` lines apart; `above` and `left` of it is nothing."""

    path: Path
    lines: tuple[str, ...]
    wide: int
    high: int
    columns: int
    rows: int
    above: int
    left: int

    def check(self) -> None:
        """MapError at the first character that is not in its place."""
        for y, line in enumerate(self.lines):
            is_below = y > self.rows * self.high
            for x, mark in enumerate(line):
                may_be = "" if is_below or x > self.columns * self.wide else self._marks(x, y)
                if mark != GAP and mark not in may_be and not (may_be == GAP and mark.isalpha()):
                    where = f"line {y + self.above + 1}, column {x + self.left + 1}"
                    raise MapError(f"{self.path} has {mark!r} in {where}, where it cannot stand.", FORM)

    def _marks(self, x: int, y: int) -> str:
        if x % self.wide:
            return GAP if y % self.high else "-"
        return "|" if y % self.high else POSTS

    def letters(self) -> dict[Cell, str]:
        """The letter in each cell that has one, S and G as capitals; MapError where it has several."""
        found: dict[Cell, str] = {}
        for row, column in product(range(self.rows), range(self.columns)):
            x, y = column * self.wide + 1, row * self.high + 1
            marks = "".join(line[x : x + self.wide - 1] for line in self.lines[y : y + self.high - 1]).replace(GAP, "")
            if len(marks) > 1:
                where = f"line {y + self.above + 1}, column {x + self.left + 1}"
                raise MapError(f"{self.path} has {marks} in one cell ({where}).", "Write one letter, or none.")
            if marks:
                found[row, column] = marks.upper() if marks in "sg" else marks
        return found

    def drawn(self, apart: int, letters: dict[Cell, str]) -> MapText:
        """The text of a map in which the posts stand so many squares apart."""
        from_y = [self._at(each, apart, self.high) for each in range(self.rows * apart + 1)]
        from_x = [self._at(each, apart, self.wide) for each in range(self.columns * apart + 1)]
        squares = [[WALL if self.lines[y][x] in "+o-|" and self._marks(x, y) != GAP else FLOOR for x in from_x]
                   for y in from_y]  # fmt: skip
        for (row, column), mark in letters.items():
            squares[row * apart + apart // 2][column * apart + apart // 2] = mark
        cell = CLASSIC_METRES / (1 if max(self.columns, self.rows) <= CLASSIC_CELLS else 2)
        return MapText(tuple(map("".join, squares)), cell / apart, self._said(apart, letters, cell))

    @staticmethod
    def _at(square: int, apart: int, of: int) -> int:
        """The line, or the column, of the drawing that a square is made of."""
        cell, inside = divmod(square, apart)
        return cell * of + (1 + (inside - 1) * (of - 1) // (apart - 1) if inside else 0)

    def _said(self, apart: int, letters: dict[Cell, str], cell: float) -> tuple[str, ...]:
        many = Counter(letters.values())
        places = [f"{mark} in cell {column + 1}, {self.rows - row}" for (row, column), mark in letters.items()
                  if many[mark] == 1]  # fmt: skip
        places += [f"{mark} in {count} cells" for mark, count in many.items() if count > 1]
        side, wall = METRE_CM * cell, METRE_CM * CLASSIC_WALL_METRES * cell / CLASSIC_METRES
        return (
            f"{self.columns} x {self.rows} cells; {', '.join(sorted(places, reverse=True)) or 'no letter in any'}",
            f"a cell is taken to be {side:g} cm wide: a drawing has no measure",
            f"walls are one square thick, {side / apart:.3g} cm; those of a contest have {wall:.2g} cm",
        )
