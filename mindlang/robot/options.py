"""The options of a wire: the fields of its own dataclass and of its driver's, with their types."""

from dataclasses import MISSING, Field, dataclass, fields, replace
from functools import cache
from importlib import import_module
from types import NoneType, UnionType
from typing import Annotated, Any, Union, get_args, get_origin, get_type_hints

from mindrun.graph.wiring import ActuatorWire, SensorWire
from mindrun.kinds.registry import kinds
from mindrun.numbers.quantity import NUMBER, Quantity, Reference

DRIVER = "driver"
WORD = Reference("text")
WHOLE = Quantity("a whole number", {"": 1.0}, whole=True)
LIMITS = ("low", "high")  # of an actuator: one key, two fields
OWN_NAMES = {"low": "from", "high": "to"}


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
        """Whether it must be given."""
        return self.default is MISSING


@cache
def drivers(noun: str) -> dict[str, type[Any]]:
    """The drivers of "sensor" or "actuator" by name; those that users bring have another."""
    import_module("mindrun.robot.drivers")
    return {name: cls for name, cls in kinds(f"{noun} {DRIVER}").items() if name.isidentifier()}


@cache
def own_options(noun: str) -> tuple[DriverOption, ...]:
    """The options of every sensor or actuator, whatever its driver."""
    if noun == "sensor":
        found = _options(SensorWire, skipped=("sensor", DRIVER, "rest"))
        return tuple(replace(option, key=OWN_NAMES.get(option.key, option.key)) for option in found)
    found = _options(ActuatorWire, skipped=("actuator", DRIVER, *LIMITS))
    share = next(option.type for option in _options(ActuatorWire, ("actuator", DRIVER)) if option.field == "low")
    return (*found, DriverOption("limits", "limits", share, "numbers", 2, (0.0, 1.0)))


def driver_options(cls: type[Any]) -> tuple[DriverOption, ...]:
    """The options of a driver, required ones and others."""
    return _options(cls)


def _options(cls: type[Any], skipped: tuple[str, ...] = ()) -> tuple[DriverOption, ...]:
    hints = get_type_hints(cls, include_extras=True)
    return tuple(_option(field, hints[field.name]) for field in fields(cls) if field.init and field.name not in skipped)


def _option(field: Field[Any], hint: Any) -> DriverOption:
    default = field.default if field.default_factory is MISSING else field.default_factory()
    plain, meaning, count = _type(hint)
    match plain, meaning:
        case _ if plain is bool:
            shape = "flag"
        case _, Reference(words=words):
            shape = "word" if words else "text"
        case _:
            shape = "number"
    if count is not None:
        shape, count = f"{shape}s", count or None
    return DriverOption(field.name.removesuffix("_"), field.name, meaning, shape, count, default)


def _type(hint: Any) -> tuple[Any, Quantity | Reference, int | None]:
    """The plain type of one value, its meaning, and how many there are: None for one, 0 for any number."""
    hint = _without_none(hint)
    plain, meaning = get_args(hint)[:2] if get_origin(hint) is Annotated else (hint, None)
    plain = _without_none(plain)
    count = None
    if get_origin(plain) is tuple:
        parts = get_args(plain)
        plain, count = parts[0], 0 if parts[-1] is Ellipsis else len(parts)
    match meaning:
        case Quantity() | Reference():
            return plain, meaning, count
    bare: dict[Any, Quantity | Reference] = {str: WORD, bool: WORD, int: WHOLE}
    return plain, bare.get(plain, NUMBER), count


def _without_none(hint: Any) -> Any:
    """The type of what may also be None, when it is said."""
    if get_origin(hint) in (Union, UnionType):
        return next(part for part in get_args(hint) if part is not NoneType)
    return hint
