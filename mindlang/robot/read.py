"""Parses `robot.yaml` into a tree of values with their spans; raises nothing for any text, and checks no value yet.

It is made from the events of PyYAML's parser, which makes no object. Nothing is followed, expanded or nested deep, so
what is read is never larger than what was written. What PyYAML cannot read, or reads as another thing than was meant,
is told in the user's words.
"""

import re
import tomllib
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

import yaml

from mindlang.compiler.diagnostic import Findings, Label
from mindlang.compiler.source import Source, Span

MAX_NESTING = 8
MAX_VALUES = 20_000
Answer = tuple[str, Span, str, str]  # code, place, message, hint
FIRST_TABS = re.compile(r"^(?:(?!(?:^|\s)#)[^\t\n])*(?!\s#)(\t+)", re.MULTILINE)  # of a line, before its comment
MAX_SHOWN_CHARACTERS = 40
WORD = re.compile(r"[\w.]+|[^\n]")


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

    entries: Mapping[str, TableEntry]
    span: Span
    whole: bool = True


@dataclass(frozen=True, slots=True)
class Lost:
    """A value that could not be read, and was reported: nothing more is reported of it."""

    span: Span


Node = Scalar | Items | Table | Lost


class UnreadableError(Exception):
    """A text after which nothing is read; its arguments are those of the finding."""


def read(source: Source, findings: Findings) -> Node | None:
    """The tree of a text, or None after reporting why there is none."""
    loader = None
    try:
        if tab := FIRST_TABS.search(source.text):  # YAML takes tabs in some places and not in others
            hint = "Write spaces: YAML counts how far in a line is."
            raise UnreadableError("yaml-tab", Span(source, *tab.span(1)), "A tab stands here.", hint)
        loader = yaml.SafeLoader(source.text)
        return _Reader(source, findings, loader).document()
    except UnreadableError as why:
        findings.error(*why.args)
    except (yaml.YAMLError, ValueError, OverflowError) as error:  # \UFFFFFFFF is an OverflowError
        if findings.diagnostics and findings.diagnostics[-1].code == "yaml-lines":
            findings.diagnostics.pop()  # the value went on because of the same mistake
        findings.error(*misread(error, source, loader.get_mark().index if loader else 0))
    return None


@dataclass(slots=True)
class _Reader:
    source: Source
    findings: Findings
    loader: yaml.SafeLoader
    values: int = 0

    def document(self) -> Node:
        """The only document of the text."""
        self.loader.get_event()  # a stream begins
        if self.loader.check_event(yaml.StreamEndEvent):
            hint = "Write robot and its name, sensors and actuators: docs/robot-yaml.md has an example."
            raise UnreadableError("yaml-empty", Span(self.source, 0, 0), "There is nothing in this file.", hint)
        begin = self.loader.get_event()
        if begin.version or begin.tags:
            start = self.source.text.index("%")
            line = self.source.text[start:].split("\n")[0].rstrip("\r")
            span = Span(self.source, start, start + len(line))
            hint = "Remove the lines that begin with %."
            raise UnreadableError("yaml-directive", span, "A directive stands here.", hint)
        node = self._node(0)
        self.loader.get_event()  # the document ends
        if not self.loader.check_event(yaml.StreamEndEvent):
            hint = "One file is one robot: remove the line --- and what follows, or write a second file."
            span = self._span(self.loader.get_event())
            raise UnreadableError("yaml-documents", span, "A second document begins here.", hint)
        return node

    def _node(self, depth: int) -> Node:
        """The next value, `depth` lists and tables deep."""
        event = self.loader.get_event()
        self.values += 1
        if self.values > MAX_VALUES:
            message = f"This file has more than {MAX_VALUES} values."
            raise UnreadableError("yaml-large", self._span(event), message, "Write only what is wired to this robot.")
        if isinstance(event, yaml.AliasEvent):
            span = self._span(event)
            hint = "Write out what it stands for: every sensor and actuator is read by itself."
            self.findings.error("yaml-alias", span, f"{shortened(span.text)} stands for another place.", hint)
            return Lost(span)
        is_marked = self._is_marked(event)
        if isinstance(event, yaml.ScalarEvent):
            return Lost(self._span(event)) if is_marked else self._scalar(event)
        start = event.start_mark.index
        if depth == MAX_NESTING:
            message = f"Lists and tables stand more than {MAX_NESTING} deep in one another here."
            hint = "Four are enough for any robot: look for a bracket too many."
            raise UnreadableError("yaml-deep", Span(self.source, start, start + 1), message, hint)
        nodes = []
        while not self.loader.check_event(yaml.SequenceEndEvent, yaml.MappingEndEvent):
            nodes.append(self._node(depth + 1))
        span = Span(self.source, start, max(start, self.loader.get_event().end_mark.index))
        return self._table(nodes, span) if isinstance(event, yaml.MappingStartEvent) else Items(tuple(nodes), span)

    def _is_marked(self, event: yaml.NodeEvent) -> bool:
        """True if a value has an anchor or a tag, after reporting it."""
        start = event.start_mark.index
        word = self.source.text[start : start + 200].split(maxsplit=1)[0] if event.anchor or event.tag else ""
        span = Span(self.source, start, start + len(word))
        if event.anchor:
            name = shortened(event.anchor)
            hint = f"Remove &{name}, and write out what it stands for where *{name} is."
            self.findings.error("yaml-anchor", span, "This gives a place a name for later.", hint)
        elif event.tag:
            hint = f"Remove {shortened(word)}: what a value is comes from what it is for."
            self.findings.error("yaml-tag", span, "This says of which type a value is.", hint)
        return bool(event.anchor or event.tag)

    def _scalar(self, event: yaml.ScalarEvent) -> Node:
        """A value as written, if it is on one line and means the same to every YAML."""
        span, plain = self._span(event), event.style is None
        if event.style in ("|", ">") or "\n" in span.text:
            hint = "Write it on one line; a key of its own begins a line of its own, as far in as its neighbours."
            self.findings.error("yaml-lines", first_line(span), "This value goes on in the next line.", hint)
            return Lost(span)
        if plain and (found := surprise(event.value)):
            code, message, hint = found
            self.findings.error(code, span, message, hint)
            return Lost(span)
        return Scalar(event.value, plain, span)

    def _table(self, nodes: list[Node], span: Span) -> Table:
        """The entries of a table, each key once."""
        entries: dict[str, TableEntry] = {}
        whole = True
        for key, value in zip(nodes[::2], nodes[1::2], strict=True):
            match key:
                case Scalar(text="<<", plain=True):
                    hint = "Write out the lines that it would bring."
                    self.findings.error("yaml-merge", key.span, "<< copies from another place.", hint)
                    whole = False
                case Scalar(text=text) if text in entries:
                    first = Label(entries[text].key.span, "first said here")
                    message = f"{shortened(text)} is said twice."
                    self.findings.error("yaml-duplicate", key.span, message, "Leave one of them out.", first)
                case Scalar(text=text):
                    entries[text] = TableEntry(key, value)
                case Lost():
                    whole = False
                case _:
                    hint = "Write a word, a colon and its value."
                    self.findings.error("yaml-key", key.span, "A list or table cannot be a key.", hint)
                    whole = False
        return Table(entries, span, whole)

    def _span(self, event: yaml.Event) -> Span:
        return Span(self.source, event.start_mark.index, event.end_mark.index)


