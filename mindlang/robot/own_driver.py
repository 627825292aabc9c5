"""A driver of one's own: found beside `robot.yaml` or in an installed package, and asked what it is.

Its code runs in a process of its own that may take some seconds, and only here: where a bundle is built.
"""

import json
import os
import subprocess
import sys
from collections.abc import Callable, Sequence
from dataclasses import MISSING, asdict, dataclass
from functools import cache, partial
from math import inf
from pathlib import Path
from typing import Any

from mindrun.errors import MindError, reason
from mindrun.files.regular_files import read_regular
from mindrun.numbers.quantity import Quantity, Reference
from mindrun.robot.drivers.own import ENTRY_POINTS, DriverCode, OwnActuator, OwnSensor, encoded, of_file, of_package

from mindlang.compiler.diagnostic import Findings, listed
from mindlang.robot.nodes import Scalar, report_error
from mindlang.robot.options import DriverOption
from mindlang.robot.timing import Timing

ANSWER_SECONDS = 10.0  # that a driver may take to be imported
MAX_DRIVER_BYTES = 32 << 10  # bytes of a file: each wire carries it
INSPECTION = "mindlang.robot.driver_inspection"
OUTSIDE = "What takes long, or waits for a device, belongs into open()."


class BrokenDriverError(MindError):
    """A driver of a user whose code cannot be read, does not run, or is no driver."""


@dataclass(frozen=True, slots=True)
class DriverClass:
    """What a driver can be told, and how it is made of that, with its timing."""

    options: tuple[DriverOption, ...]
    make: Callable[..., tuple[Any, Timing]]


def own_class(noun: str, name: Scalar, findings: Findings) -> DriverClass | None:
    """The driver FILE.CLASS or PACKAGE.NAME; None after reporting why there is none."""
    try:
        code = _found(name.text, name.span.source.folder)
        if code is None:
            file, _, entry = name.text.partition(".")
            message = f"There is no {file}.py beside this file, and no package {file} offers a driver {entry}."
            hint = f"Write {file}.py with a class {entry}; a package says it under {ENTRY_POINTS}."
            report_error(findings, "unknown-driver", name.span, message, hint)
            return None
        answer = _ask(code, noun, None)
    except BrokenDriverError as error:
        report_error(findings, "broken-driver", name.span, f"{error}.", error.hint)
        return None
    if "absent" in answer:
        _report_absent(name, code, answer["absent"], findings)
        return None
    return DriverClass(tuple(map(_option, answer["options"])), partial(_made, noun, code))


def _report_absent(name: Scalar, code: DriverCode, classes: Sequence[str], findings: Findings) -> None:
    file, _, cls = name.text.partition(".")
    known = [f"{file}.{each}" for each in classes]
    hint = f"Write it there: a frozen dataclass {cls} with a method open."
    if known:
        hint = findings.suggest(name.text, known) or f"Write driver: {listed(known)}."
    report_error(findings, "unknown-driver", name.span, f"{code.origin} has no class {cls}.", hint)


def _found(name: str, folder: Path) -> DriverCode | None:
    """The code of a driver; BrokenDriverError where its file cannot be read."""
    path = folder / f"{name.partition('.')[0]}.py"
    if not os.path.lexists(path):
        return of_package(name)
    try:
        data = read_regular(path, MAX_DRIVER_BYTES + 1)
        text = data.decode()
    except OSError as error:
        raise BrokenDriverError(
            f"{path.name} cannot be read: {reason(error)}", "Is it a file that you may read?"
        ) from error
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
    facts: dict[str, Any] = {
        key: tuple(value) if isinstance(value, list) else value for key, value in answer["facts"].items()
    }
    cls: type[Any] = OwnSensor if noun == "sensor" else OwnActuator
    timing: dict[str, Any] = {key: inf if value is None else value for key, value in answer["timing"].items()}
    return cls(code.name, code.digest, code.lines, code.package, said, **facts), Timing(**timing)


@cache
def _ask(code: DriverCode, noun: str, options: str | None) -> dict[str, Any]:
    """What a driver answers; BrokenDriverError where it has no answer that is one."""
    question = json.dumps({"code": asdict(code), "noun": noun, "options": options})
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, sys.path))}
    try:
        done = subprocess.run(
            [sys.executable, "-P", "-m", INSPECTION],
            input=question.encode(),
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            timeout=ANSWER_SECONDS,
            env=environment,
            start_new_session=True,  # Ctrl-C is for who asks
        )
    except subprocess.TimeoutExpired as error:
        raise BrokenDriverError(f"{code.origin} has not been imported after {ANSWER_SECONDS:g} s", OUTSIDE) from error
    try:
        answer: dict[str, Any] = json.loads(done.stdout)
    except ValueError as error:
        raise BrokenDriverError(
            f"{code.origin} ends the program that imports it", "Nothing in it may do that."
        ) from error
    if "raised" in answer:
        failed = "cannot be imported" if options is None else "does not take these options"
        hint = "Mend it" if options is None else "Mend it, or let the class refuse them with a ValueError that says why"
        raise BrokenDriverError(f"{code.origin} {failed}: {answer['raised']}", f"{hint}.")
    if "unfit" in answer:
        raise BrokenDriverError(f"{code.name} {answer['unfit']}", "docs/robot-yaml.md shows a driver that is whole.")
    return answer


def _option(data: dict[str, Any]) -> DriverOption:
    """An option as it was before it became data."""
    said, default = data["type"], data.get("default", MISSING)
    if data["is_quantity"]:
        low, high = said["low"], said["high"]
        bounds = {"low": -inf if low is None else low, "high": inf if high is None else high}
        meaning: Quantity | Reference = Quantity(**{**said, **bounds})
    else:
        meaning = Reference(said["noun"], tuple(said["words"]))
    default = tuple(default) if isinstance(default, list) else default
    return DriverOption(data["key"], data["field"], meaning, data["shape"], data["count"], default)
