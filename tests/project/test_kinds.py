"""A kind is one file that says all: what a new one leaves unsaid is told here, and nobody else asks for its class."""

import ast
from collections.abc import Iterator, Mapping
from dataclasses import fields
from importlib import import_module
from pathlib import Path
from typing import Any

from mindrun.kinds.functions.function import Function
from mindrun.kinds.registry import arguments, bases, kinds
from mindrun.kinds.sensors.sensor import SensorKind
from mindrun.numbers.quantity import THING
from mindrun.sim.codes import ACTUATOR_CODES, EVENT_CODES, MEASURE_CODES, THING_CODES

from mindlang.pictures.theme import NIGHT, PAPER
from tests.project.sources import COMPILER, ROOT, RUNTIME, modules, nodes

ROOMS = ("sensors", "functions", "actuators", "things", "scenes", "events", "measures", "bodies", "memory", "learners")
for room in ROOMS:
    import_module(f"mindrun.kinds.{room}")
NOUNS = ("body", "actuator", "sensor", "memory", "skill", "task", "content", "curriculum", "measure", "event")
KINDS = {cls for noun in NOUNS for cls in kinds(noun).values()}
COMMON = {"actuator": ("neutral", "delay"), "content": ("size", "away")}  # the arguments that each kind of a noun has
CODES = {
    "actuator": ACTUATOR_CODES,
    "content": THING_CODES,
    "measure": MEASURE_CODES,
    "event": EVENT_CODES,
}
OUTCOMES = {"reached", "delivered"}
GENERATORS = [
    ROOT / "tests" / "sim" / "worlds.py",
    ROOT / "tests" / "sim" / "drawn_teams.py",
    ROOT / "tests" / "hierarchies.py",
    ROOT / "tests" / "outside" / "minds.py",
]

# Where a module asks for the class of a kind outside of the room of its kinds, and why.
MAY_ASK = {
    "mindrun/train/ask_and_tell.py": "the learners' algorithms, one module each, are called here",
}


def every(*nouns: str) -> Iterator[tuple[str, str, type[Any]]]:
    """All kinds of these nouns, each with its noun and its name."""
    for noun in nouns:
        assert kinds(noun)
        yield from ((noun, name, cls) for name, cls in kinds(noun).items())


def test_every_kind_says_what_it_is() -> None:
    for _, name, cls in every(*NOUNS):
        assert not str(cls.__doc__).startswith(f"{cls.__name__}("), f"{name} has no docstring: what is it to a reader?"


def test_every_kind_says_all_that_the_program_asks() -> None:
    for noun, name, cls in every(*sorted({*bases().values()} & {*NOUNS})):
        base = next(cls for cls, of in bases().items() if of == noun)
        assert issubclass(cls, base), f"{name} is no {base.__name__}: the program could not ask it"


def test_every_kind_has_the_arguments_of_its_noun() -> None:
    for noun, name, cls in every(*COMMON):
        missing = {field for field in COMMON[noun] if not hasattr(cls, field)}
        assert not missing, f"{name} does not take {missing}"


def test_every_kind_is_simulated() -> None:
    for noun, name, cls in every(*CODES):
        is_simulated = name in CODES[noun] or getattr(cls, "is_obstacle", False)
        assert is_simulated, f"sim/codes.py has no code for {name}, so no lane knows what to do with it"


def test_every_sensor_has_a_lane_function() -> None:
    for _, name, cls in every("sensor"):
        assert cls.lane is not SensorKind.lane, f"{name} does not say what it reads in the lanes"


def test_every_function_is_the_same_in_both_executors() -> None:
    """One that says what it computes for the engine says it for the lanes; a procedure is called by its address."""
    for _, name, cls in every("skill"):
        is_one = (cls.forward is not Function.forward) == (cls.lane is not Function.lane)
        assert is_one or name == "procedure", f"{name} says what it computes for the engine or for the lanes alone"


