"""Nodes → values: numbers with the units of `.mind` files, words, switches, texts."""

import re
from collections.abc import Collection, Iterable, Mapping
from typing import Any

from mindrun.errors import nearest
from mindrun.numbers.quantity import Quantity, Reference

from mindlang.compiler.diagnostic import Findings, listed
from mindlang.compiler.resolve.quantities import convert
from mindlang.compiler.source import Span
from mindlang.compiler.syntax import Amount
from mindlang.robot.options import DriverOption
from mindlang.robot.read import Items, Lost, Node, Scalar, Table, TableEntry, first_line, shortened

AMOUNT = re.compile(r"(0x[0-9a-fA-F]{1,8}|-?[0-9]+(?:\.[0-9]+)?(?:/[0-9]+)?) *((?![0-9.,]).*)?")
MAX_TEXT_CHARACTERS = 200


def value(option: DriverOption, node: Node, findings: Findings) -> Any:
    """The value of an option, or None after reporting why it has none."""
    match option.shape, option.type:
        case "number", Quantity() as quantity:
            return number(node, quantity, findings)
        case "numbers", Quantity() as quantity:
            return _numbers(node, quantity, option.count, findings)
        case "texts" | "words", Reference() as reference:
            return _words(node, reference, option.count, findings)
        case "word" | "text", Reference() as reference:
            return word(node, reference, findings)
    if isinstance(node, Scalar) and node.plain and node.text in ("true", "false"):
        return node.text == "true"
    _refuse(node, "not-a-switch", "Here stands true or false.", "Write true or false, without quotes.", findings)
    return None


def number(node: Node, quantity: Quantity, findings: Findings) -> float | int | None:
    """A number, converted from its unit."""
    match node:
        case Scalar(text=written, plain=True, span=span) if found := AMOUNT.fullmatch(written):
            over, _, under = found[1].partition("/")
            parsed = float(int(over, 16)) if over.startswith("0x") else float(over)
            divisor = float(under or 1)
            amount = Amount(parsed / divisor if divisor else float("nan"), found[2] or "", span)
            return convert(amount, quantity, findings)
        case Scalar(text=written, span=span) if AMOUNT.fullmatch(written):
            findings.error("quoted-number", span, "This is a text, because of its quotes.", "Remove the quotes.")
        case Scalar(text=written, span=span):
            comma = re.fullmatch(r"(-?[0-9]+),([0-9]+ ?\w*)", written)
            hint = f"Write {comma[1]}.{comma[2]}." if comma else f"Here stands {quantity.name}."
            findings.error("not-a-number", span, f"{shortened(written)} is not a number.", hint)
        case _:
            hint = f"Here stands {quantity.name}, without brackets."
            _refuse(node, "one-number", "Only one number can stand here.", hint, findings)
    return None


def _numbers(node: Node, quantity: Quantity, count: int | None, findings: Findings) -> tuple[float | int, ...] | None:
    """A list of numbers; where there may be any number of them, or one, a single one needs no brackets."""
    is_amount = isinstance(node, Scalar) and AMOUNT.fullmatch(node.text)
    if is_amount and count in (None, 1):
        return _all([number(node, quantity, findings)])
    if not isinstance(node, Items):
        example = node.span.text if is_amount else "1"
        hint = f"Write [{', '.join([shortened(example)] * (count or 1))}]."
        _refuse(node, "not-a-list", "A list stands here.", hint, findings)
        return None
    if not node.items or count not in (None, len(node.items)):
        wanted = f"{count} numbers" if count else "at least one number"
        message = f"This list has {len(node.items)} entries." if node.items else "This list is empty."
        _refuse(node, "wrong-count", message, f"Write {wanted}, each {quantity.name}.", findings)
        return None
    return _all([number(item, quantity, findings) for item in node.items])


