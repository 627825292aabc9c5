"""A .break file: read, its lines parsed and resolved."""

from dataclasses import dataclass
from pathlib import Path

from mindlang.breakpoints.breakpoint import Breakpoint
from mindlang.breakpoints.parse import parse
from mindlang.breakpoints.resolve import resolve
from mindlang.breakpoints.subject import Subject
from mindlang.compiler.compile import read_main
from mindlang.compiler.diagnostic import Diagnostic, Findings
from mindlang.compiler.source import Source, Span


@dataclass(frozen=True, slots=True)
class BreakpointFile:
    """What became of a .break file; where anything is wrong in it, the diagnostics say so."""

    breakpoints: tuple[Breakpoint, ...]
    diagnostics: tuple[Diagnostic, ...]


def load_breakpoints(path: Path | str, subject: Subject | None) -> BreakpointFile:
    """The breakpoints of the file at `path`, or with "-" of standard input."""
    source = read_main(path)
    return BreakpointFile((), (source,)) if isinstance(source, Diagnostic) else breakpoints_of(source, subject)


def breakpoints_of(source: Source, subject: Subject | None) -> BreakpointFile:
    """The breakpoints of a text; none where nobody knows what they are about, and its lines are only read."""
    findings = Findings()
    lines = parse(source, findings)
    if not lines and not findings.diagnostics:
        hint = "Write a line such as stop on collision."
        findings.error("empty-file", Span(source, 0, 0), "There is nothing in this file.", hint)
    found = resolve(lines, subject, findings) if subject else ()
    in_order = sorted(findings.diagnostics, key=lambda each: each.span.start if each.span else -1)
    return BreakpointFile(found, tuple(in_order))
