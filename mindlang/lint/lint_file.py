"""A file linted, and mended where that is wished for."""

from collections.abc import Collection
from dataclasses import dataclass
from pathlib import Path

from mindrun.files.regular_files import read_regular

from mindlang.compiler.compile import Compiled, compile_source, load
from mindlang.compiler.diagnostic import Diagnostic
from mindlang.compiler.source import Source, encoded
from mindlang.editing import transaction
from mindlang.editing.neighbours import neighbours
from mindlang.lint.fixing import fixed
from mindlang.lint.lint import lint
from mindlang.lock import LockError


@dataclass(frozen=True, slots=True)
class Linted:
    """What is found in a file, after so many fixes; one that cannot be read says so in its diagnostics."""

    diagnostics: tuple[Diagnostic, ...]
    readable: bool
    fixed: int


def linted(file: str, compiled: Compiled, codes: Collection[str], fix: bool) -> Linted:
    """A file held against the rules with these codes; MindError where the mended file cannot be written."""
    try:
        if fix and compiled.graph:
            return _mended(Path(file).resolve(), compiled, codes)
        return Linted(tuple(lint(compiled, codes)), compiled.readable, 0)
    except LockError as error:
        return Linted((Diagnostic("damaged-lock", f"{error}.", None, error.hint),), True, 0)


def _mended(path: Path, compiled: Compiled, codes: Collection[str]) -> Linted:
    """A file after its fixes; none is made where one of them would break it, or another mind that uses it."""

    def again(source: Source) -> Compiled:
        return compiled if source is compiled.sources[0] else compile_source(source, path)

    source, made = fixed(compiled.sources[0], lambda source: lint(again(source), codes))
    if not made or _breaks(path, source.text, again(source)):
        return Linted(tuple(lint(compiled, codes)), True, 0)
    transaction.change(
        path.parent, {path: encoded(path, source.text)}, lambda: _refuse_changed(path, compiled.sources[0])
    )
    return Linted(tuple(lint(again(source), codes)), True, made)


def _refuse_changed(path: Path, old: Source) -> None:
    """TransactionError where somebody has written the file since it was read."""
    was = encoded(path, old.text)
    if read_regular(path, len(was) + 1) != was:
        raise transaction.TransactionError(
            f"{path.name} has been changed meanwhile", "Try again: nothing has been written."
        )


def _breaks(path: Path, text: str, mended: Compiled) -> bool:
    """Whether a file no longer compiles with this text, or a mind that uses it does not."""
    mains = (each.sources[0].path for each in neighbours([path]))
    return mended.graph is None or any(load(main, {path: text}).graph is None for main in mains)
