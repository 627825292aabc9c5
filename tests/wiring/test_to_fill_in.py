"""A robot.yaml made from a mind: all that is wrong with it is what is to be filled in."""

from pathlib import Path

import pytest
from mindrun.kinds.registry import kinds

from mindlang.compiler.compile import load
from mindlang.compiler.source import Source
from mindlang.robot.options import drivers
from mindlang.robot.to_fill_in import ACTUATORS, SENSORS, robot_yaml
from mindlang.robot.wire import check_wiring
from tests.calling import Call
from tests.project.sources import ROOT

MINDS = ["ball/ball", "braitenberg", "collect/ball", "collect/power", "lander/lander", "light/light", "soccer/soccer"]


@pytest.mark.parametrize("name", MINDS)
def test_nothing_is_missing_but_what_is_to_be_filled_in(name: str) -> None:
    _, graph = load(ROOT / "examples" / f"{name}.mind").whole
    text, count = robot_yaml(graph, "a: b\n# c")
    found = check_wiring(Source("robot.yaml", text, Path()), graph).diagnostics
    assert [each.code for each in found] == ["no-value"] * count


def test_the_usual_drivers_are_there() -> None:
    for noun, usual in (("sensor", SENSORS), ("actuator", ACTUATORS)):
        assert usual.keys() <= kinds(noun).keys()
        assert {driver for driver, *_ in usual.values()} <= drivers(noun).keys()


def test_what_was_filled_in_is_not_lost(mindc: Call, tmp_path: Path) -> None:
    mind, wiring = ROOT / "examples" / "light" / "light.mind", tmp_path / "robot.yaml"
    assert mindc("robot", mind, "-o", wiring).code == 0
    text = wiring.read_text(encoding="utf-8")
    assert mindc("robot", mind).out == text
    again = mindc("robot", mind, "-o", wiring)
    assert (again.code, wiring.read_text(encoding="utf-8")) == (2, text)
    assert "nothing is overwritten" in again.err
