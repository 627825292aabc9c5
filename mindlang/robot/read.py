"""The text of `robot.yaml` → its tree, for any text without an exception: each value has its span, none is checked yet.

It is made from the events of PyYAML's parser, which makes no object. Nothing is followed, expanded or nested deep, so
what is read is never larger than what was written.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import NoReturn

import yaml

from mindlang.compiler.diagnostic import Findings, Label
from mindlang.compiler.source import Source, Span
from mindlang.robot.misread import check_tabs, misread, shortened, surprise

MAX_NESTING = 8
MAX_VALUES = 20_000


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
        if tabs := check_tabs(source):
            raise UnreadableError(*tabs)
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
            self._stop("yaml-empty", Span(self.source, 0, 0), "There is nothing in this file.", hint)
        begin = self.loader.get_event()
        if begin.version or begin.tags:
            start = self.source.text.index("%")
            line = self.source.text[start:].split("\n")[0].rstrip("\r")
            span = Span(self.source, start, start + len(line))
            self._stop("yaml-directive", span, "A directive stands here.", "Remove the lines that begin with %.")
        node = self._node(0)
        self.loader.get_event()  # the document ends
        if not self.loader.check_event(yaml.StreamEndEvent):
            hint = "One file is one robot: remove the line --- and what follows, or write a second file."
            self._stop("yaml-documents", self._span(self.loader.get_event()), "A second document begins here.", hint)
        return node

    def _node(self, depth: int) -> Node:
        """The next value, which stands in so many others."""
        event = self.loader.get_event()
        self.values += 1
        if self.values > MAX_VALUES:
            message = f"This file has more than {MAX_VALUES} values."
            self._stop("yaml-large", self._span(event), message, "Write only what is wired to this robot.")
        if isinstance(event, yaml.AliasEvent):
            span = self._span(event)
            hint = "Write out what it stands for: every sensor and actuator is read by itself."
            self.findings.error("yaml-alias", span, f"{shortened(span.text)} stands for another place.", hint)
            return Lost(span)
        is_marked = self._check_unmarked(event)
        if isinstance(event, yaml.ScalarEvent):
            return Lost(self._span(event)) if is_marked else self._scalar(event)
        start = event.start_mark.index
        if depth == MAX_NESTING:
            message = f"Lists and tables stand more than {MAX_NESTING} deep in one another here."
            hint = "Four are enough for any robot: look for a bracket too many."
            self._stop("yaml-deep", Span(self.source, start, start + 1), message, hint)
        nodes = []
        while not self.loader.check_event(yaml.SequenceEndEvent, yaml.MappingEndEvent):
            nodes.append(self._node(depth + 1))
        span = Span(self.source, start, max(start, self.loader.get_event().end_mark.index))
        return self._table(nodes, span) if isinstance(event, yaml.MappingStartEvent) else Items(tuple(nodes), span)

    def _check_unmarked(self, event: yaml.NodeEvent) -> bool:
        """Whether a value has an anchor or a tag, which is reported."""
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

    def _stop(self, code: str, span: Span, message: str, hint: str) -> NoReturn:
        raise UnreadableError(code, span, message, hint)


def first_line(span: Span) -> Span:
    """As much of a span as stands on its first line."""
    return Span(span.source, span.start, span.start + len(span.text.split("\n")[0].rstrip()))
