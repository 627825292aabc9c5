"""The tree of a YAML text: scalars, lists and tables, each with its span. Nothing in it is checked yet."""

from dataclasses import dataclass

from mindlang.compiler.diagnostic import Diagnostic, Findings, Label
from mindlang.compiler.source import Span


@dataclass(frozen=True, slots=True)
class Scalar:
    """One value as written; `plain` without quotes."""

    text: str
    plain: bool
    span: Span


@dataclass(frozen=True, slots=True)
class Items:
    """A list."""

    items: tuple["Node", ...]
    span: Span


@dataclass(frozen=True, slots=True)
class TableEntry:
    """A key and its value."""

    key: Scalar
    value: "Node"


@dataclass(frozen=True, slots=True)
class Table:
    """Keys and their values; it is `whole` unless an entry had a key that is no word."""

    entries: tuple[TableEntry, ...]
    span: Span
    whole: bool = True


@dataclass(frozen=True, slots=True)
class Lost:
    """A value that could not be read, and was reported: nothing more is reported of it."""

    span: Span


Node = Scalar | Items | Table | Lost


def report_error(findings: Findings, code: str, span: Span, message: str, hint: str, *labels: Label) -> None:
    """Collect an error; every error of a wiring says what to do."""
    findings.diagnostics.append(Diagnostic(code, message, span, hint, labels))


def report_warning(findings: Findings, code: str, span: Span, message: str, hint: str, *labels: Label) -> None:
    """Collect a warning: the wiring is taken as it is."""
    findings.diagnostics.append(Diagnostic(code, message, span, hint, labels, "warning"))


def shortened(text: str) -> str:
    """What was written, if it is not too long for a message."""
    return text if len(text) <= 40 else f"{text[:39]}…"
