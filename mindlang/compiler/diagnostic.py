"""Errors as data: what is wrong, where, and what to do about it."""

from collections.abc import Collection, Iterable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from itertools import chain
from pathlib import Path
from typing import Literal

from mindrun.errors import nearest
from mindrun.numbers.short_repr import ShortRepr

from mindlang.compiler.source import Span, Splice

ERRORS = Path(__file__).with_name("errors.md")  # what each code means: a section a code
MAX_DIAGNOSTICS = 100  # diagnostics that are read
MAX_COMPARED_NAMES = 50_000  # names that are held against words

Severity = Literal["error", "warning"]


@dataclass(frozen=True, slots=True)
class Label:
    """A second place that explains a diagnostic."""

    span: Span
    message: str


@dataclass(frozen=True, slots=True)
class Fix:
    """A change of text that mends a diagnostic, titled as a command: "Remove eye". Safe: the robot does the same."""

    title: str
    splices: tuple[Splice, ...]
    is_safe: bool = True


@dataclass(frozen=True, slots=True, repr=False)
class Diagnostic(ShortRepr):
    """One finding. `code` is stable, `message` says what is wrong, `hint` what to do.

    Without a span it is about a file that could not be read.

    >>> [diagnostic] = mindlang.load("nowhere.mind").diagnostics
    >>> diagnostic.code, diagnostic.severity
    ('unreadable', 'error')
    """

    code: str
    message: str
    span: Span | None = None
    hint: str = ""
    labels: tuple[Label, ...] = ()
    severity: Severity = "error"
    fix: Fix | None = None


@dataclass(slots=True)
class Findings:
    """The diagnostics that stages of the compiler collect; `numbers` are names of numbers that hints may suggest.

    `draws` are the names of the numbers that tasks draw.
    """

    diagnostics: list[Diagnostic] = field(default_factory=list)
    comparisons: int = MAX_COMPARED_NAMES  # of names, which are left
    numbers: Collection[str] = ()
    draws: Collection[str] = ()

    def error(self, code: str, span: Span, message: str, hint: str = "", *labels: Label) -> None:
        self.diagnostics.append(Diagnostic(code, message, span, hint, labels))

    def refuse_again(
        self, code: str, places: Sequence[Span], message: str, hint: str, first: str = "first said here"
    ) -> None:
        """Report all but the first of the places where the same is said."""
        for again in places[1:]:
            self.error(code, again, message, hint, Label(places[0], first))

    @contextmanager
    def each_once(self) -> Iterator[None]:
        """Drop what is found within and was found before on the same words: several tasks can share lines."""
        before = len(self.diagnostics)
        yield
        if len(self.diagnostics) > before:
            known = {(each.code, each.span) for each in self.diagnostics[:before]}
            found = {(each.code, each.span): each for each in reversed(self.diagnostics[before:])}
            self.diagnostics[before:] = [found[key] for key in reversed(found) if key not in known]

    def suggest(self, word: str, *known: Iterable[str]) -> str:
        """`did_you_mean` for the first diagnostics: comparing names takes time, and nobody reads more."""
        if len(self.diagnostics) >= MAX_DIAGNOSTICS or self.comparisons <= 0:
            return ""
        names = [*chain(*known)]
        self.comparisons -= len(names)
        return did_you_mean(word, names)


def errors(diagnostics: Iterable[Diagnostic]) -> list[Diagnostic]:
    """The diagnostics that are errors, without the warnings."""
    return [diagnostic for diagnostic in diagnostics if diagnostic.severity == "error"]


def distinct(diagnostics: Iterable[Diagnostic]) -> list[Diagnostic]:
    """The diagnostics, each once: what is wrong in a file that several minds use is said by all of them."""
    found: dict[tuple[object, ...], Diagnostic] = {}
    for each in diagnostics:
        place = (each.span.source.path, each.span.start, each.span.end) if each.span else ()
        found.setdefault((each.code, each.message, *place), each)
    return list(found.values())


def did_you_mean(word: str, known: Iterable[str]) -> str:
    """A question that names the known word nearest to `word`, or nothing."""
    near = nearest(f"{word}", known)  # a program may ask for anything
    return f"Did you mean {near}?" if near else ""


def near_file(path: Path) -> str:
    """The hint for a file that cannot be read: the file beside it with the nearest name and the same ending, if any."""
    try:
        beside = [each.name for each in path.parent.iterdir() if each.suffix[:2] == path.suffix[:2]]
    except OSError:
        beside = []
    near = nearest(path.name, beside)
    return f"Did you mean {path.with_name(near)}?" if near and near != path.name else "Is the path right?"


def a(noun: str) -> str:
    """A noun with its article, a or an."""
    return f"an {noun}" if noun[:1] in "aeiou" else f"a {noun}"


def listed(words: Iterable[str], joint: str = "or") -> str:
    """Words as a sentence lists them: a, b or c."""
    *most, last = words
    return f"{', '.join(most)} {joint} {last}" if most else last
