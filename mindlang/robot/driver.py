"""The driver of a sensor or an actuator: found by name, also one of a user, with its options checked.

A user's driver is found beside `robot.yaml` or in an installed package, and inspected. Its code runs in a process of
its own that may take some seconds, and only here: where a bundle is built.
"""

import json
import os
import subprocess
import sys
from collections.abc import Callable, Mapping
from dataclasses import MISSING, asdict, dataclass, replace
from functools import cache, partial
from math import inf
from pathlib import Path
from typing import Any

from mindrun.errors import MindError, reason
from mindrun.files.regular_files import read_regular
from mindrun.numbers.quantity import Quantity, Reference
from mindrun.robot.drivers.own import ENTRY_POINTS, DriverCode, OwnActuator, OwnSensor, encoded, of_file, of_package

from mindlang.compiler.diagnostic import Findings, errors, listed
from mindlang.compiler.source import Span
from mindlang.robot import driver_inspection
from mindlang.robot.driver_inspection import Timing, timing_of
from mindlang.robot.options import DRIVER, ENDS, OWN_NAME, DriverOption, driver_options, drivers, own_options
from mindlang.robot.read import Items, Scalar, Table, TableEntry, first_line, shortened
from mindlang.robot.values import by_option, check_keys, is_empty, missing_key

COUNTERPARTS = {"sensor": "actuator", "actuator": "sensor"}
ANSWER_SECONDS = 10.0  # that a driver may take to be imported
MAX_DRIVER_BYTES = 32 << 10  # bytes of a file: each wire carries it
OUTSIDE = "What takes long, or waits for a device, belongs into open()."
INFINITIES = {"Infinity": inf, "-Infinity": -inf}  # in the JSON of an inspection


class BrokenDriverError(MindError):
    """A driver of a user whose code cannot be read, does not run, or is no driver."""


@dataclass(frozen=True, slots=True)
class DriverClass:
    """The options of a driver, and the function that makes it of their values, with its timing."""

    options: tuple[DriverOption, ...]
    make: Callable[..., tuple[Any, Timing]]


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
        """The entry with a key; None where there is none."""
        return self.table.entries.get(key)

    def span(self, *keys: str) -> Span:
        """The span of the value of the first of these keys that is written, or else of the name."""
        said = [entry for entry in map(self.entry, keys) if entry]
        return first_line(said[0].value.span) if said else self.name.span


def wired(noun: str, name: Scalar, table: Table, findings: Findings) -> Wired | None:
    """The driver that a table wires, its keys and values checked; None after reporting why there is none."""
    before = len(errors(findings.diagnostics))
    cls = _class(noun, name, table, findings)
    if cls is None:
        return None
    driver = table.entries[DRIVER].value
    assert isinstance(driver, Scalar)
    own = {option.key: option for option in own_options(noun)}
    its = {option.key: option for option in cls.options}
    others = {key: entry for key, entry in table.entries.items() if key != DRIVER}
    needed = {option.key: example(option) for option in cls.options if option.required}
    what = f"The driver {driver.text}"
    check_keys(replace(table, entries=others), driver.span, what, [*its, *own], needed, findings)
    values = by_option(others.values(), its, findings)
    rest = [entry for key, entry in others.items() if key not in {*its, *ENDS.values()}]
    own_values = by_option(rest, own, findings)
    said = others.keys() - ENDS.values()
    if len(errors(findings.diagnostics)) > before or len(said) > len(values) + len(own_values) or not table.whole:
        return None
    try:
        made, timing = cls.make(**values)
    except BrokenDriverError as error:
        findings.error("broken-driver", driver.span, f"{error}.", error.hint)
        return None
    except (MindError, ValueError) as error:
        hint = getattr(error, "hint", "") or f"Look at the options of {driver.text} in docs/drivers.md."
        findings.error("impossible-driver", driver.span, f"{driver.text} cannot be wired so: {error}.", hint)
        return None
    every = {option.field: values.get(option.field, option.default) for option in cls.options}
    return Wired(name, table, noun, made, timing, own_values, cls.options, every)


def _class(noun: str, name: Scalar, table: Table, findings: Findings) -> DriverClass | None:
    known = drivers(noun)
    if (entry := table.entries.get(DRIVER)) is None:
        if table.whole:
            missing_key(name.span, name.text, DRIVER, listed(sorted(known)), findings)
        return None
    code, message, hint = "not-a-word", "Here stands the name of a driver.", ""
    match entry.value:
        case Scalar(text=driver) if driver in known:
            return DriverClass(driver_options(known[driver]), partial(_shipped, known[driver], noun))
        case _ if is_empty(entry, findings):
            return None
        case Scalar(text=driver) as scalar if OWN_NAME.fullmatch(driver):
            return _own_class(noun, scalar, findings)
        case Scalar(text=driver):
            code, message = "unknown-driver", f"There is no {noun} driver called {shortened(driver)}."
            hint = findings.suggest(driver, known) or f"Known are {listed(sorted(known), 'and')}."
            if driver in drivers(COUNTERPARTS[noun]):
                hint = f"{driver} is for {COUNTERPARTS[noun]}s. Known for {noun}s are {listed(sorted(known), 'and')}."
        case Table():
            hint = "Write driver: and its name, and its options as lines below, as far in as driver."
        case Items(span=span) if not span.text.startswith(("!", "&")):  # which has been reported
            hint = f"A {noun} has one driver: {listed(sorted(known))}."
    if hint:
        findings.error(code, first_line(entry.value.span), message, hint)
    return None


