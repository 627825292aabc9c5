"""The options of a wire, fields of its own dataclass and of its driver's, and the JSON Schema by which editors help."""

import re
from dataclasses import MISSING, Field, dataclass, fields, replace
from functools import cache
from math import isinf
from types import NoneType, UnionType
from typing import Annotated, Any, Union, get_args, get_origin, get_type_hints

from mindrun.graph.wiring import ON_BROKEN, ActuatorWire, SensorWire
from mindrun.kinds.registry import kinds
from mindrun.numbers.quantity import NUMBER, Quantity, Reference

from mindlang.robot.read import texts

DRIVER = "driver"
OWN_NAME = re.compile(r"^[A-Za-z_][A-Za-z0-9_]*\.[A-Za-z_][A-Za-z0-9_]*$")  # FILE.CLASS, or PACKAGE.NAME
WORD = Reference("text")
WHOLE = Quantity("a whole number", {"": 1.0}, whole=True)
LIMITS = ("low", "high")  # of an actuator: one key, two fields
ENDS = {"low": "from", "high": "to"}  # of a sensor: in the unit of the driver, so they are read when there is one

DRAFT = "https://json-schema.org/draft/2020-12/schema"
NUMBER_PATTERN = r"-?[0-9]+(\.[0-9]+)?(/[0-9]+)?"
TEXT = {"type": "string", "minLength": 1, "maxLength": 200}
ANY_AMOUNT = {  # a value in a unit that only the driver knows
    "anyOf": [
        {"type": "number", "minimum": -1e6, "maximum": 1e6},
        {"type": "string", "pattern": rf"^{NUMBER_PATTERN} *[^\s0-9].*$"},
    ]
}


@dataclass(frozen=True, slots=True)
class DriverOption:
    """A key of `robot.yaml`. `shape` is "number", "numbers" (`count` of them, or any), "word", "flag" or "text"."""

    key: str
    field: str
    type: Quantity | Reference
    shape: str
    count: int | None
    default: Any

    @property
    def required(self) -> bool:
        return self.default is MISSING


@cache
def drivers(noun: str) -> dict[str, type[Any]]:
    """The drivers of "sensor" or "actuator" by name; those that users bring have another."""
    return {name: cls for name, cls in kinds(f"{noun} {DRIVER}").items() if name.isidentifier()}


@cache
def own_options(noun: str) -> tuple[DriverOption, ...]:
    """The options of every sensor or actuator, whatever its driver."""
    if noun == "sensor":
        found = driver_options(SensorWire, skipped=("sensor", DRIVER, "rest"))
        return tuple(replace(option, key=ENDS.get(option.key, option.key)) for option in found)
    found = driver_options(ActuatorWire, skipped=("actuator", DRIVER))
    share = next(option.type for option in found if option.field in LIMITS)
    rest = (option for option in found if option.field not in LIMITS)
    return (*rest, DriverOption("limits", "limits", share, "numbers", 2, (0.0, 1.0)))


def driver_options(cls: type[Any], skipped: tuple[str, ...] = ()) -> tuple[DriverOption, ...]:
    """The options of a driver, required ones and others."""
    hints = get_type_hints(cls, include_extras=True)
    found = sorted(fields(cls), key=lambda field: field.kw_only is True)  # its own before those that others have too
    return tuple(_option(field, hints[field.name]) for field in found if field.init and field.name not in skipped)


def _option(field: Field[Any], hint: Any) -> DriverOption:
    default = field.default if field.default_factory is MISSING else field.default_factory()
    hint = _without_none(hint)
    plain, meaning = get_args(hint)[:2] if get_origin(hint) is Annotated else (hint, None)
    plain = _without_none(plain)
    count = None
    if is_several := get_origin(plain) is tuple:
        plain, *others = get_args(plain)
        count = None if Ellipsis in others else 1 + len(others)
    if not isinstance(meaning, Quantity | Reference):
        meaning = WORD if plain in (str, bool) else WHOLE if plain is int else NUMBER
    match meaning:
        case _ if plain is bool:
            shape = "flag"
        case Reference(words=words):
            shape = "word" if words else "text"
        case _:
            shape = "number"
    return DriverOption(field.name.removesuffix("_"), field.name, meaning, shape + "s" * is_several, count, default)


