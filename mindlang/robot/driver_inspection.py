"""What a user's driver says of itself, asked in a process of its own: `python -m mindlang.robot.driver_inspection`.

It takes a question on standard input and gives an answer on standard output, both as JSON. What the driver's code
prints goes elsewhere, and how it ends is nobody else's end.
"""

import json
import os
import sys
import traceback
from collections.abc import Mapping
from dataclasses import MISSING, asdict, is_dataclass
from math import inf
from typing import Any

from mindrun.errors import MindError
from mindrun.numbers.quantity import NUMBER, Quantity
from mindrun.robot.drivers.own import DriverCode, decoded, load_class

from mindlang.robot.direction import near_value
from mindlang.robot.options import DriverOption, driver_options
from mindlang.robot.timing import UnfitTimingError, timing_of

Answer = dict[str, Any]


class NoDriverError(Exception):
    """A class that is no driver; the sentence goes on after its name."""


def main() -> None:
    """Answer one question."""
    question = json.load(sys.stdin)
    answers = os.dup(1)
    os.dup2(2, 1)  # what the driver prints is no answer
    os.write(answers, json.dumps(_answer(question), allow_nan=False).encode())
    os._exit(0)  # whatever threads the driver has begun


def _answer(question: Mapping[str, Any]) -> Answer:
    code = DriverCode(**{**question["code"], "lines": tuple(question["code"]["lines"])})
    try:
        try:
            cls = load_class(code)
        except AttributeError as error:
            return {"absent": _classes(code)} if _is_outside(error) else {"raised": _reason(error, code)}
        if question["options"] is None:
            return {"options": [_plain(option) for option in _options(cls)]}
        return _facts(cls, question["noun"], decoded(question["options"]))
    except NoDriverError as error:
        return {"unfit": str(error)}
    except BaseException as error:  # a user's code may raise anything
        return {"raised": _reason(error, code)}


def _is_outside(error: BaseException) -> bool:
    """Whether an error comes from asking for the class, and not from code of the user."""
    frames = traceback.extract_tb(error.__traceback__)
    return frames[-1].name == load_class.__name__


def _classes(code: DriverCode) -> list[str]:
    module = sys.modules[f"mindrun_driver_{code.digest}"]
    return [name for name, value in vars(module).items() if isinstance(value, type) and is_dataclass(value)]


def _reason(error: BaseException, code: DriverCode) -> str:
    """What was raised, and on which line of the driver's file."""
    frames = traceback.extract_tb(error.__traceback__)
    lines = [frame.lineno for frame in frames if frame.filename == code.origin]
    line = error.lineno if isinstance(error, SyntaxError) else lines[-1] if lines else None
    words = error.msg if isinstance(error, SyntaxError) else str(error)
    said = f"{type(error).__name__}{f': {words}' * bool(words)}"
    return f"{f'line {line}: ' * bool(line)}{said:.200}"


def _options(cls: Any) -> tuple[DriverOption, ...]:
    if not (isinstance(cls, type) and is_dataclass(cls)) or not cls.__dataclass_params__.frozen:  # type: ignore[attr-defined]
        raise NoDriverError("is no frozen dataclass")
    if not callable(getattr(cls, "open", None)):
        raise NoDriverError("has no method open")
    return driver_options(cls)


def _plain(option: DriverOption) -> Answer:
    """An option as data: its type is a quantity with units, or the words that can stand there."""
    data = {name: getattr(option, name) for name in ("key", "field", "shape", "count")}
    type_ = {name: None if value in (inf, -inf) else value for name, value in asdict(option.type).items()}
    said = {} if option.default is MISSING else {"default": option.default}
    return {**data, **said, "is_quantity": isinstance(option.type, Quantity), "type": type_}


def _facts(cls: Any, noun: str, options: Mapping[str, Any]) -> Answer:
    """What a driver with these options says of itself."""
    try:
        driver = cls(**options)
        device = getattr(driver, "device", "")
    except (MindError, ValueError) as error:
        return {"impossible": str(error), "hint": getattr(error, "hint", "")}
    if not isinstance(device, str) or not (device.isprintable()):
        raise NoDriverError("has a device that is no text")
    facts = {} if noun == "actuator" else _sensor_facts(driver)
    return {"facts": {**facts, "device": device}, "timing": _timing(driver, noun)}


def _timing(driver: Any, noun: str) -> Answer:
    """What a driver says of its time; None for what has no end."""
    try:
        timing = timing_of(driver, noun)
    except UnfitTimingError as error:
        raise NoDriverError(str(error)) from error
    return {name: None if value == inf else value for name, value in asdict(timing).items()}


def _sensor_facts(driver: Any) -> Answer:
    """What a sensor's driver says of its values."""
    for name in ("unit", "readings", "usual"):
        if not hasattr(driver, name):
            raise NoDriverError(f"says no {name}, so it is for no sensor")
    unit, readings = driver.unit, driver.readings
    if not isinstance(unit, str) or not unit.isprintable():
        raise NoDriverError("has a unit that is no text")
    if type(readings) is not int or readings < 1:
        raise NoDriverError("has readings that are no whole number from 1")
    near = near_value(driver)
    usual, possible = _pair(driver.usual, "usual"), _pair(getattr(driver, "possible", (-1e9, 1e9)), "possible")
    facts = {"unit": unit, "readings": readings, "usual": usual, "possible": possible}
    return {**facts, "near": near if near is None else float(near)}


def _pair(values: Any, name: str) -> tuple[float, float]:
    """Two numbers, within what a wiring can hold."""
    try:
        low, high = (min(max(float(value), NUMBER.low), NUMBER.high) for value in values)
    except (TypeError, ValueError):
        raise NoDriverError(f"has a {name} that is no pair of numbers") from None
    return low, high


if __name__ == "__main__":
    main()
