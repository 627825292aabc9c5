"""Amounts as written → numbers: units converted, ranges and whole numbers checked."""

from collections.abc import Callable, Mapping
from fractions import Fraction
from math import ceil, floor, isfinite
from typing import Any

from mindrun.kinds.registry import Shape
from mindrun.numbers.quantity import LEAST_STEP, Extent, Place, Quantity, Span

from mindlang.compiler.diagnostic import Findings, Label, listed
from mindlang.compiler.syntax import Amount, Either, Name, Numbers, Points, Range, Value

MOST_NUMBERS = 20_000  # of a list that is said by its step
MAX_RUN_TICKS = 10_000_000  # of a run
TIMES = Quantity("how many times", {"": 1.0}, low=1, high=MAX_RUN_TICKS, whole=True)


def convert(amount: Amount, quantity: Quantity, findings: Findings, unit: str = "") -> float | int | None:
    """The value of an amount, `unit` being that of its list, or None after reporting why it has none."""
    written = amount.unit or unit
    if amount.name:
        if amount.name not in findings.numbers:  # one that is declared wrongly has been reported there
            _unknown_number(amount, findings)
        return None
    if amount.per and not (quantity.rate and amount.per in ("s", "tick")):
        _no_rate(amount, quantity, findings)
        return None
    if not isfinite(amount.number):
        hint = "A fraction is not over 0, and a number has fewer than 300 digits."
        findings.error("not-a-number", amount.span, f"{amount.span.text[:40]} is not a number.", hint)
        return None
    if written not in quantity.units:
        _wrong_unit(amount, quantity, findings)
        return None
    # 7 / 100 is the number nearest to 7%; 7 * 0.01 is not.
    value = amount.number / 100 if written == "%" else amount.number * quantity.units[written]
    if amount.per == "s":
        value = quantity.in_tick(value, amount.tick_seconds)
    if quantity.whole and not value.is_integer():
        near = [bound for bound in (floor(value), ceil(value)) if quantity.low <= bound <= quantity.high]
        fit = listed(f"{bound} {amount.unit}".strip() for bound in near) if near else ""
        hint = f"Here stands {quantity.name}: write {fit}." if fit else _bounds(quantity, written)
        message = f"{amount.span.text} is not a whole number."
        findings.error("not-whole", amount.span, message, hint, *_labels(amount))
        return None
    if not quantity.low <= value <= quantity.high:
        message = f"{amount.span.text[:40]} is too {'small' if value < quantity.low else 'large'}."
        percent = f" {amount.span.text} percent are {amount.span.text}%."
        is_percent = not written and "%" in quantity.units and quantity.high < value <= 100 * quantity.high
        hint = _bounds(quantity, written) + percent * (is_percent and not amount.per and not amount.said)
        findings.error("out-of-range", amount.span, message, hint, *_labels(amount))
        return None
    return int(value) if quantity.whole else value


def _unknown_number(amount: Amount, findings: Findings) -> None:
    hint = findings.suggest(amount.name, findings.numbers) or f"Declare it: number {amount.name} is 12."
    if amount.name in findings.draws:
        hint = (
            f"{amount.name} is drawn for each run: it is a place, at +{amount.name} 5, a count, or stands after when."
        )
    if amount.name.isupper():
        hint = f"Write a number, or say which it stands for: where {amount.name} is 1 to 10."
    findings.error("unknown-number", amount.constant.span, f"There is no number called {amount.name}.", hint)


def _wrong_unit(amount: Amount, quantity: Quantity, findings: Findings) -> None:
    bare = amount.span.text.partition("per ")[0].strip().removesuffix(amount.unit).strip()
    scaled = {unit: amount.number * factor for unit, factor in quantity.units.items() if not amount.said}
    fit = [unit for unit, value in scaled.items() if quantity.low <= value <= quantity.high]
    rate = f" per {amount.per or 's'}" * (quantity.rate != "" and "" not in quantity.units)
    units = [f"{bare} {unit}".replace(" %", "%").strip() + rate for unit in fit]
    message = f"The unit {amount.unit} does not fit here." if amount.unit else "This number needs a unit."
    here = f"Here stands {quantity.name}"
    hint = f"{here}: write {listed(units)}." if units else f"{here}. {_bounds(quantity)}"
    findings.error("wrong-unit", amount.span, message, hint, *_labels(amount))