def _without_none(hint: Any) -> Any:
    """The type of an option without None: float for `float | None`."""
    if get_origin(hint) in (Union, UnionType):
        return next(part for part in get_args(hint) if part is not NoneType)
    return hint


def schema() -> dict[str, Any]:
    """The JSON Schema of `robot.yaml` as plain data."""
    return {
        "$schema": DRAFT,
        "title": "robot.yaml of the mind language",
        "description": "What each sensor and actuator is wired to. mindc build --robot checks more than this.",
        "type": "object",
        "required": ["robot", "sensors", "actuators"],
        "additionalProperties": False,
        "properties": {
            "robot": {**TEXT, "description": "A name for the robot."},
            "on_broken": {"enum": [*ON_BROKEN.words], "description": "What happens where a skill breaks a promise."},
            "sensors": _section_schema("sensor"),
            "actuators": _section_schema("actuator"),
        },
        "$defs": {
            f"{noun} {name}": _wire_schema(noun, name, cls)
            for noun in ("sensor", "actuator")
            for name, cls in sorted(drivers(noun).items())
        },
    }


def _section_schema(noun: str) -> dict[str, Any]:
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
    return {
        "type": ["object", "null"],
        "description": f"Each {noun} by its name in the mind.",
        "additionalProperties": {
            "type": "object",
            "required": [DRIVER],
            "properties": {DRIVER: driver},
            "allOf": choices,
        },
    }


def _wire_schema(noun: str, name: str, cls: type[Any]) -> dict[str, Any]:
    """The JSON Schema of a sensor or actuator with this driver."""
    its, own = driver_options(cls), own_options(noun)
    text = " ".join(str(cls.__doc__).split())
    said = {option.key: _option_schema(option, texts()["options"][option.key]) for option in own}
    said |= {option.key: _option_schema(option, getattr(option.type, "name", "")) for option in its}
    return {
        "description": text,
        "required": [DRIVER, *(option.key for option in its if option.required)],
        "additionalProperties": False,
        "properties": {DRIVER: {"const": name, "description": text}, **said},
    }


def _option_schema(option: DriverOption, description: str) -> dict[str, Any]:
    is_end = option.key in ENDS.values() and option.field in ENDS
    found = ANY_AMOUNT if is_end else _value_schema(option)
    default = option.default
    has_units = isinstance(option.type, Quantity) and option.type.units.keys() - {"", "%"}
    told = default is not MISSING and default is not None and option.key not in ("blank", "dead_zone") and not has_units
    return found | ({"description": description} if description else {}) | ({"default": default} if told else {})


def _value_schema(option: DriverOption) -> dict[str, Any]:
    one: dict[str, Any]
    match option.shape.removesuffix("s"), option.type:
        case "number", Quantity() as quantity:  # a number, or a text with one of the units
            low = {} if isinf(quantity.low) else {"minimum": quantity.low}
            high = {} if isinf(quantity.high) else {"maximum": quantity.high}
            bare = {"type": "integer" if quantity.whole else "number", **low, **high}
            units = "|".join(re.escape(unit) for unit in quantity.units if unit)
            written = {"type": "string", "pattern": f"^{NUMBER_PATTERN} *({units})$"}
            one = bare if not units else {"anyOf": [bare, written]} if "" in quantity.units else written
        case "flag", _:
            one = {"type": "boolean"}
        case "word", Reference(words=words):
            one = {"enum": [*words]}
        case _:
            one = TEXT
    if not option.shape.endswith("s"):
        return one
    count = {"minItems": option.count, "maxItems": option.count} if option.count else {"minItems": 1}
    several = {"type": "array", "items": one, **count}
    return {"anyOf": [one, several]} if option.shape == "numbers" and option.count in (None, 1) else several
