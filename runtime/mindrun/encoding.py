"""A graph or a wiring as plain data for JSON, and back: the dataclasses say what must stand there, nothing else may."""

from collections.abc import Mapping
from dataclasses import fields, is_dataclass
from importlib import import_module
from math import isfinite
from types import NoneType, UnionType
from typing import Annotated, Any, TypeVar, Union, get_args, get_origin, get_type_hints

from mindrun.driver import ActuatorDriver, SensorDriver
from mindrun.errors import BundleError, MindError
from mindrun.graph import Graph
from mindrun.quantity import Quantity, Reference, fits
from mindrun.registry import kinds, names
from mindrun.validate import graph_flaw
from mindrun.wiring import Wiring, flaws

T = TypeVar("T")
_known_hints: dict[type[Any], dict[str, Any]] = {}  # of each class that was decoded

PLAIN = (bool, int, float, str)
MAX_WHOLE_NUMBER = 2**53 - 1  # of a whole number: what any reader of JSON takes

DRIVERS: Mapping[Any, str] = {SensorDriver: "sensor driver", ActuatorDriver: "actuator driver"}  # nouns of the registry


def encode(value: object) -> Any:
    """A graph, or any part of one, as dicts, lists, strings and numbers; a kind names itself under "is"."""
    if isinstance(value, tuple):
        return [encode(part) for part in value]
    if not is_dataclass(value):
        return value
    data = {field.name: encode(getattr(value, field.name)) for field in fields(value)}
    name = names().get(type(value))
    return data if name is None else {"is": name, **data}


def decode(data: object) -> Graph:
    """The graph that `encode` made this data of; BundleError where anything is missing, unknown or out of range."""
    graph = decode_part(Graph, data, "graph")
    found = graph_flaw(graph)
    if found:
        raise BundleError(f"this graph is damaged: {found}")
    return graph


def decode_wiring(data: object, graph: Graph) -> Wiring:
    """The wiring that `encode` made this data of; BundleError where it is damaged, or one for another mind."""
    import_module("mindrun.robot.drivers")  # registers them all; a mind without a robot needs none

    wiring = decode_part(Wiring, data, "wiring")
    for found in flaws(wiring, graph):
        raise BundleError(f"this wiring does not fit its mind: {found}")
    return wiring


def decode_part(hint: type[T], data: object, where: str) -> T:
    """A part of a graph that `encode` made this data of; BundleError where it is not a `hint`."""
    part: T = _decode(hint, data, where)
    return part


def _decode(hint: Any, data: Any, where: str) -> Any:
    """The value of type `hint` that stands at `where`."""
    origin, parts = get_origin(hint), get_args(hint)
    if origin is Annotated:
        return _in_range(parts[1], _decode(parts[0], data, where), where)
    if origin in (Union, UnionType):
        return _decode_union(parts, data, where)
    if origin is tuple:
        return _decode_tuple(parts, data, where)
    if hint in DRIVERS:
        return _decode_driver(DRIVERS[hint], data, where)
    return (_decode_plain if hint in PLAIN else _decode_fields)(hint, data, where)


def _decode_plain(hint: Any, data: Any, where: str) -> Any:
    if type(data) is int and abs(data) > MAX_WHOLE_NUMBER:
        raise BundleError(f"this is damaged: {where} is no number that can be")
    if hint is float and type(data) is int:
        data = float(data)
    if type(data) is not hint or (hint is float and not isfinite(data)):
        raise BundleError(f"this is damaged: {where} is not a {hint.__name__}")
    if hint is str and not data.isprintable():
        raise BundleError(f"this is damaged: {where} cannot be {data!r:.60}")
    return data


def _decode_union(hints: tuple[Any, ...], data: Any, where: str) -> Any:
    if data is None and NoneType in hints:
        return None
    hints = tuple(hint for hint in hints if hint is not NoneType)
    if isinstance(data, Mapping) and "is" in data:
        hints = tuple(hint for hint in hints if names().get(hint) == data["is"])
    elif len(hints) > 1:  # a number in an expression
        hints = tuple(hint for hint in hints if hint is type(data))
    if len(hints) != 1:
        raise BundleError(f"this is damaged: {where} is of an unknown kind")
    return _decode(hints[0], data, where)


def _decode_driver(noun: str, data: Any, where: str) -> Any:
    """A driver: the same name can stand for a sensor's and for an actuator's."""
    name = data.get("is") if isinstance(data, Mapping) else None
    if not isinstance(name, str) or name not in kinds(noun):
        raise BundleError(f"{where} is {name!r:.60}, which is no {noun} of this mindrun")
    try:
        return _decode_fields(kinds(noun)[name], data, where)
    except (MindError, ValueError) as error:
        raise error if isinstance(error, BundleError) else BundleError(f"{where} cannot be so: {error}") from error


def _decode_tuple(hints: tuple[Any, ...], data: Any, where: str) -> tuple[Any, ...]:
    if not isinstance(data, list):
        raise BundleError(f"this is damaged: {where} is not a list")
    if Ellipsis in hints:
        hints = hints[:1] * len(data)
    if len(hints) != len(data):
        raise BundleError(f"this is damaged: {where} has {len(data)} entries")
    return tuple(_decode(hint, part, f"{where}[{i}]") for i, (hint, part) in enumerate(zip(hints, data, strict=True)))


def _decode_fields(cls: type[Any], data: Any, where: str) -> Any:
    hints, name = _hints(cls), names().get(cls)
    expected = hints.keys() | ({"is"} if name else set())
    if not isinstance(data, Mapping) or data.keys() != expected or data.get("is") != name:
        raise BundleError(f"this is damaged: {where} is not a {cls.__name__}")
    return cls(**{name: _decode(hint, data[name], f"{where}.{name}") for name, hint in hints.items()})


def _hints(cls: type[Any]) -> dict[str, Any]:
    if cls not in _known_hints:
        _known_hints[cls] = get_type_hints(cls, include_extras=True)
    return _known_hints[cls]


def _in_range(meaning: Quantity | Reference, value: Any, where: str) -> Any:
    if not fits(meaning, value):
        raise BundleError(f"this is damaged: {where} cannot be {value!r:.60}")
    return value
