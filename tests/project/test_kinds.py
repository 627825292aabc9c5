"""Every kind of the language has its code in the simulated world."""

import ast
from importlib import import_module

import pytest
from mindrun.registry import kinds
from mindrun.sensors import SensorKind

from tests.project.sources import RUNTIME, modules, tree

NOUNS = ("body", "actuator", "sensor", "memory", "skill", "task", "content", "curriculum", "measure", "event")
SIMULATED = ("actuator", "measure", "event")
for room in ("sensors", "actuators", "memory", "measures", "events", "world", "functions", "learners"):
    import_module(f"mindrun.{room}")


def matched() -> set[str]:
    """The names of all classes that the tables of the simulated world tell apart by `match`."""
    nodes = [node for path in modules(RUNTIME / "sim") for node in ast.walk(tree(path))]
    return {ast.unparse(node.cls).rpartition(".")[2] for node in nodes if isinstance(node, ast.MatchClass)}


@pytest.mark.parametrize(
    ("noun", "name"),
    [(noun, name) for noun in SIMULATED for name in kinds(noun)],
)
def test_every_kind_is_simulated(noun: str, name: str) -> None:
    assert kinds(noun)[name].__name__ in matched()


@pytest.mark.parametrize("name", kinds("sensor"))
def test_every_sensor_has_a_lane_function(name: str) -> None:
    assert kinds("sensor")[name].lane is not SensorKind.lane


@pytest.mark.parametrize("noun", NOUNS)
def test_every_kind_says_what_it_is(noun: str) -> None:
    assert kinds(noun)
    assert [name for name, cls in kinds(noun).items() if str(cls.__doc__).startswith(f"{cls.__name__}(")] == []