def test_every_kind_says_what_it_is_about() -> None:
    for _, name, cls in every("sensor", "event", "measure"):
        one = cls(**{argument.field: f"its {argument.key}" for argument in arguments(cls)})
        things = [f"its {argument.key}" for argument in arguments(cls) if argument.type == THING]
        assert [one.thing] == (things[:1] or [""]), f"{name} does not say which thing it is about"
        about = [thing for thing, kind in kinds("content").items() if cls.is_about(kind)]
        assert about, f"{name} can be about no kind of thing"


def test_every_thing_says_what_becomes_of_it() -> None:
    for _, name, cls in every("content"):
        said = {field.name for field in fields(cls)} & OUTCOMES
        one = cls(**{argument.field: () for argument in arguments(cls) if argument.required})
        assert {*one.outcomes} == said, f"{name} takes {said or 'no outcome'} and has other outcomes"


def test_every_thing_has_its_colours() -> None:
    for _, name, cls in every("content"):
        is_drawn = cls.is_obstacle or (name in PAPER.things and name in NIGHT.things)
        assert is_drawn, f"pictures/theme.py has no colours for {name}"


def test_every_kind_is_drawn_by_the_tests() -> None:
    drawn = {node.id for path in GENERATORS for node in nodes(path) if isinstance(node, ast.Name)}
    for _, name, cls in every("actuator", "content", "measure", "event", "task"):
        assert cls.__name__ in drawn, f"no test of the lanes ever draws a {name}: tests/sim/worlds.py does not know it"


def asked(path: Path) -> list[str]:
    """The classes of kinds that a module matches on, has in a table, or asks for with isinstance or `type(…) is`."""
    known = dict(_imported(path))
    forms = (part for node in nodes(path) for form in _forms(node) for part in ast.walk(form))
    classes = (_value(form, known) for form in forms)
    return sorted({found.__name__ for found in classes if isinstance(found, type) and found in KINDS})


def _forms(node: ast.AST) -> list[ast.expr]:
    """Where a node of a syntax tree names the classes that it tells apart."""
    match node:
        case ast.Call(func=ast.Name("isinstance" | "issubclass"), args=[_, form]) | ast.MatchClass(cls=form):
            return [form]
        case ast.Compare(left=ast.Call(func=ast.Name("type")), comparators=forms):
            return forms
        case ast.Dict(keys=keys):
            return [key for key in keys if key]
    return []


def _value(form: ast.AST, known: Mapping[str, object]) -> object:
    """What a name, or a name in a module, stands for."""
    match form:
        case ast.Name(name):
            return known.get(name)
        case ast.Attribute(ast.Name(module), name):
            return getattr(known.get(module), name, None)
    return None


def _imported(path: Path) -> Iterator[tuple[str, object]]:
    """What the names are that a module imports from the runtime."""
    for node in nodes(path):
        if isinstance(node, ast.ImportFrom) and str(node.module).partition(".")[0] == "mindrun":
            for alias in node.names:
                yield alias.asname or alias.name, getattr(import_module(str(node.module)), alias.name, None)


def _room(path: Path) -> bool:
    return path.is_relative_to(RUNTIME) and path.relative_to(RUNTIME).parts[0].removesuffix(".py") in ROOMS


def test_nobody_asks_for_the_class_of_a_kind() -> None:
    """A new kind is known everywhere as soon as it says of itself what the others say: nothing else has to change."""
    found = {}
    for path in modules(COMPILER, RUNTIME):
        shown = str(path.relative_to(RUNTIME.parent if path.is_relative_to(RUNTIME) else ROOT))
        if not _room(path) and shown not in MAY_ASK and (classes := asked(path)):
            found[shown] = classes
    assert not found, f"these modules ask which kind it is, instead of asking the kind: {found}"


def test_whoever_may_ask_does() -> None:
    idle = [shown for shown in MAY_ASK if not asked((RUNTIME.parent if "mindrun" in shown else ROOT) / shown)]
    assert not idle, f"these modules are allowed to ask for classes of kinds, and do not: {idle}"
