"""The code of a page: what stands between fences, and what is indented, which is a terminal.

```python        a language; `text` is a picture or a formula, which nobody runs
    mindc check  what is typed, and below `$ ` what is printed, too
"""

import re
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache

from tests.pages.transcript import INDENT
from tests.project.sources import ROOT

FENCE = re.compile(r"(?P<indent> *)```(?P<language>\w*)(?: (?P<rest>.+))?$")
TERMINAL = "terminal"
# What tests/explain makes of what the program says of itself, and holds against it.
MADE = {f"docs/{name}.md" for name in ("codes", "commands", "drivers", "kinds", "python-reference", "words")}
PLACES = (
    "*.md",
    "docs/**/*.md",
    "examples/**/*.md",
    "runtime/*.md",
    "editors/*/*.md",
    "playground/*.md",
    "viewer/*.md",
)


@dataclass(frozen=True)
class Block:
    """A piece of code: its page, the line in which it begins, its language, what else the fence says, its text."""

    page: str
    line: int
    language: str
    rest: str
    text: str

    def __str__(self) -> str:
        return f"{self.page}:{self.line}:{self.language}"


@cache
def pages() -> tuple[str, ...]:
    """Every page of the project, by its path."""
    found = {
        path
        for place in PLACES
        for path in ROOT.glob(place)
        if "node_modules" not in path.parts and ".template" not in path.suffixes
    }
    return tuple(sorted(str(path.relative_to(ROOT)) for path in found))


def blocks(page: str) -> Iterator[Block]:
    """The code of a page, in its order."""
    lines, at = (ROOT / page).read_text(encoding="utf-8").splitlines(), 0
    while at < len(lines):
        fence = FENCE.match(lines[at])
        if fence:
            end = lines.index(f"{fence['indent']}```", at + 1)
            text = _text(lines[at + 1 : end], len(fence["indent"]))
            yield Block(page, at + 1, fence["language"], fence["rest"] or "", text)
            at = end + 1
        elif lines[at].startswith(INDENT) and not (at and lines[at - 1].strip()):
            end = next((n for n in range(at, len(lines)) if lines[n] and not lines[n].startswith(INDENT)), len(lines))
            yield Block(page, at + 1, TERMINAL, "", _text(lines[at:end], len(INDENT)))
            at = end
        else:
            at += 1


def _text(lines: list[str], indent: int) -> str:
    return "".join(f"{line[indent:]}\n" for line in lines).rstrip("\n") + "\n"