@cache
def texts() -> dict[str, Any]:
    """What is said of a robot.yaml, read from `mistakes.toml` once."""
    return tomllib.loads((Path(__file__).parent / "mistakes.toml").read_text(encoding="utf-8"))


def first_line(span: Span) -> Span:
    """The part of a span on its first line."""
    return Span(span.source, span.start, span.start + len(span.text.split("\n")[0].rstrip()))


def shortened(text: str) -> str:
    """A text, cut off where it is too long for a message."""
    return text if len(text) <= MAX_SHOWN_CHARACTERS else f"{text[: MAX_SHOWN_CHARACTERS - 1]}…"


def misread(error: Exception, source: Source, at: int) -> Answer:
    """The code, span, message and hint for an error of the parser; `at` is how far it came."""
    if isinstance(error, yaml.reader.ReaderError):
        message = f"The character U+{ord(source.text[error.position]):04X} cannot stand in YAML."
        return "yaml-character", Span(source, error.position, error.position + 1), message, "Remove it."
    mark = getattr(error, "problem_mark", None)
    start = min(mark.index if mark else at, len(source.text))
    problem = str(getattr(error, "problem", None) or "escape sequence")
    known = ((row["message"], row["hint"]) for row in texts()["problems"] if row["says"] in problem)
    message, hint = next(known, (f"This is not YAML: {shortened(problem)}.", "Compare it with docs/robot-yaml.md."))
    if "no end" in message or "never closed" in message:  # it is the beginning that has to be looked at
        opened = getattr(error, "context_mark", None)
        start = opened.index if opened else start
    word = WORD.match(source.text, start)
    end = word.end() if word else start
    if "double quotes" in message:
        start, end = max(start - 1, 0), start + 1
    return "yaml-syntax", Span(source, start, end), message, hint


def _seconds(text: str) -> str:
    total = 0.0
    for part in text.split(":"):
        total = 60 * total + float(part)
    return f"{total:.15g}"


def _all_digits(text: str) -> str:
    """The digits of a number with an exponent, behind a colon, where they are not too many."""
    number = float(text.replace("_", ""))
    digits = f"{number:.12f}".rstrip("0").rstrip(".")
    return f": {digits}" if len(digits) <= 20 and (number == 0 or 1e-9 <= abs(number) <= 1e15) else ""


def _decimal(text: str) -> str:
    """The decimal numbers for which digits of another base may stand."""
    base = 2 if "b" in text else 8
    digits = re.sub("^[-+]?0[ob]?", "", text).replace("_", "")
    decimal = digits.lstrip("0") or "0"
    try:
        value = f"{int(digits, base)}" if len(digits) < 30 else decimal
    except ValueError:
        return decimal
    if value == decimal or text.lstrip("+-")[1:2] in "ob":
        return value
    return f"{decimal}, or {value} where base {base} is meant"


def _whole(text: str) -> str:
    """A number with digits before its point, and no point without digits behind it."""
    sign = "-" if text[0] == "-" else ""
    whole, _, part = text.lstrip("+-").partition(".")
    return f"{sign}{whole or '0'}{'.' * bool(part)}{part}"


MEANT: dict[str, Callable[[str], str]] = {
    "boolean": lambda text: "true" if text.lower() in ("yes", "on", "true") else "false",
    "seconds": _seconds,
    "digits": _all_digits,
    "decimal": _decimal,
    "joined": lambda text: text.replace("_", ""),
    "whole": _whole,
}


def surprise(text: str) -> tuple[str, str, str] | None:
    """Code, message and hint of a text without quotes that YAML takes for something else: `no` is false, 1:30 is 90."""
    words = text.split() if text[:1] in "+-.0123456789" else []
    for said, table in ((text, "texts"), *((word, "numbers") for word in words)):
        for row in texts()[table]:
            if re.fullmatch(row["pattern"], said):
                parts = {"text": said, "meant": MEANT[row["meant"]](said) if "meant" in row else said}
                return row["code"], row["message"].format(**parts), row["hint"].format(**parts)
    return None
