"""Everything that the files of a workspace declare."""

from collections.abc import Iterable
from functools import lru_cache
from itertools import chain, islice
from pathlib import Path

from mindlang.compiler.diagnostic import Findings
from mindlang.compiler.parse import parse
from mindlang.compiler.source import Source
from mindlang.file_search import as_many, below
from mindlang.server.navigating import Symbol, symbols
from mindlang.server.workspace import Workspace

MAX_SYMBOLS = 500  # that are found
CACHED_FILES = 1000  # files whose symbols are remembered


def everything(workspace: Workspace, folders: Iterable[Path], query: str) -> list[Symbol]:
    """The declarations whose names hold the letters of a query in their order, by file."""
    paths = dict.fromkeys(chain(workspace.texts, (path for folder in folders for path in below(folder))))
    files = as_many((path, workspace.text(path)) for path in paths)
    found = (symbol for path, text in files for symbol in _declared(path, text))
    return list(islice((symbol for symbol in found if _fits(query.lower(), symbol.name.lower())), MAX_SYMBOLS))


@lru_cache(CACHED_FILES)
def _declared(path: Path, text: str) -> tuple[Symbol, ...]:
    return tuple(symbols(parse(Source(str(path), text, path.parent), Findings())))


def _fits(query: str, name: str) -> bool:
    letters = iter(name)
    return all(letter in letters for letter in query)