def _labels(amount: Amount) -> tuple[Label, ...]:
    """The label of the line that declares the number which an amount names; none where it names none."""
    return (Label(amount.said, f"{amount.span.text.strip('+- ')} is said here"),) if amount.said else ()


def _no_rate(amount: Amount, quantity: Quantity, findings: Findings) -> None:
    if quantity.rate:
        hint = "Write per s or per tick."
        findings.error("wrong-rate", amount.span, f"A rate is not per {amount.per}.", hint, *_labels(amount))
    else:
        hint = f"Here stands {quantity.name}: leave per {amount.per} out."
        findings.error("not-a-rate", amount.span, "This number is no rate.", hint, *_labels(amount))


def _bounds(quantity: Quantity, unit: str = "") -> str:
    """The hint on the bounds of an amount, without exponents, in its unit or, if that is not one, in the first."""
    unit = unit if unit in quantity.units else next(iter(quantity.units))
    ends = (bound / quantity.units[unit] for bound in (quantity.low, quantity.high))
    low, high = (f"{end:.9f}".rstrip("0").rstrip(".") for end in ends)
    return f"Write at least {low} and at most {f'{high} {unit}'.strip()}.".replace(" %", "%")


def single_value(value: Value, quantity: Quantity, findings: Findings) -> float | int | None:
    """The value of an argument that takes one number."""
    match value:
        case Numbers((amount,)):
            return convert(amount, quantity, findings)
        case Numbers((first, *_)) | Range(first):
            hint = f"Here stands {quantity.name}, for example {first.span.text}."
            findings.error("one-number", value.span, "Only one number can stand here.", hint)
        case Name(text) if text in findings.numbers:
            pass  # one that is declared wrongly, which has been reported there
        case _:
            hint = findings.suggest(value.text, findings.numbers) if isinstance(value, Name) else ""
            hint = hint or f"Here stands {quantity.name}."
            findings.error("not-a-number", value.span, f"{value.span.text} is not a number.", hint)
    return None


def value_list(value: Value, quantity: Quantity, findings: Findings) -> tuple[float | int, ...] | None:
    """The values of an argument that takes a list; the last unit goes for all that have none."""
    match value:
        case Numbers((*most, last)):
            end = convert(last, quantity, findings)
            if end is None:  # its unit goes for all: one message will do
                return None
            numbers = [convert(amount, quantity, findings, last.unit) for amount in most]
            return (*(n for n in numbers if n is not None), end) if None not in numbers else None
        case Range(first, last, None):
            bare, unit = last.span.text.removesuffix(last.unit).rstrip(), f" {last.unit}".replace(" %", "%").rstrip()
            example = f"{first.span.text} to {bare} by {abs(last.number - first.number) / 4:g}{unit}"
            hint = f"Write each number, with spaces between, or the step from one to the next: {example}."
            findings.error("no-range", value.span, "A list cannot be a range without a step.", hint)
        case Range(first, last, Amount() as by):
            return _stepped(value, first, last, by, quantity, findings)
        case _:
            single_value(value, quantity, findings)
    return None


