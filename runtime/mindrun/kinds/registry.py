"""Kinds of the language, found by name: frozen dataclasses whose fields are their `.mind` arguments."""

from collections import defaultdict
from collections.abc import Callable, Mapping
from dataclasses import MISSING, dataclass, field, fields
from functools import cache
from importlib import import_module
from pkgutil import iter_modules
from re import fullmatch
from threading import RLock
from typing import (
    TYPE_CHECKING,
    Annotated,
    Any,
    Literal,
    TypeVar,
    dataclass_transform,
    get_args,
    get_origin,
    get_type_hints,
)

from mindrun.errors import text_of
from mindrun.kinds.packages import entries, package, package_digest
from mindrun.numbers.quantity import SLOT, Extent, Place, Quantity, Reference, Region, Span

if TYPE_CHECKING:
    from importlib.metadata import EntryPoint

T = TypeVar("T")

ROOMS = {  # where the kinds of a noun stand: a module for each, of its name, or one for all
    "sensor": "mindrun.kinds.sensors", "skill": "mindrun.kinds.functions", "actuator": "mindrun.kinds.actuators",
    "content": "mindrun.kinds.things", "event": "mindrun.kinds.events", "measure": "mindrun.kinds.measures",
    "body": "mindrun.kinds.bodies", "task": "mindrun.kinds.scenes", "scene": "mindrun.kinds.scenes",
    "memory": "mindrun.kinds.memory", "curriculum": "mindrun.kinds.learners",
    "sensor driver": "mindrun.robot.drivers", "actuator driver": "mindrun.robot.drivers",
}  # fmt: skip
SHARED_NOUNS = {"scene": "task"}  # a scene is one of those that a task can be in
_kinds: dict[str, dict[str, type[Any]]] = defaultdict(dict)
_names: dict[type[Any], str] = {}
_bases: dict[type[Any], str] = {}
_brought: dict[type[Any], "EntryPoint"] = {}  # kinds of packages, and by what
_refused: dict["EntryPoint", str] = {}  # why nothing of a package's module is there; empty where all is
_IMPORTING = RLock()
_arguments: dict[Any, tuple["Argument", ...]] = {}  # of each kind that was asked for

Shape = Literal["one", "list", "span", "name", "extent", "place", "places", "alternatives", "region", "lines"]
"""Of an argument: a number, several, a `Span`, a word, an `Extent`, a place, several, lists of places of which one is
drawn, a `Region`, the lines of a text file."""
SHAPES: Mapping[Any, Shape] = {
    Span: "span", Extent: "extent", Place: "place", tuple[Place, ...]: "places", tuple[str, ...]: "lines",
    tuple[tuple[Place, ...], ...]: "alternatives", Region: "region",
}  # fmt: skip


def left_out(default: Any, is_argument: bool = True) -> Any:
    """A dataclass's field that is left out of plain data where it has this value: what came later than the files.

    One of a kind that is no argument of it is said otherwise.
    """
    return field(default=default, metadata={"left out": True, "argument": is_argument})


@dataclass(frozen=True, slots=True)
class Argument:
    """An argument of a kind: its key in a `.mind`, its field, the type and shape of its value, and its default."""

    key: str
    field: str
    type: Quantity | Reference
    shape: Shape
    default: Any

    @property
    def required(self) -> bool:
        """True if it has no default, so that it must be written."""
        return self.default is MISSING


@dataclass_transform(frozen_default=True, field_specifiers=(field,))
def kind(noun: str, name: str) -> Callable[[type[T]], type[T]]:
    """Make a class a frozen dataclass with slots, if it is none yet, and register it as the kind `name` of `noun`.

    ValueError where it is one of a package that cannot be: the name of a function of one's own has a dot.
    """

    def register(cls: type[T]) -> type[T]:
        cls = cls if "__dataclass_fields__" in vars(cls) else dataclass(frozen=True, slots=True)(cls)
        if _is_brought(cls) and (why := _mistake(noun, name, cls)):
            raise ValueError(why)
        _kinds[noun][name] = cls
        _names[cls] = name
        return cls

    return register


def kinds(noun: str) -> dict[str, type[Any]]:
    """Every kind of a noun, by name; all of its modules are imported for it, and those of packages."""
    if noun in ROOMS:
        _import_all(ROOMS[noun])
    if noun == "skill":
        _import_packages()
    found = _kinds[SHARED_NOUNS.get(noun, noun)]
    return {name: found[name] for name in sorted(found)}


def find_kind(noun: str, name: str) -> type[Any] | None:
    """The kind of that name, or None. A module called as the kind is imported alone, else all modules of its noun."""
    known, module = _kinds[SHARED_NOUNS.get(noun, noun)], name.replace(" ", "_")
    if name not in known and noun in ROOMS and module in _modules(ROOMS[noun]):
        import_module(f"{ROOMS[noun]}.{module}")
    return known.get(name) or kinds(noun).get(name)


@cache
def _modules(room: str) -> list[str]:
    return [module.name for module in iter_modules(getattr(import_module(room), "__path__", []))]


@cache
def _import_all(room: str) -> None:
    for module in _modules(room):
        import_module(f"{room}.{module}")