def example(option: DriverOption) -> str:
    """The form of an option's value, with … where the value stands."""
    match option.type:
        case _ if option.shape == "flag":
            return "true"
        case Reference(noun=noun, words=words):
            return listed(words) if words else f"…, a {noun}"
        case Quantity(name=name, units=units):
            one = f"… {next(iter(units))}".strip()
            return f"{one}, {name}" if option.shape == "number" else f"[{one}, {one}], each {name}"


def _shipped(cls: Callable[..., Any], noun: str, **options: Any) -> tuple[Any, Timing]:
    driver = cls(**options)
    return driver, timing_of(driver, noun)


def _own_class(noun: str, name: Scalar, findings: Findings) -> DriverClass | None:
    """The driver FILE.CLASS or PACKAGE.NAME; None after reporting why there is none."""
    file, _, cls = name.text.partition(".")
    try:
        code = _found(name.text, name.span.source.folder)
        if code is None:
            message = f"There is no {file}.py beside this file, and no package {file} offers a driver {cls}."
            hint = f"Write {file}.py with a class {cls}; a package says it under {ENTRY_POINTS}."
            findings.error("unknown-driver", name.span, message, hint)
            return None
        answer = _ask(code, noun, None)
    except BrokenDriverError as error:
        findings.error("broken-driver", name.span, f"{error}.", error.hint)
        return None
    if "absent" in answer:
        hint = f"Write it there: a frozen dataclass {cls} with a method open."
        if known := [f"{file}.{each}" for each in answer["absent"]]:
            hint = findings.suggest(name.text, known) or f"Write driver: {listed(known)}."
        findings.error("unknown-driver", name.span, f"{code.origin} has no class {cls}.", hint)
        return None
    return DriverClass(tuple(map(_option, answer["options"])), partial(_made, noun, code))


def _found(name: str, folder: Path) -> DriverCode | None:
    """The code of a driver; BrokenDriverError where its file cannot be read."""
    path = folder / f"{name.partition('.')[0]}.py"
    if not os.path.lexists(path):
        return of_package(name)
    try:
        data = read_regular(path, MAX_DRIVER_BYTES + 1)
        text = data.decode()
    except OSError as error:
        message = f"{path.name} cannot be read: {reason(error)}"
        raise BrokenDriverError(message, "Is it a file that you may read?") from error
    except UnicodeDecodeError as error:
        raise BrokenDriverError(f"{path.name} is not UTF-8", "Save it as UTF-8.") from error
    if len(data) > MAX_DRIVER_BYTES:
        hint = "Put what it shares with others into an installed package."
        raise BrokenDriverError(f"{path.name} is larger than {MAX_DRIVER_BYTES >> 10} kB", hint)
    for number, line in enumerate(text.split("\n"), 1):
        if not line.isprintable():
            hint = "Indent with spaces, and end lines as Linux does."
            raise BrokenDriverError(f"{path.name} has a character on line {number} that cannot be printed", hint)
    return of_file(name, text)


def _made(noun: str, code: DriverCode, **options: Any) -> tuple[Any, Timing]:
    """The driver as a bundle has it, and its timing; MindError where its class refuses these options."""
    said = encoded(options)
    answer = _ask(code, noun, said)
    if "impossible" in answer:
        raise MindError(answer["impossible"], answer["hint"] or f"So says its class, in {code.origin}.")
    facts: dict[str, Any] = {key: _as_tuple(value) for key, value in answer["facts"].items()}
    cls: type[Any] = OwnSensor if noun == "sensor" else OwnActuator
    return cls(code.name, code.digest, code.lines, code.package, said, **facts), Timing(**answer["timing"])


@cache
def _ask(code: DriverCode, noun: str, options: str | None) -> dict[str, Any]:
    """Inspect a driver in a process of its own, and return its answer; BrokenDriverError where none is fit."""
    question = json.dumps({"code": asdict(code), "noun": noun, "options": options})
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, sys.path))}
    try:
        done = subprocess.run(  # in a session of its own: Ctrl-C is for who asks
            [sys.executable, "-P", "-m", driver_inspection.__name__], input=question.encode(), stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL, timeout=ANSWER_SECONDS, env=environment, start_new_session=True,
        )  # fmt: skip
        answer: dict[str, Any] = json.loads(done.stdout, parse_constant=INFINITIES.__getitem__)
    except subprocess.TimeoutExpired as error:
        raise BrokenDriverError(f"{code.origin} has not been imported after {ANSWER_SECONDS:g} s", OUTSIDE) from error
    except (ValueError, KeyError) as error:
        message = f"{code.origin} ends the program that imports it"
        raise BrokenDriverError(message, "Nothing in it may do that.") from error
    if "raised" in answer:
        failed = "cannot be imported" if options is None else "does not take these options"
        hint = "Mend it" if options is None else "Mend it, or let the class refuse them with a ValueError that says why"
        raise BrokenDriverError(f"{code.origin} {failed}: {answer['raised']}", f"{hint}.")
    if "unfit" in answer:
        raise BrokenDriverError(f"{code.name} {answer['unfit']}", "docs/robot-yaml.md shows a driver that is whole.")
    return answer


def _option(data: dict[str, Any]) -> DriverOption:
    """An option as it was before it became data."""
    said = {key: _as_tuple(value) for key, value in data["type"].items()}
    meaning = Quantity(**said) if data["is_quantity"] else Reference(**said)
    default = _as_tuple(data.get("default", MISSING))
    return DriverOption(data["key"], data["field"], meaning, data["shape"], data["count"], default)


def _as_tuple(value: Any) -> Any:
    """A list of JSON as the tuple that it was before; any other value as it is."""
    return tuple(value) if isinstance(value, list) else value