def _stepped(
    value: Range, first: Amount, last: Amount, by: Amount, quantity: Quantity, findings: Findings
) -> tuple[float | int, ...] | None:
    """The numbers of `-60 to 60 by 4 deg`, the ends among them, each as if it were written: 0.3 and not 3 * 0.1."""
    unit = by.unit or last.unit
    if convert(last, quantity, findings, unit) is None or convert(first, quantity, findings, unit) is None:
        return None  # one message will do
    if convert(by, _step(quantity), findings, unit) is None:
        return None
    if {unit} != {amount.unit or unit for amount in (first, last, by)}:
        hint = "Write the unit once, at the end: -60 to 60 by 4 deg."
        findings.error("wrong-unit", value.span, "The ends and the step have several units.", hint)
        return None
    begin, end, step = (Fraction(str(amount.number)) for amount in (first, last, by))
    steps, whole = abs(end - begin) / step, round(abs(end - begin) / step)
    if whole >= MOST_NUMBERS:
        message, hint = f"That makes {whole + 1} numbers.", f"A list has at most {MOST_NUMBERS}: write a larger step."
        findings.error("too-many-readings", value.span, message, hint)
        return None
    if abs(steps - whole) > LEAST_STEP:
        nearest = float(begin + int(steps) * (step if begin < end else -step))
        message = f"Steps of {by.span.text} do not lead from {first.span.text} to {last.span.text}."
        hint = f"They lead to {nearest:g}: write that as the end, or another step."
        findings.error("uneven-steps", value.span, message, hint)
        return None
    numbers = (float(begin + (end - begin) * place / max(whole, 1)) for place in range(whole + 1))
    found = [convert(Amount(number, unit, by.span), quantity, findings) for number in numbers]
    return tuple(number for number in found if number is not None) if None not in found else None


def _step(quantity: Quantity) -> Quantity:
    """The quantity of a step from one number to the next."""
    name = f"the step from one number to the next, {quantity.name}"
    return Quantity(name, quantity.units, low=LEAST_STEP, high=quantity.high)


def extent(value: Value, quantity: Quantity, findings: Findings) -> Extent | None:
    """The value of an argument that takes one number, or a width and a depth."""
    match value:
        case Numbers((_, _)):
            return single_place(value, quantity, findings)
        case Numbers((_, _, third, *_)):
            hint = "Write one number for a square, or two: the width and the depth."
            findings.error("too-many-numbers", third.span, "Here stand one number or two.", hint)
            return None
    return single_value(value, quantity, findings)


def place_list(value: Value, quantity: Quantity, findings: Findings) -> tuple[Place, ...] | None:
    """The value of an argument that takes a place, or several with `to` between."""
    written = value.points if isinstance(value, Points) and not value.by else (value,)
    found = [single_place(each, quantity, findings) for each in written]
    return None if None in found else tuple(each for each in found if each)


def alternatives(value: Value, quantity: Quantity, findings: Findings) -> tuple[tuple[Place, ...], ...] | None:
    """The value of an argument that says what may stand instead of another: places, or lists of them."""
    options = value.options if isinstance(value, Either) else (value,)
    found = [place_list(each, quantity, findings) for each in options]
    return None if None in found else tuple(each for each in found if each)


def single_place(value: Value, quantity: Quantity, findings: Findings) -> Place | None:
    """The value of two numbers."""
    match value:
        case Numbers((_, _)):
            both = value_list(value, quantity, findings)
            return (both[0], both[1]) if both else None
        case Numbers() | Range() | Points():
            hint = "Write two numbers with a space between: along x, then along y from the middle."
            findings.error("not-a-place", value.span, "A place is two numbers.", hint)
        case _:
            single_value(value, quantity, findings)
    return None


def span(value: Value, quantity: Quantity, findings: Findings) -> Span | None:
    """The value of an argument that takes one number, a range or a schedule."""
    if not isinstance(value, Range):
        number = single_value(value, quantity, findings)
        return None if number is None else Span(number, number)
    unit = value.last.unit
    first, last = (convert(amount, quantity, findings, unit) for amount in (value.first, value.last))
    by = convert(value.by, _step(quantity), findings, unit) if value.by else None
    if first is None or last is None or (value.by and by is None):
        return None
    if by is None and first > last:
        hint = f"Write {value.last.span.text} to {value.first.span.text}, or for a schedule add by and its step."
        findings.error("range-backwards", value.span, "This range ends below its beginning.", hint)
        return None
    return Span(first, last, by)


SHAPES: Mapping[Shape, Callable[[Value, Quantity, Findings], Any]] = {  # of the values of arguments
    "one": single_value, "list": value_list, "extent": extent, "place": single_place,
    "places": place_list, "span": span, "alternatives": alternatives,
}  # fmt: skip
