"""Offsets of a text ↔ an editor's lines and columns, which count UTF-16 units unless both sides agree on others."""

import re
from bisect import bisect_right
from dataclasses import dataclass
from functools import cached_property, lru_cache

CACHED_RULERS = 16  # of texts that are remembered
_LINE_END = re.compile(r"\r\n|\n|\r")


@dataclass(frozen=True)
class Ruler:
    """The lines of a text as the protocol counts them: a lone carriage return ends one, too."""

    text: str
    encoding: str = "utf-16"

    @cached_property
    def starts(self) -> list[int]:
        """The offset at which each line begins."""
        return [0, *(end.end() for end in _LINE_END.finditer(self.text))]

    def offset(self, line: int, column: int) -> int:
        """The offset of a place; one behind the end of its line, or of the text, is that end."""
        if line < 0 or line >= len(self.starts):
            return 0 if line < 0 else len(self.text)
        start, end = self.starts[line], self._end(line)
        if self._is_plain:
            return min(start + max(column, 0), end)
        return start + self._characters(self.text[start:end], max(column, 0))

    def place(self, offset: int) -> tuple[int, int]:
        """The line and the column of an offset."""
        offset = min(max(offset, 0), len(self.text))
        line = bisect_right(self.starts, offset) - 1
        start = self.starts[line]
        if self._is_plain:
            return line, offset - start
        return line, self._units(self.text[start:offset])

    @cached_property
    def _is_plain(self) -> bool:
        """Whether a column is a number of characters, whatever is counted."""
        return self.encoding == "utf-32" or self.text.isascii()

    def _end(self, line: int) -> int:
        """Where the characters of a line end."""
        if line + 1 == len(self.starts):
            return len(self.text)
        end = self.starts[line + 1]
        return end - (2 if self.text[end - 2 : end] == "\r\n" else 1)

    def _units(self, text: str) -> int:
        """How many columns a text takes."""
        if self.encoding == "utf-8":
            return len(text.encode("utf-8", "surrogatepass"))
        return len(text.encode("utf-16-le", "surrogatepass")) // 2

    def _characters(self, text: str, columns: int) -> int:
        """How many characters begin before a column; one that is cut by it does."""
        low, high = 0, len(text)
        while low < high:
            middle = (low + high) // 2
            low, high = (middle + 1, high) if self._units(text[:middle]) < columns else (low, middle)
        return low


@lru_cache(CACHED_RULERS)
def ruler(text: str, encoding: str) -> Ruler:
    """The ruler of a text."""
    return Ruler(text, encoding)
