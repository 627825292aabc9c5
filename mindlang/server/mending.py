"""Quick fixes: those that findings bring along, and the word that was nearly written."""

import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from mindlang.compiler.compile import compile_source
from mindlang.compiler.diagnostic import Diagnostic
from mindlang.compiler.source import Source
from mindlang.compiler.splice import Splice
from mindlang.lint.fixing import fixed
from mindlang.server.view import MindView

_SUGGESTED_NAME = re.compile(r"Did you mean (\S+)\?")


@dataclass(frozen=True, slots=True)
class Mending:
    """A quick fix: its title, what it mends, what it splices, and whether it is safe to choose without thinking."""

    title: str
    of: Diagnostic
    splices: tuple[Splice, ...]
    is_safe: bool


def mendings(view: MindView, path: Path, start: int, end: int) -> Iterator[Mending]:
    """The quick fixes of what is found between two offsets of a file."""
    for found in view.findings:
        span = found.span
        if span is None or span.source.path != path or span.start > end or span.end < start:
            continue
        if found.fix:
            yield Mending(found.fix.title, found, found.fix.splices, found.fix.is_safe)
        if nearly := _SUGGESTED_NAME.search(found.hint):
            splice = Splice(span.source, span.start, span.end, nearly[1])
            yield Mending(f"Write {nearly[1]}", found, (splice,), True)


def all_mended(view: MindView, path: Path, texts: dict[Path, str]) -> str | None:
    """The text of a main file with all safe fixes made, or None where there is none to make."""
    if path != view.main or view.compiled.graph is None:
        return None
    source = view.compiled.sources[0]

    def findings_of(now: Source) -> tuple[Diagnostic, ...]:
        if now is source:
            return view.findings
        compiled = compile_source(now, path, {**texts, path: now.text})
        return MindView(path, compiled, (), view.names).findings

    mended, made = fixed(source, findings_of)
    return mended.text if made else None