def _import_packages() -> None:
    """Import what installed packages bring, each once; one that fails leaves nothing, and the others go on."""
    with _IMPORTING:
        for entry in entries():
            if entry not in _refused:
                _refused[entry] = ""  # before it runs, and asks for kinds itself
                _refused[entry] = _import_package(entry)


def _import_package(entry: "EntryPoint") -> str:
    """Why no kind of a package's module can be used; empty where all can."""
    why = ""
    try:
        entry.load()
    except (Exception, SystemExit) as error:
        why = f"{type(error).__name__}: {text_of(error)}"
    for noun, name, cls in [(noun, name, cls) for noun, known in _kinds.items() for name, cls in known.items()]:
        if cls not in _brought and _top(cls.__module__) == _top(entry.module):
            if why:
                del _kinds[noun][name], _names[cls]
            else:
                _brought[cls] = entry
    return why


def _is_brought(cls: type[Any]) -> bool:
    """True if the class is of a package that says that it has kinds."""
    top = _top(cls.__module__)
    return top != "mindrun" and any(_top(entry.module) == top for entry in entries())


def _mistake(noun: str, name: str, cls: type[Any]) -> str:
    """Why nobody outside of mindrun can bring this kind; empty where one can."""
    other = _kinds[noun].get(name)
    if noun != "skill" or not any(issubclass(cls, each) for each, of in _bases.items() if of == noun):
        return f"{name} is no function of a skill, and only these can be of one's own"
    if not fullmatch(r"[a-z]\w*(\.[a-z]\w*)+", name):
        return f"{name} is no name with a dot, such as lab.{name.lower()}: those without are the language's"
    arguments(cls)
    return f"{other.__module__} has a kind {name}, too" if other and other.__module__ != cls.__module__ else ""


def _top(module: str) -> str:
    return module.partition(".")[0]


def brought_by(cls: type[Any]) -> tuple[str, str] | None:
    """The name and version of the package that brings a kind, and the hash of its code; None of those that are here."""
    return (package(_brought[cls]), package_digest(_brought[cls])) if cls in _brought else None


def refused_packages() -> dict[str, str]:
    """Why the kinds of packages that are installed cannot be used, by their names and versions."""
    _import_packages()
    return {package(entry): why for entry, why in _refused.items() if why}


def base(noun: str) -> Callable[[type[T]], type[T]]:
    """Register a class as the base of the kinds of a noun: an annotation with it takes each of them."""

    def register(cls: type[T]) -> type[T]:
        _bases[cls] = noun
        return cls

    return register


def bases() -> Mapping[type[Any], str]:
    """The noun of every class that kinds have in common."""
    return _bases


def names() -> Mapping[type[Any], str]:
    """The name of every registered kind."""
    return _names


def arguments(cls: type[Any]) -> tuple[Argument, ...]:
    """The arguments that a kind takes, in the order of its fields, its own before those that others have too."""
    if cls not in _arguments:
        hints = get_type_hints(cls, include_extras=True)
        _arguments[cls] = tuple(
            Argument(f.name.removesuffix("_"), f.name, *_type(hints[f.name]), default=f.default)
            for f in sorted(fields(cls), key=lambda field: field.kw_only is True)
            if f.metadata.get("argument", True)
        )
    return _arguments[cls]


def later_fields(cls: type[Any]) -> dict[str, Any]:
    """The defaults of a dataclass's fields that are left out of its plain data where they have them, by name."""
    return {each.name: each.default for each in fields(cls) if "left out" in each.metadata}


def named_arguments(cls: type[Any]) -> tuple[Argument, ...]:
    """The arguments that are written with their keys: not what stands behind the kind itself, as in `observation 1`."""
    return tuple(each for each in arguments(cls) if each.key != _names[cls] and each.type != SLOT)


def varying_of(kind: Any) -> tuple[str, ...]:
    """The arguments of a kind that can differ from run to run; none of a sensor that is reckoned."""
    found: tuple[str, ...] = () if getattr(kind, "is_reckoned", False) else kind.varying
    return found


def varied_quantity(kind: Any, argument: str) -> Quantity | None:
    """The quantity of an argument of a kind that can differ from run to run; None where it cannot."""
    found = (each.type for each in arguments(type(kind)) if each.field == argument and argument in varying_of(kind))
    return next((quantity for quantity in found if isinstance(quantity, Quantity)), None)


def phrase(kind: object) -> str:
    """A kind with the arguments that differ from their defaults, much as it is written."""
    said = ((argument, getattr(kind, argument.field)) for argument in arguments(type(kind)))
    words = [f"{argument.key} {value}" for argument, value in said if value != argument.default]
    return " ".join([names()[type(kind)], *words, *getattr(kind, "more_words", ())])


def _type(hint: Any) -> tuple[Quantity | Reference, Shape]:
    if get_origin(hint) is not Annotated:
        raise TypeError(f"{hint} does not say what an argument means")
    plain, meaning = get_args(hint)[:2]
    if plain in SHAPES:
        return meaning, SHAPES[plain]
    if isinstance(meaning, Reference):
        return meaning, "name"
    return meaning, "list" if get_origin(plain) is tuple else "one"
