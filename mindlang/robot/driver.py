"""The driver of a sensor or an actuator: found by name, with its options checked."""

import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import partial
from typing import Any

from mindrun.errors import MindError, nearest
from mindrun.numbers.quantity import Quantity, Reference

from mindlang.compiler.diagnostic import Findings, errors, listed
from mindlang.compiler.source import Span
from mindlang.robot.nodes import Scalar, Table, TableEntry, report_error, shortened
from mindlang.robot.options import DRIVER, DriverOption, driver_options, drivers, own_options
from mindlang.robot.own_driver import BrokenDriverError, DriverClass, own_class
from mindlang.robot.timing import Timing, timing_of
from mindlang.robot.values import by_option, first_line, is_empty, missing_key, unknown_key

ENDS = ("from", "to")  # are in the unit of the driver, so they are read when there is one
OWN_NAME = re.compile(r"^[A-Za-z_][A-Za-z0-9_]*\.[A-Za-z_][A-Za-z0-9_]*$")  # FILE.CLASS, or PACKAGE.NAME
COUNTERPARTS = {"sensor": "actuator", "actuator": "sensor"}


@dataclass(frozen=True, slots=True)
class Wired:
    """A table of `robot.yaml` about one sensor or actuator: its driver, and its own options by field.

    `options` are the driver's, and `values` theirs by field, those too that are not said; `timing` is the driver's.
    """

    name: Scalar
    table: Table
    noun: str
    driver: Any
    timing: Timing
    own: Mapping[str, Any]
    options: tuple[DriverOption, ...]
    values: Mapping[str, Any]

    def entry(self, key: str) -> TableEntry | None:
        """What is said under a key."""
        return next((entry for entry in self.table.entries if entry.key.text == key), None)

    def span(self, *keys: str) -> Span:
        """Where the value of the first of these keys stands that is said, or else the name."""
        said = [entry for entry in map(self.entry, keys) if entry]
        return first_line(said[0].value.span) if said else self.name.span


def wired(noun: str, name: Scalar, table: Table, findings: Findings) -> Wired | None:
    """What a table says, its keys and values checked; None after reporting why there is no driver."""
    before = len(errors(findings.diagnostics))
    cls = _class(noun, name, table, findings)
    if cls is None:
        return None
    entry = next(entry for entry in table.entries if entry.key.text == DRIVER)
    assert isinstance(entry.value, Scalar)
    own = {option.key: option for option in own_options(noun)}
    its = {option.key: option for option in cls.options}
    _check_keys(f"The driver {entry.value.text}", entry.value, table, its, own, findings)
    others = [entry for entry in table.entries if entry.key.text not in {DRIVER, *its, *ENDS}]
    values, own_values = by_option(table.entries, its, findings), by_option(others, own, findings)
    said = [entry for entry in table.entries if entry.key.text not in {DRIVER, *ENDS}]
    if len(errors(findings.diagnostics)) > before or len(said) > len(values) + len(own_values) or not table.whole:
        return None
    made = _made(cls, values, entry.value, findings)
    if made is None:
        return None
    driver, timing = made
    every = {option.field: values.get(option.field, option.default) for option in cls.options}
    return Wired(name, table, noun, driver, timing, own_values, cls.options, every)


def _check_keys(
    what: str,
    driver: Scalar,
    table: Table,
    its: Mapping[str, DriverOption],
    own: Mapping[str, DriverOption],
    findings: Findings,
) -> None:
    """Keys that the driver does not have, and those that it needs."""
    strange = [entry.key for entry in table.entries if entry.key.text not in {DRIVER, *own, *its}]
    for key in strange:
        unknown_key(key, what, [*its, *own], findings)
    said = {entry.key.text for entry in table.entries} | {nearest(key.text, [*its, *own]) for key in strange}
    for option in its.values():
        if option.required and option.key not in said and table.whole:
            missing_key(driver.span, what, option.key, _example(option), findings)


def _class(noun: str, name: Scalar, table: Table, findings: Findings) -> DriverClass | None:
    known = drivers(noun)
    entry = next((entry for entry in table.entries if entry.key.text == DRIVER), None)
    if entry is None:
        if table.whole:
            missing_key(name.span, name.text, DRIVER, listed(sorted(known)), findings)
        return None
    match entry.value:
        case Scalar(text=driver) if driver in known:
            return DriverClass(driver_options(known[driver]), partial(_shipped, known[driver], noun))
        case _ if is_empty(entry, findings):
            return None
        case Scalar(text=driver) as scalar if OWN_NAME.fullmatch(driver):
            return own_class(noun, scalar, findings)
        case Scalar(text=driver, span=span):
            message = f"There is no {noun} driver called {shortened(driver)}."
            hint = findings.suggest(driver, known) or f"Known are {listed(sorted(known), 'and')}."
            if driver in drivers(COUNTERPARTS[noun]):
                hint = f"{driver} is for {COUNTERPARTS[noun]}s. Known for {noun}s are {listed(sorted(known), 'and')}."
            report_error(findings, "unknown-driver", span, message, hint)
        case Table(span=span):
            hint = "Write driver: and its name, and its options as lines below, as far in as driver."
            report_error(findings, "not-a-word", first_line(span), "Here stands the name of a driver.", hint)
        case other if not isinstance(other, Scalar) and other.span.text[:1] == "[":
            hint = f"A {noun} has one driver: {listed(sorted(known))}."
            report_error(findings, "not-a-word", first_line(other.span), "Here stands the name of a driver.", hint)
    return None


def _example(option: DriverOption) -> str:
    match option.shape:
        case "number" | "numbers":
            assert isinstance(option.type, Quantity)
            one = f"… {next(iter(option.type.units))}".strip()
            name = option.type.name
            return f"{one}, {name}" if option.shape == "number" else f"[{one}, {one}], each {name}"
        case "flag":
            return "true"
    assert isinstance(option.type, Reference)
    return listed(option.type.words) if option.type.words else f"…, a {option.type.noun}"


def _shipped(cls: Callable[..., Any], noun: str, **options: Any) -> tuple[Any, Timing]:
    """A driver of mindrun, and its timing."""
    driver = cls(**options)
    return driver, timing_of(driver, noun)


def _made(cls: DriverClass, values: Mapping[str, Any], name: Scalar, findings: Findings) -> tuple[Any, Timing] | None:
    """The driver and its timing, unless it says itself that its options do not go together."""
    try:
        return cls.make(**values)
    except BrokenDriverError as error:
        report_error(findings, "broken-driver", name.span, f"{error}.", error.hint)
        return None
    except (MindError, ValueError) as error:
        hint = getattr(error, "hint", "") or f"Look at the options of {name.text} in docs/drivers.md."
        report_error(findings, "impossible-driver", name.span, f"{name.text} cannot be wired so: {error}.", hint)
        return None
