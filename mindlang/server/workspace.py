"""The files that an editor has open, as it has them, and the minds of which they are part."""

import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from itertools import chain
from pathlib import Path

from mindlang.compiler.compile import Compiled, load
from mindlang.compiler.resolve.maps import map_paths
from mindlang.compiler.source import within
from mindlang.files import files_beside, folders_above, text_of, within_read_limits
from mindlang.server.stops import are_breakpoints, mind_beside
from mindlang.server.view import MindView, view

_MASTER = re.compile(r"^[ \t]*master\b", re.MULTILINE)
_USE = re.compile(r'^[ \t]*use[ \t]+"', re.MULTILINE)

Stamp = tuple[int, int] | None  # when a file was written, and how long it is


@dataclass
class Workspace:
    """The open texts by path. What has been made of them is kept until one of its files changes."""

    texts: dict[Path, str] = field(default_factory=dict)
    _views: dict[Path, tuple[MindView, dict[Path, Stamp]]] = field(default_factory=dict)
    _mains: dict[Path, Path] = field(default_factory=dict)

    def forget(self) -> None:
        """Forget everything that was made of files: some may be there now that were not."""
        self._views.clear()
        self._mains.clear()

    def close(self, path: Path) -> None:
        """A file is no longer open: it is what lies on the disk."""
        self.texts.pop(path, None)
        self.forget()

    def view(self, path: Path) -> MindView:
        """The mind to which a file belongs."""
        return self.mind(self.main_of(path))

    def mind(self, main: Path) -> MindView:
        """The mind whose main file this is."""
        known = self._views.get(main)
        if known is None or not self._is_now(*known):
            made = view(main, self.texts)
            maps = map_paths(made.files)
            known = made, {path: _stamp(path) for path in [*made.paths, *maps] if path not in self.texts}
            self._views[main] = known
        return known[0]

    def mains(self) -> list[Path]:
        """The main files of all minds of which a file is open."""
        return list(dict.fromkeys(self.main_of(path) for path in self.texts if not are_breakpoints(path)))

    def main_of(self, path: Path) -> Path:
        """The main file of the mind to which a file belongs: of one without a master, a mind that uses it."""
        if are_breakpoints(path):
            return mind_beside(path)
        if _MASTER.search(self.text(path)):
            return path
        known = self._mains.get(path)
        if known is None or path not in self.mind(known).paths:
            users = (main for main in self._users(path) if _is_part(path, load(main, self.texts)))
            known = self._mains[path] = next(users, path)
        return known

    def text(self, path: Path) -> str:
        """The text of a file as it is now; nothing where it is too large, or cannot be read."""
        text = self.texts.get(path)
        if text is None:
            return text_of(path)
        try:
            return within(text)
        except ValueError:
            return ""

    def around(self, *paths: Path) -> Iterator[tuple[Path, str]]:
        """The `.mind` files that may use one of these, with their texts: the open ones, those beside and those above.

        As many as an editor can wait for.
        """
        folders = dict.fromkeys(folder for path in paths for folder in folders_above(path))
        open_ = (other for other in self.texts if other.parent in folders)
        others = dict.fromkeys(chain(open_, chain.from_iterable(map(files_beside, folders))))
        yield from within_read_limits((other, self.text(other)) for other in others if [other] != [*paths])

    def _users(self, path: Path) -> list[Path]:
        """Those around that may be minds and may use a file."""
        return [other for other, text in self.around(path) if _USE.search(text) and _MASTER.search(text)]

    def _is_now(self, known: MindView, stamps: dict[Path, Stamp]) -> bool:
        """Whether a view is of the files as they are."""
        apart = stamps.keys() - {*known.paths}
        if not known.files or any(stamps[path] != _stamp(path) for path in apart):
            return False
        return all(
            file.source.text == self.texts[path] if path in self.texts else stamps.get(path, ()) == _stamp(path)
            for path, file in zip(known.paths, known.files, strict=True)
        )


def _is_part(path: Path, of: Compiled) -> bool:
    return any(source.path == path for source in of.sources)


def _stamp(path: Path) -> Stamp:
    try:
        found = path.stat()
    except OSError:
        return None
    return found.st_mtime_ns, found.st_size
