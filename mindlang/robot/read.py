"""YAML text → nodes, for any text without an exception, from the events of PyYAML's parser: no object is ever made.

Nothing is followed, expanded or nested deep, so what is read is never larger than what was written.
"""

from collections.abc import Sequence
from dataclasses import dataclass, field

import yaml

from mindlang.compiler.diagnostic import Findings, Label
from mindlang.compiler.source import Source, Span
from mindlang.robot.misread import misread, odd_line
from mindlang.robot.nodes import Items, Lost, Node, Scalar, Table, TableEntry, report_error, shortened
from mindlang.robot.surprises import surprise

MAX_NESTING = 8
MAX_VALUES = 20_000


@dataclass(slots=True)
class _Open:
    """A list or table whose end has not come; in a table keys and values take turns."""

    start: int
    is_table: bool
    nodes: list[Node] = field(default_factory=list)


@dataclass(slots=True)
class _Reader:
    source: Source
    findings: Findings
    open: list[_Open] = field(default_factory=lambda: [_Open(0, False)])
    documents: int = 0
    values: int = 0

    def span(self, event: yaml.Event) -> Span:
        """Where an event stands."""
        return Span(self.source, event.start_mark.index, event.end_mark.index)

    def add(self, node: Node) -> None:
        """A node has been read."""
        self.open[-1].nodes.append(node)


def read(source: Source, findings: Findings) -> Node | None:
    """The tree of a text, or None after reporting why there is none."""
    if odd := odd_line(source):
        report_error(findings, *odd)
        return None
    reader = _Reader(source, findings)
    loader = None
    try:
        loader = yaml.SafeLoader(source.text)
        while loader.check_event():
            if not _take(loader.get_event(), reader):
                return None
    except (yaml.YAMLError, ValueError, OverflowError) as error:  # \UFFFFFFFF is an OverflowError
        if findings.diagnostics and findings.diagnostics[-1].code == "yaml-lines":
            findings.diagnostics.pop()  # the value went on because of the same mistake
        report_error(findings, *misread(error, source, loader.get_mark().index if loader else 0))
        return None
    if not reader.open[0].nodes:
        hint = "Write robot and its name, sensors and actuators: docs/robot-yaml.md has an example."
        report_error(findings, "yaml-empty", Span(source, 0, 0), "There is nothing in this file.", hint)
        return None
    return reader.open[0].nodes[0]


def _take(event: yaml.Event, reader: _Reader) -> bool:
    """Add what an event brings; whether to go on."""
    match event:
        case yaml.DocumentStartEvent():
            return _begin(event, reader)
        case yaml.AliasEvent():
            span = reader.span(event)
            hint = "Write out what it stands for: every sensor and actuator is read by itself."
            report_error(reader.findings, "yaml-alias", span, f"{shortened(span.text)} stands for another place.", hint)
            reader.add(Lost(span))
        case yaml.ScalarEvent():
            fine = unmarked(event, reader.source, reader.findings)
            reader.add(scalar(event, reader.source, reader.findings) if fine else Lost(reader.span(event)))
        case yaml.SequenceStartEvent() | yaml.MappingStartEvent():
            unmarked(event, reader.source, reader.findings)
            reader.open.append(_Open(event.start_mark.index, isinstance(event, yaml.MappingStartEvent)))
            return _shallow(event, reader)
        case yaml.SequenceEndEvent() | yaml.MappingEndEvent():
            done = reader.open.pop()
            span = Span(reader.source, done.start, max(done.start, event.end_mark.index))
            table = keyed(done.nodes, span, reader.findings) if done.is_table else None
            reader.add(table or Items(tuple(done.nodes), span))
    return _few(event, reader)


def _begin(event: yaml.DocumentStartEvent, reader: _Reader) -> bool:
    reader.documents += 1
    if reader.documents > 1:
        hint = "One file is one robot: remove the line --- and what follows, or write a second file."
        report_error(reader.findings, "yaml-documents", reader.span(event), "A second document begins here.", hint)
        return False
    if event.version or event.tags:
        start = reader.source.text.index("%")
        span = Span(reader.source, start, start + len(reader.source.text[start:].split("\n")[0].rstrip("\r")))
        report_error(
            reader.findings, "yaml-directive", span, "A directive stands here.", "Remove the lines that begin with %."
        )
        return False
    return True


def _shallow(event: yaml.Event, reader: _Reader) -> bool:
    if len(reader.open) <= MAX_NESTING + 1:
        return True
    span = Span(reader.source, event.start_mark.index, event.start_mark.index + 1)
    message = f"Lists and tables stand more than {MAX_NESTING} deep in one another here."
    report_error(
        reader.findings, "yaml-deep", span, message, "Four are enough for any robot: look for a bracket too many."
    )
    return False


def _few(event: yaml.Event, reader: _Reader) -> bool:
    reader.values += 1
    if reader.values <= MAX_VALUES:
        return True
    message = f"This file has more than {MAX_VALUES} values."
    report_error(reader.findings, "yaml-large", reader.span(event), message, "Write only what is wired to this robot.")
    return False


def unmarked(event: yaml.NodeEvent, source: Source, findings: Findings) -> bool:
    """Whether a value has neither an anchor nor a tag; one that has is reported."""
    start = event.start_mark.index
    word = source.text[start : start + 200].split(maxsplit=1)[0] if event.anchor or event.tag else ""
    span = Span(source, start, start + len(word))
    if event.anchor:
        hint = (
            f"Remove &{shortened(event.anchor)}, and write out what it stands for where *{shortened(event.anchor)} is."
        )
        report_error(findings, "yaml-anchor", span, "This gives a place a name for later.", hint)
    elif event.tag:
        hint = f"Remove {shortened(word)}: what a value is comes from what it is for."
        report_error(findings, "yaml-tag", span, "This says of which type a value is.", hint)
    return not (event.anchor or event.tag)


def scalar(event: yaml.ScalarEvent, source: Source, findings: Findings) -> Node:
    """A value as written, if it is on one line and means the same to every YAML."""
    span = Span(source, event.start_mark.index, event.end_mark.index)
    plain = event.style is None
    if event.style in ("|", ">") or "\n" in span.text:
        first = Span(source, span.start, span.start + len(span.text.split("\n")[0].rstrip()))
        hint = "Write it on one line; a key of its own begins a line of its own, as far in as its neighbours."
        report_error(findings, "yaml-lines", first, "This value goes on in the next line.", hint)
        return Lost(span)
    if plain and (found := surprise(event.value)):
        report_error(findings, found[0], span, *found[1:])
        return Lost(span)
    return Scalar(event.value, plain, span)


def keyed(nodes: Sequence[Node], span: Span, findings: Findings) -> Table:
    """The entries of a table, each key once."""
    entries: dict[str, TableEntry] = {}
    lost = False
    for key, value in zip(nodes[::2], nodes[1::2], strict=True):
        match key:
            case Scalar(text="<<", plain=True):
                hint = "Write out the lines that it would bring."
                report_error(findings, "yaml-merge", key.span, "<< copies from another place.", hint)
                lost = True
            case Scalar(text=text) if text in entries:
                first = Label(entries[text].key.span, "first said here")
                message = f"{shortened(text)} is said twice."
                report_error(findings, "yaml-duplicate", key.span, message, "Leave one of them out.", first)
            case Scalar(text=text):
                entries[text] = TableEntry(key, value)
            case Lost():
                lost = True
            case _:
                hint = "Write a word, a colon and its value."
                report_error(findings, "yaml-key", key.span, "A list or table cannot be a key.", hint)
                lost = True
    return Table(tuple(entries.values()), span, not lost)
