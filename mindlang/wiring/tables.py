"""Tables → values by key: unknown keys, missing ones and empty ones are told."""

from collections.abc import Iterable, Mapping
from typing import Any

from mindlang.compiler.diagnostic import Findings, listed
from mindlang.compiler.source import Span
from mindlang.wiring.nodes import Entry, Lost, Node, Scalar, Table, shortened, tell
from mindlang.wiring.options import Option
from mindlang.wiring.values import first_line, value


def table(node: Node, what: str, example: str, findings: Findings) -> Table | None:
    """The node, if it is a table."""
    if isinstance(node, Table):
        return node
    if not isinstance(node, Lost):
        message = f"{what} has no keys and values."
        tell(findings, "not-a-table", first_line(node.span), message, f"Write, each on a line of its own: {example}.")
    return None


def is_empty(entry: Entry, findings: Findings) -> bool:
    """Whether nothing stands after a key; this is told."""
    if not isinstance(entry.value, Scalar) or entry.value.text or not entry.value.plain:
        return False
    hint = "Write a value after the colon, or remove the line; what belongs to it stands below it, farther in."
    tell(findings, "no-value", entry.key.span, f"{shortened(entry.key.text)} has no value.", hint)
    return True


def by_option(entries: Iterable[Entry], options: Mapping[str, Option], findings: Findings) -> dict[str, Any]:
    """The values of those entries that are options, by their fields; those that are wrong are told and left out."""
    found = {
        options[entry.key.text].field: value(options[entry.key.text], entry.value, findings)
        for entry in entries
        if entry.key.text in options and not is_empty(entry, findings)
    }
    return {field: each for field, each in found.items() if each is not None}


def unknown_key(key: Scalar, what: str, known: Iterable[str], findings: Findings) -> None:
    """Tell that a key means nothing here."""
    known = list(known)
    hint = findings.suggest(key.text, known) or f"{what} takes {listed(known, 'and')}."
    tell(findings, "unknown-key", key.span, f"{what} has no key {shortened(key.text)}.", hint)


def missing_key(span: Span, what: str, key: str, example: str, findings: Findings) -> None:
    """Tell that a key is needed."""
    tell(findings, "missing-key", first_line(span), f"{what} needs {key}.", f"Add a line: {key}: {example}.")
