"""A file linted, and mended where that is wished for."""

from collections.abc import Collection
from dataclasses import dataclass
from pathlib import Path

from mindlang import journal
from mindlang.compile import Compiled, compile_source
from mindlang.diagnostic import Diagnostic
from mindlang.linting.fixing import fixed
from mindlang.linting.lint import lint
from mindlang.linting.rule import all_rules
from mindlang.source import Source, encoded


@dataclass(frozen=True, slots=True)
class Linted:
    """What is found in a file, after so many fixes; one that cannot be read says so in its diagnostics."""

    diagnostics: tuple[Diagnostic, ...]
    readable: bool
    fixed: int


def linted(file: str, compiled: Compiled, select: Collection[str], ignore: Collection[str], fix: bool) -> Linted:
    """A file held against the rules; MindError where a lock is damaged or the mended file cannot be written."""
    codes = [code for code in (select or all_rules()) if code not in ignore]
    if not fix or compiled.graph is None or file == "-":
        return Linted(tuple(lint(compiled, codes)), compiled.readable, 0)
    path = Path(file).resolve()

    def again(source: Source) -> Compiled:
        return compiled if source is compiled.sources[0] else compile_source(source, path)

    source, made = fixed(compiled.sources[0], lambda source: lint(again(source), codes))
    if made:
        journal.change(path.parent, {path: encoded(path, source.text)})
    return Linted(tuple(lint(again(source), codes)), True, made)
