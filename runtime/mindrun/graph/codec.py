"""Dataclasses as plain data for JSON, and back: their annotations say what must stand there, and nothing else may."""

from collections.abc import Mapping
from dataclasses import fields, is_dataclass
from math import isfinite
from types import NoneType, UnionType
from typing import Annotated, Any, Literal, TypeVar, Union, get_args, get_origin, get_type_hints

from mindrun.errors import BundleError, MindError
from mindrun.kinds.registry import bases, find_kind, later_fields, names
from mindrun.numbers.quantity import fits

PLAIN = (bool, int, float, str)
MAX_WHOLE_NUMBER = 2**53 - 1  # what any reader of JSON takes

T = TypeVar("T")
_known_hints: dict[type[Any], dict[str, Any]] = {}  # of each class that was decoded


class CodecError(ValueError):
    """Data that nothing was encoded as; `unknown`: it may have been, by another version."""

    def __init__(self, message: str, unknown: bool = False) -> None:
        super().__init__(message)
        self.unknown = unknown


def encode(value: object) -> Any:
    """A dataclass, or any part of one, as dicts, lists, strings and numbers; a kind names itself under "is".

    A field that came later is left out where it has its default, so that what is older than it keeps its bytes.
    """
    if isinstance(value, tuple):
        return [encode(part) for part in value]
    if not is_dataclass(value):
        return value
    later = later_fields(type(value))
    said = {field.name: getattr(value, field.name) for field in fields(value)}
    data = {name: encode(each) for name, each in said.items() if name not in later or each != later[name]}
    name = names().get(type(value))
    return data if name is None else {"is": name, **data}


def decode(hint: Any, data: Any, where: str) -> Any:
    """The value of type `hint` of which `encode` made this data; CodecError says `where` there is none."""
    origin, parts = get_origin(hint), get_args(hint)
    if origin is Annotated:
        value = decode(parts[0], data, where)
        return _one_of(fits(parts[1], value), value, where)
    if origin in (Union, UnionType):
        return _union(parts, data, where)
    if origin is Literal:
        return _one_of(data in parts, data, where)
    if origin is tuple:
        return _tuple(parts, data, where)
    if hint in bases():
        return _kind(bases()[hint], data, where)
    return _plain(hint, data, where) if hint in PLAIN else _fields(hint, data, where)


def decode_part(hint: type[T], data: object, where: str) -> T:
    """A part of a graph that `encode` made this data of; BundleError where it is not a `hint`."""
    try:
        part: T = decode(hint, data, where)
    except CodecError as error:
        raise BundleError(str(error) if error.unknown else f"this is damaged: {error}") from error
    return part


def _union(hints: tuple[Any, ...], data: Any, where: str) -> Any:
    if data is None and NoneType in hints:
        return None
    hints = tuple(hint for hint in hints if hint is not NoneType)
    if isinstance(data, Mapping) and "is" in data:
        hints = tuple(hint for hint in hints if names().get(hint) == data["is"])
    elif len(hints) > 1:  # a number in an expression, one number or two
        plain = tuple if isinstance(data, list) else type(data)
        fitting = tuple(hint for hint in hints if (get_origin(hint) or hint) is plain)
        hints = fitting or tuple(hint for hint in hints if hint is float and plain is int)
    if len(hints) != 1:
        raise CodecError(f"{where} is of an unknown kind")
    return decode(hints[0], data, where)


def _tuple(hints: tuple[Any, ...], data: Any, where: str) -> tuple[Any, ...]:
    if not isinstance(data, list):
        raise CodecError(f"{where} is not a list")
    if Ellipsis in hints:
        hints = hints[:1] * len(data)
    if len(hints) != len(data):
        raise CodecError(f"{where} has {len(data)} entries")
    pairs = enumerate(zip(hints, data, strict=True))
    return tuple(decode(hint, part, f"{where}[{place}]") for place, (hint, part) in pairs)


def _kind(noun: str, data: Any, where: str) -> Any:
    """A kind of a noun; another noun may have one of the same name."""
    name = data.get("is") if isinstance(data, Mapping) else None
    cls = find_kind(noun, name) if isinstance(name, str) else None
    if cls is None:
        raise CodecError(f"{where} is {name!r:.60}, which is no {noun} of this mindrun", unknown=True)
    try:
        return _fields(cls, data, where)
    except CodecError:
        raise
    except (MindError, ValueError) as error:
        raise CodecError(f"{where} cannot be so: {error}", unknown=True) from error


def _fields(cls: type[Any], data: Any, where: str) -> Any:
    hints, name = _hints(cls), names().get(cls)
    expected = hints.keys() | ({"is"} if name else set())
    required = expected - later_fields(cls).keys()
    if not isinstance(data, Mapping) or not required <= data.keys() <= expected or data.get("is") != name:
        raise CodecError(f"{where} is not a {cls.__name__}")
    return cls(**{name: decode(hint, data[name], f"{where}.{name}") for name, hint in hints.items() if name in data})


def _plain(hint: Any, data: Any, where: str) -> Any:
    if type(data) is int and abs(data) > MAX_WHOLE_NUMBER:
        raise CodecError(f"{where} is no number that can be")
    if hint is float and type(data) is int:
        data = float(data)
    is_sound = isfinite(data) if type(data) is float else data.isprintable() if type(data) is str else True
    return _one_of(type(data) is hint and is_sound, data, where)


def _one_of(may_be: bool, value: Any, where: str) -> Any:
    """A value that may stand there; CodecError where it may not."""
    if not may_be:
        raise CodecError(f"{where} cannot be {value!r:.60}")
    return value


def _hints(cls: type[Any]) -> dict[str, Any]:
    if cls not in _known_hints:
        hints = get_type_hints(cls, include_extras=True)
        _known_hints[cls] = {field.name: hints[field.name] for field in fields(cls)}
    return _known_hints[cls]
