"""The files that an editor has open, as it has them, and the minds of which they are part."""

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from itertools import chain
from pathlib import Path

from mindrun.errors import MindError

from mindlang.breakpoints import SUFFIX
from mindlang.compiler.compile import Compiled, load, read_files
from mindlang.compiler.diagnostic import Diagnostic, Findings
from mindlang.compiler.expand import expand
from mindlang.compiler.names import Mention, Names, declared_names, mentions
from mindlang.compiler.resolve.maps import map_paths
from mindlang.compiler.source import Span, checked_text
from mindlang.compiler.syntax import File
from mindlang.files import Stamp, files_beside, folders_above, readable_text, stamp, within_read_limits

_MASTER = re.compile(r"^[ \t]*master\b", re.MULTILINE)
_USE = re.compile(r'^[ \t]*use[ \t]+"', re.MULTILINE)

Texts = Mapping[Path, str]


def are_breakpoints(path: Path) -> bool:
    return path.suffix == SUFFIX


@dataclass(frozen=True)
class MindView:
    """The files of a mind, main one first, and what is declared in them."""

    main: Path
    compiled: Compiled
    files: tuple[File, ...]
    names: Names

    @property
    def paths(self) -> list[Path]:
        return [file.source.path for file in self.files]

    def file(self, path: Path) -> File | None:
        return next((file for file in self.files if file.source.path == path), None)

    @cached_property
    def whole(self) -> Names:
        """The declarations with what they take over from those that they are like written out."""
        return expand(self.names, {}, 1.0, Findings())

    @cached_property
    def mentions(self) -> tuple[Mention, ...]:
        """Every name in the files that is declared in one of them."""
        return tuple(mentions(self.files, self.names))

    def mention_at(self, path: Path, offset: int) -> Mention | None:
        """The name in which, or right behind which, an offset lies."""
        here = (mention for mention in self.mentions if mention.name.span.source.path == path)
        return next((each for each in here if each.name.span.start <= offset <= each.name.span.end), None)

    @cached_property
    def findings(self) -> tuple[Diagnostic, ...]:
        """The diagnostics of compiler and lint; wrong settings and a damaged lock are findings, too."""
        from mindlang.lint.lint import lint
        from mindlang.lint.settings import settings_of

        settings = settings_of(self.main)
        # What is wrong in another file is said on the first line of the mind's own, which an editor has open.
        here = Span(self.compiled.sources[0], 0, 0) if self.compiled.sources else None
        try:
            found = lint(self.compiled, settings.codes(self.main))
        except MindError as error:
            damage = Diagnostic("damaged-lock", f"{error}.", here, error.hint, severity="warning")
            return (*self.compiled.diagnostics, damage)
        wrong = []
        for each in settings.wrong:
            where = f"{each.span.source.name}:{each.span.line}: " if each.span else ""
            wrong.append(replace(each, message=f"{where}{each.message}", span=here, severity="warning"))
        return (*wrong, *found)


def view(main: Path, texts: Texts) -> MindView:
    compiled = load(main, texts)
    if compiled.mind:
        found = compiled.mind.files
    elif compiled.sources:
        found = tuple(read_files(compiled.sources[0], main, Findings(), texts)[0])
    else:
        found = ()
    return MindView(main, compiled, found, declared_names(found, Findings()))


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
        self.texts.pop(path, None)
        self.forget()

    def view(self, path: Path) -> MindView:
        return self.mind(self.main_of(path))

    def mind(self, main: Path) -> MindView:
        known = self._views.get(main)
        if known is None or not self._is_now(*known):
            made = view(main, self.texts)
            maps = map_paths(made.files)
            known = made, {path: stamp(path) for path in [*made.paths, *maps] if path not in self.texts}
            self._views[main] = known
        return known[0]

    def mains(self) -> list[Path]:
        """The main files of all minds of which a file is open."""
        return list(dict.fromkeys(self.main_of(path) for path in self.texts if not are_breakpoints(path)))

    def main_of(self, path: Path) -> Path:
        """The main file of the mind to which a file belongs: of one without a master, a mind that uses it."""
        if are_breakpoints(path):
            return path.with_suffix(".mind")  # the mind beside it
        if _MASTER.search(self.text(path)):
            return path
        known = self._mains.get(path)
        if known is None or path not in self.mind(known).paths:
            around = (main for main, text in self.around(path) if _USE.search(text) and _MASTER.search(text))
            sources = ((main, load(main, self.texts).sources) for main in [*around])
            users = (main for main, files in sources if any(source.path == path for source in files))
            known = self._mains[path] = next(users, path)
        return known

    def text(self, path: Path) -> str:
        """The text of a file as it is now; nothing where it is too large, or cannot be read."""
        text = self.texts.get(path)
        if text is None:
            return readable_text(path)
        try:
            return checked_text(text)
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

    def sharing(self, view: MindView) -> Iterator[MindView]:
        """Other minds that have one of a mind's files among their own."""
        own = set(view.paths)
        for path, text in self.around(*view.paths):
            if path != view.main and (path in own or 'use "' in text):
                other = self.mind(path)
                if not own.isdisjoint(other.paths):
                    yield other

    def _is_now(self, known: MindView, stamps: dict[Path, Stamp]) -> bool:
        """True if a view is of the files as they are."""
        apart = stamps.keys() - {*known.paths}
        if not known.files or any(stamps[path] != stamp(path) for path in apart):
            return False
        return all(
            file.source.text == self.texts[path] if path in self.texts else stamps.get(path, ()) == stamp(path)
            for path, file in zip(known.paths, known.files, strict=True)
        )