def _words(node: Node, reference: Reference, count: int | None, findings: Findings) -> tuple[str, ...] | None:
    if not isinstance(node, Items) or not node.items or count not in (None, len(node.items)):
        wanted = f"{count} of them" if count else "at least one"
        hint = f"Write {wanted} between brackets: [a, b]."
        _refuse(node, "not-a-list", "A list stands here.", hint, findings)
        return None
    return _all([word(item, reference, findings) for item in node.items])


def _all(found: list[Any]) -> tuple[Any, ...] | None:
    """All values of a list; None where one of them is wrong."""
    return None if None in found else tuple(found)


def word(node: Node, reference: Reference, findings: Findings) -> str | None:
    """One of a few words, or any text where the reference has none."""
    noun, words = reference.noun, reference.words
    if not words:
        return text(node, findings)
    if not isinstance(node, Scalar):
        _refuse(node, "not-a-word", f"Here stands a {noun}.", f"It is {listed(words)}.", findings)
        return None
    if node.text in words:
        return node.text
    hint = findings.suggest(node.text, words) or f"It is {listed(words)}."
    findings.error(f"unknown-{noun}", node.span, f"There is no {noun} called {shortened(node.text)}.", hint)
    return None


def text(node: Node, findings: Findings) -> str | None:
    if not isinstance(node, Scalar):
        _refuse(node, "not-a-word", "Here stands a text.", "Write it without brackets.", findings)
    elif not node.text.strip() or len(node.text) > MAX_TEXT_CHARACTERS or not node.text.isprintable():
        hint = f"Write 1 to {MAX_TEXT_CHARACTERS} characters that can be printed."
        findings.error("not-a-text", node.span, "This text cannot stand here.", hint)
    else:
        return node.text
    return None


def _refuse(node: Node, code: str, message: str, hint: str, findings: Findings) -> None:
    """Report a value that is of another kind than is asked for, unless it was reported before."""
    if not isinstance(node, Lost):
        findings.error(code, first_line(node.span), message, hint)


def table(node: Node, what: str, example: str, findings: Findings) -> Table | None:
    """The node, if it is a table."""
    if isinstance(node, Table):
        return node
    hint = f"Write, each on a line of its own: {example}."
    _refuse(node, "not-a-table", f"{what} has no keys and values.", hint, findings)
    return None


def is_empty(entry: TableEntry, findings: Findings) -> bool:
    """True if nothing stands after a key, after reporting it."""
    if not isinstance(entry.value, Scalar) or entry.value.text or not entry.value.plain:
        return False
    hint = "Write a value after the colon, or remove the line; what belongs to it stands below it, farther in."
    findings.error("no-value", entry.key.span, f"{shortened(entry.key.text)} has no value.", hint)
    return True


def by_option(entries: Iterable[TableEntry], options: Mapping[str, DriverOption], findings: Findings) -> dict[str, Any]:
    """The values of those entries that are options, by their fields; those that are wrong are reported and left out."""
    said = [entry for entry in entries if entry.key.text in options and not is_empty(entry, findings)]
    known = ((options[entry.key.text], entry.value) for entry in said)
    found = {option.field: value(option, node, findings) for option, node in known}
    return {field: each for field, each in found.items() if each is not None}


def check_keys(
    table: Table, place: Span, what: str, known: Collection[str], needed: Mapping[str, str], findings: Findings
) -> None:
    """Report keys that mean nothing here, and those of `needed`, each with an example, that are missing."""
    strange = [entry.key for key, entry in table.entries.items() if key not in known]
    for key in strange:
        hint = findings.suggest(key.text, known) or f"{what} takes {listed(known, 'and')}."
        findings.error("unknown-key", key.span, f"{what} has no key {shortened(key.text)}.", hint)
    said = table.entries.keys() | {nearest(key.text, known) for key in strange}
    for word, example in needed.items():
        if word not in said and table.whole:
            missing_key(place, what, word, example, findings)


def missing_key(span: Span, what: str, key: str, example: str, findings: Findings) -> None:
    findings.error("missing-key", first_line(span), f"{what} needs {key}.", f"Add a line: {key}: {example}.")
