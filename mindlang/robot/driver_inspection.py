"""The inspection of a driver: its options, the values that it measures, and how much time it needs.

A user's driver is asked in a process of its own, `python -m mindlang.robot.driver_inspection`, which takes a question
on standard input and gives an answer on standard output, both as JSON. What the driver's code prints goes elsewhere,
and how it ends is nobody else's end.
"""

import json
import os
import sys
import traceback
from collections.abc import Mapping
from dataclasses import asdict, dataclass, is_dataclass
from inspect import getattr_static
from math import inf, isfinite
from typing import Any

from mindrun.errors import MindError
from mindrun.numbers.given_numbers import is_truth, number
from mindrun.numbers.quantity import NUMBER, Quantity, fits
from mindrun.robot.driver_support import BUS
from mindrun.robot.drivers.own import DriverCode, decoded, load_class

from mindlang.robot.options import DriverOption, driver_options

Answer = dict[str, Any]
ABSENT = object()
METRES = "m"


class UnfitDriverError(Exception):
    """A class that is no driver, or says of itself what cannot be; the sentence goes on after its name."""


@dataclass(frozen=True, slots=True)
class Timing:
    """The timing of a driver, in the words of `SensorDriver`; `queue` is "" where nothing has to wait for another."""

    seconds: float = 0.0
    bus_seconds: float = 0.0
    most: float = inf
    bus: int = -1
    queue: str = ""


def timing_of(driver: object, noun: str) -> Timing:
    """The timing that a driver states; UnfitDriverError where it cannot be."""
    names = Timing.__dataclass_fields__.keys() | {"device"}
    said = {name: getattr(driver, name) for name in names if getattr_static(driver, name, ABSENT) is not ABSENT}
    queue = said.get("queue", said.get("device", "") if noun == "actuator" else "")
    if not isinstance(queue, str) or not queue.isprintable():
        raise UnfitDriverError("has a queue that is no text")
    seconds, bus_seconds = (_amount(said, name) for name in ("seconds", "bus_seconds"))
    bus = said.get("bus") if bus_seconds else -1
    if not isinstance(bus, int) or is_truth(bus) or (bus_seconds and not fits(BUS, bus)):
        raise UnfitDriverError(f"has bus_seconds, and no bus that is a whole number from {BUS.low:g} to {BUS.high:g}")
    return Timing(seconds, bus_seconds, _amount(said, "most", inf), bus, queue)


def near_value(driver: object) -> float | None:
    """The value of a driver that means that something is near; None where that depends on what is connected."""
    near: float | None = getattr(driver, "near", 0.0 if getattr(driver, "unit", "") == METRES else None)
    return near


def _amount(said: Mapping[str, Any], name: str, unsaid: float = 0.0) -> float:
    """A number from 0, which is finite or what it is where nothing is said."""
    given = said.get(name, unsaid)
    try:
        found = number(given)
    except Exception:  # whatever the code of a user's number raises
        found = -1.0
    if is_truth(given) or not (found == unsaid or (isfinite(found) and found >= 0)):
        raise UnfitDriverError(f"has {name} that {'is' if name == 'most' else 'are'} no number from 0: {given!r:.60}")
    return found


def main() -> None:
    """Answer one question."""
    question = json.load(sys.stdin)
    answers = os.dup(1)
    os.dup2(2, 1)  # what the driver prints is no answer
    os.write(answers, json.dumps(_answer(question)).encode())
    os._exit(0)  # whatever threads the driver has begun


def _answer(question: Mapping[str, Any]) -> Answer:
    code = DriverCode(**{**question["code"], "lines": tuple(question["code"]["lines"])})
    try:
        try:
            cls = load_class(code)
        except AttributeError as error:
            if traceback.extract_tb(error.__traceback__)[-1].name != load_class.__name__:  # it is from code of the user
                raise
            module = vars(sys.modules[f"mindrun_driver_{code.digest}"])
            classes = [name for name, value in module.items() if isinstance(value, type) and is_dataclass(value)]
            return {"absent": classes}
        if question["options"] is None:
            return {"options": [_plain(option) for option in _options(cls)]}
        return _facts(cls, question["noun"], decoded(question["options"]))
    except UnfitDriverError as error:
        return {"unfit": str(error)}
    except BaseException as error:  # a user's code may raise anything
        return {"raised": _reason(error, code)}


def _reason(error: BaseException, code: DriverCode) -> str:
    """The exception in words, and the last line of the driver's file that it came through."""
    frames = traceback.extract_tb(error.__traceback__)
    lines = [frame.lineno for frame in frames if frame.filename == code.origin]
    line = error.lineno if isinstance(error, SyntaxError) else lines[-1] if lines else None
    words = error.msg if isinstance(error, SyntaxError) else str(error)
    said = f"{type(error).__name__}{f': {words}' * bool(words)}"
    return f"{f'line {line}: ' * bool(line)}{said:.200}"


def _options(cls: Any) -> tuple[DriverOption, ...]:
    if not (isinstance(cls, type) and is_dataclass(cls)) or not cls.__dataclass_params__.frozen:  # type: ignore[attr-defined]
        raise UnfitDriverError("is no frozen dataclass")
    if not callable(getattr(cls, "open", None)):
        raise UnfitDriverError("has no method open")
    return driver_options(cls)


def _plain(option: DriverOption) -> Answer:
    """An option as data: its type is a quantity with units, or the words that can stand there."""
    data = {name: getattr(option, name) for name in ("key", "field", "shape", "count")}
    said = {} if option.required else {"default": option.default}
    return {**data, **said, "is_quantity": isinstance(option.type, Quantity), "type": asdict(option.type)}


def _facts(cls: Any, noun: str, options: Mapping[str, Any]) -> Answer:
    """The facts that a driver with these options states about itself, or why it is impossible."""
    try:
        driver = cls(**options)
        device = getattr(driver, "device", "")
    except (MindError, ValueError) as error:
        return {"impossible": str(error), "hint": getattr(error, "hint", "")}
    if not isinstance(device, str) or not device.isprintable():
        raise UnfitDriverError("has a device that is no text")
    facts = {} if noun == "actuator" else _sensor_facts(driver)
    return {"facts": {**facts, "device": device}, "timing": asdict(timing_of(driver, noun))}


def _sensor_facts(driver: Any) -> Answer:
    """The facts that a sensor's driver states about its values; UnfitDriverError where one is missing or cannot be."""
    for name in ("unit", "readings", "usual"):
        if not hasattr(driver, name):
            raise UnfitDriverError(f"says no {name}, so it is for no sensor")
    unit, readings = driver.unit, driver.readings
    if not isinstance(unit, str) or not unit.isprintable():
        raise UnfitDriverError("has a unit that is no text")
    if type(readings) is not int or readings < 1:
        raise UnfitDriverError("has readings that are no whole number from 1")
    near = near_value(driver)
    usual, possible = _pair(driver.usual, "usual"), _pair(getattr(driver, "possible", (-1e9, 1e9)), "possible")
    facts = {"unit": unit, "readings": readings, "usual": usual, "possible": possible}
    return {**facts, "near": near if near is None else float(near)}


def _pair(values: Any, name: str) -> tuple[float, float]:
    """Two numbers, within what a wiring can hold."""
    try:
        low, high = (min(max(float(value), NUMBER.low), NUMBER.high) for value in values)
    except (TypeError, ValueError):
        raise UnfitDriverError(f"has a {name} that is no pair of numbers") from None
    return low, high


if __name__ == "__main__":
    main()
