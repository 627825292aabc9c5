"""Everything that the files of a workspace declare."""

from collections.abc import Iterable, Iterator
from itertools import islice
from pathlib import Path

from mindlang.diagnostic import Findings
from mindlang.parse import parse
from mindlang.server.desk import Desk
from mindlang.server.navigating import Symbol, symbols
from mindlang.source import Source

FILES, MOST = 500, 500  # files that are read, symbols that are found
HIDDEN = ("node_modules", "build", "dist", "runs")


def everything(desk: Desk, folders: Iterable[Path], query: str) -> list[Symbol]:
    """The declarations whose names hold the letters of a query in their order, by file."""
    paths = dict.fromkeys([*desk.texts, *(path for folder in folders for path in islice(_files(folder), FILES))])
    texts = ((path, desk.text(path)) for path in paths)
    files = (parse(Source(str(path), text, path.parent), Findings()) for path, text in texts)
    found = (symbol for file in files for symbol in symbols(file) if _fits(query.lower(), symbol.name.lower()))
    return list(islice(found, MOST))


def _files(folder: Path) -> Iterator[Path]:
    for path in folder.rglob("*.mind"):
        if not any(part.startswith(".") or part in HIDDEN for part in path.relative_to(folder).parts[:-1]):
            yield path.resolve()


def _fits(query: str, name: str) -> bool:
    letters = iter(name)
    return all(letter in letters for letter in query)
