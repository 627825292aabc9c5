"""The JSON Schema of `robot.yaml`, made from the drivers: what an editor completes and underlines while one writes."""

import re
from dataclasses import MISSING
from math import isinf
from typing import Any

from mindrun.numbers.quantity import Quantity, Reference

from mindlang.robot.driver import OWN_NAME
from mindlang.robot.options import DRIVER, DriverOption, driver_options, drivers, own_options

DRAFT = "https://json-schema.org/draft/2020-12/schema"
NUMBER = r"-?[0-9]+(\.[0-9]+)?(/[0-9]+)?"
OPTION_DESCRIPTIONS = {
    "from": "The value at which it reads 0, in the unit of the driver.",
    "to": "The value at which it reads 1, in the unit of the driver; it may be the smaller one.",
    "median": "Of so many values, an odd number, the median is taken.",
    "rate": "How often it is measured.",
    "max_age": "What was measured longer ago is a fault.",
    "on_fault": "On a fault: every actuator neutral, the reading before held, or blank read.",
    "hold": "For how long the reading before is held.",
    "blank": "What it reads where there is nothing to measure; as in training where it is not said.",
    "dead_zone": "Closer to 0, of a bearing to 0.5, it reads just that; as in training where it is not said.",
    "trim": "Added to every command, and to neutral.",
    "slew": "A command changes by no more than this share of the travel in a second.",
    "reversed": "Whether 0 and 1 change places.",
    "limits": "No command is below the first or above the second.",
}


def schema() -> dict[str, Any]:
    """The schema as plain data."""
    return {
        "$schema": DRAFT,
        "title": "robot.yaml of the mind language",
        "description": "What each sensor and actuator is wired to. mindc build --robot checks more than this.",
        "type": "object",
        "required": ["robot", "sensors", "actuators"],
        "additionalProperties": False,
        "properties": {
            "robot": {"type": "string", "minLength": 1, "maxLength": 200, "description": "A name for the robot."},
            "sensors": _section("sensor"),
            "actuators": _section("actuator"),
        },
        "$defs": {
            f"{noun} {name}": _wire(noun, name, cls)
            for noun in ("sensor", "actuator")
            for name, cls in sorted(drivers(noun).items())
        },
    }


def _section(noun: str) -> dict[str, Any]:
    names = sorted(drivers(noun))
    choices = [
        {
            "if": {"properties": {DRIVER: {"const": name}}, "required": [DRIVER]},
            "then": {"$ref": f"#/$defs/{noun}%20{name}"},
        }
        for name in names
    ]
    own = {"type": "string", "pattern": OWN_NAME.pattern, "description": "FILE.CLASS beside this file, or PACKAGE.NAME"}
    driver = {"anyOf": [{"enum": names}, own]}
    wire = {"type": "object", "required": [DRIVER], "properties": {DRIVER: driver}, "allOf": choices}
    return {
        "type": ["object", "null"],
        "description": f"Each {noun} by its name in the mind.",
        "additionalProperties": wire,
    }


def _wire(noun: str, name: str, cls: type[Any]) -> dict[str, Any]:
    """What can be said of a sensor or actuator with this driver."""
    its, own = driver_options(cls), own_options(noun)
    options = {option.key: option for option in (*own, *its)}
    text = " ".join(str(cls.__doc__).split())
    return {
        "description": text,
        "required": [DRIVER, *(option.key for option in its if option.required)],
        "additionalProperties": False,
        "properties": {
            DRIVER: {"const": name, "description": text},
            **{key: _described(key, option, own) for key, option in options.items()},
        },
    }


def _described(key: str, option: DriverOption, own: tuple[DriverOption, ...]) -> dict[str, Any]:
    found = _any_amount() if key in ("from", "to") and option in own else _value(option)
    words = OPTION_DESCRIPTIONS.get(key, "") if option in own else getattr(option.type, "name", "")
    told = option.default is not MISSING and option.default is not None and key not in ("blank", "dead_zone")
    default = (
        {"default": option.default} if told and not getattr(option.type, "units", {"": 1}).keys() - {"", "%"} else {}
    )
    return {**found, **({"description": words} if words else {}), **default}


def _value(option: DriverOption) -> dict[str, Any]:
    match option.shape.removesuffix("s"), option.type:
        case "number", Quantity() as quantity:
            one = _number(quantity)
        case "flag", _:
            one = {"type": "boolean"}
        case "word", Reference(words=words):
            one = {"enum": [*words]}
        case _:
            one = {"type": "string", "minLength": 1, "maxLength": 200}
    if not option.shape.endswith("s"):
        return one
    count = {"minItems": option.count, "maxItems": option.count} if option.count else {"minItems": 1}
    several = {"type": "array", "items": one, **count}
    single = option.shape == "numbers" and option.count in (None, 1)
    return {"anyOf": [one, several]} if single else several


def _number(quantity: Quantity) -> dict[str, Any]:
    """A number, or a text with one of the units."""
    low = {} if isinf(quantity.low) else {"minimum": quantity.low}
    high = {} if isinf(quantity.high) else {"maximum": quantity.high}
    bare = {"type": "integer" if quantity.whole else "number", **low, **high}
    units = "|".join(re.escape(unit) for unit in quantity.units if unit)
    if not units:
        return bare
    written = {"type": "string", "pattern": f"^{NUMBER} *({units})$"}
    return {"anyOf": [bare, written]} if "" in quantity.units else written


def _any_amount() -> dict[str, Any]:
    """A value in a unit that only the driver knows."""
    return {
        "anyOf": [
            {"type": "number", "minimum": -1e6, "maximum": 1e6},
            {"type": "string", "pattern": rf"^{NUMBER} *[^\s0-9].*$"},
        ]
    }
