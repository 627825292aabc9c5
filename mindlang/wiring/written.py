"""What may be written: values without anchors and tags, on one line and without surprises; each key once."""

from collections.abc import Sequence

import yaml

from mindlang.compiler.diagnostic import Findings, Label
from mindlang.compiler.source import Source, Span
from mindlang.wiring.nodes import Entry, Lost, Node, Scalar, Table, shortened, tell
from mindlang.wiring.surprises import surprise


def unmarked(event: yaml.NodeEvent, source: Source, findings: Findings) -> bool:
    """Whether a value has neither an anchor nor a tag; one that has is reported."""
    start = event.start_mark.index
    word = source.text[start : start + 200].split(maxsplit=1)[0] if event.anchor or event.tag else ""
    span = Span(source, start, start + len(word))
    if event.anchor:
        hint = (
            f"Remove &{shortened(event.anchor)}, and write out what it stands for where *{shortened(event.anchor)} is."
        )
        tell(findings, "yaml-anchor", span, "This gives a place a name for later.", hint)
    elif event.tag:
        hint = f"Remove {shortened(word)}: what a value is comes from what it is for."
        tell(findings, "yaml-tag", span, "This says of which type a value is.", hint)
    return not (event.anchor or event.tag)


def scalar(event: yaml.ScalarEvent, source: Source, findings: Findings) -> Node:
    """A value as written, if it is on one line and means the same to every YAML."""
    span = Span(source, event.start_mark.index, event.end_mark.index)
    plain = event.style is None
    if event.style in ("|", ">") or "\n" in span.text:
        first = Span(source, span.start, span.start + len(span.text.split("\n")[0].rstrip()))
        hint = "Write it on one line; a key of its own begins a line of its own, as far in as its neighbours."
        tell(findings, "yaml-lines", first, "This value goes on in the next line.", hint)
        return Lost(span)
    if plain and (found := surprise(event.value)):
        tell(findings, found[0], span, *found[1:])
        return Lost(span)
    return Scalar(event.value, plain, span)


def keyed(nodes: Sequence[Node], span: Span, findings: Findings) -> Table:
    """The entries of a table, each key once."""
    entries: dict[str, Entry] = {}
    lost = False
    for key, value in zip(nodes[::2], nodes[1::2], strict=True):
        match key:
            case Scalar(text="<<", plain=True):
                hint = "Write out the lines that it would bring."
                tell(findings, "yaml-merge", key.span, "<< copies from another place.", hint)
                lost = True
            case Scalar(text=text) if text in entries:
                first = Label(entries[text].key.span, "first said here")
                message = f"{shortened(text)} is said twice."
                tell(findings, "yaml-duplicate", key.span, message, "Leave one of them out.", first)
            case Scalar(text=text):
                entries[text] = Entry(key, value)
            case Lost():
                lost = True
            case _:
                hint = "Write a word, a colon and its value."
                tell(findings, "yaml-key", key.span, "A list or table cannot be a key.", hint)
                lost = True
    return Table(tuple(entries.values()), span, not lost)
