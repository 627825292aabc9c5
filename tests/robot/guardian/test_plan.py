"""What the guardian is told about its robot, and what it does not believe."""

import json
import subprocess
from pathlib import Path
from typing import Any

import pytest
from mindrun.bundle import write_bundle
from mindrun.errors import MindError
from mindrun.quantity import Reference
from mindrun.registry import arguments, kinds
from mindrun.robot.drivers.mock import MockActuator
from mindrun.robot.guardian.client import PROGRAM
from mindrun.robot.guardian.plan import Channel, Plan, PlanError, from_json, plan_of, read_plan, to_json
from mindrun.robot.wiring import ActuatorWire, Wiring

from tests.minds import always, mind, rule

PLAN = Plan(0.05, (Channel("wheel", 0.5, MockActuator(), -0.1, 0.2, 0.9, 3.0, True), Channel("é", 0, MockActuator())))


def changed(path: tuple[str | int, ...], value: Any) -> str:
    """The plan as text, with another value at a place."""
    data = json.loads(to_json(PLAN))
    part = data
    for step in path[:-1]:
        part = part[step]
    part[path[-1]] = value
    return json.dumps(data)


def test_a_plan_comes_back(tmp_path: Path) -> None:
    assert from_json(to_json(PLAN)) == PLAN
    assert "\n" not in to_json(PLAN)
    (tmp_path / "plan.json").write_text(to_json(PLAN))
    assert read_plan(tmp_path / "plan.json") == PLAN


@pytest.mark.parametrize("trim", [-1.0, 1.0])
def test_a_trim_is_a_share_of_the_travel_either_way(trim: float) -> None:
    assert from_json(changed(("channels", 0, "trim"), trim)).channels[0].trim == trim
    with pytest.raises(PlanError, match="trim"):
        from_json(changed(("channels", 0, "trim"), 1.5 * trim))


def test_a_plan_is_a_wiring_with_the_neutrals_of_the_mind() -> None:
    wire = ActuatorWire("wheel", MockActuator(), trim=-0.1, low=0.2, high=0.9, slew=3.0, reversed=True)
    assert plan_of(0.05, {"wheel": 0.5, "other": 1}, Wiring("r", (), (wire,))).channels == PLAN.channels[:1]


def test_a_bundle_with_a_wiring_holds_a_plan(tmp_path: Path) -> None:
    graph = mind(rule("Go", always("actuator", 0, 0.9)))
    wheels = (ActuatorWire("left_wheel", MockActuator()), ActuatorWire("right_wheel", MockActuator(), reversed=True))
    write_bundle(tmp_path / "a.bundle", graph, {}, {}, Wiring("rover", (), wheels))
    plan = read_plan(tmp_path / "a.bundle")
    assert (plan.tick, [each.neutral for each in plan.channels]) == (graph.tick, [0.5, 0.5])
    assert [each.reversed for each in plan.channels] == [False, True]
    assert subprocess.run([*PROGRAM, "--neutral", tmp_path / "a.bundle"]).returncode == 0
    write_bundle(tmp_path / "b.bundle", graph, {}, {})
    with pytest.raises(PlanError, match="for no robot"):
        read_plan(tmp_path / "b.bundle")


@pytest.mark.parametrize("name", sorted(kinds("actuator driver")))
def test_every_actuator_driver_can_be_in_a_plan(name: str) -> None:
    cls = kinds("actuator driver")[name]
    needed = {each.field: each.type for each in arguments(cls) if each.required}
    driver = cls(**{f: "x" if isinstance(t, Reference) else int(t.low) for f, t in needed.items()})
    plan = Plan(0.05, (Channel("any", 0.5, driver),))
    assert from_json(to_json(plan)) == plan


@pytest.mark.parametrize(
    ("path", "value"),
    [
        (("tick",), 0),
        (("tick",), None),
        (("tick",), "0.05"),
        (("more",), 1),
        (("channels",), []),
        (("channels",), {}),
        (("channels", 0), 7),
        (("channels", 0, "neutral"), 1.01),
        (("channels", 0, "neutral"), True),
        (("channels", 0, "trim"), float("nan")),
        (("channels", 0, "low"), 0.95),
        (("channels", 0, "slew"), -1),
        (("channels", 0, "reversed"), 1),
        (("channels", 0, "actuator"), 1),
        (("channels", 0, "driver"), "mock"),
        (("channels", 0, "driver", "is"), "none"),
        (("channels", 0, "driver", "in"), "../os"),
        (("channels", 0, "driver", "is"), ["mock"]),
        (("channels", 0, "driver", "more"), 1),
    ],
)
def test_what_no_robot_has_is_refused(path: tuple[str | int, ...], value: Any) -> None:
    with pytest.raises(PlanError):
        from_json(changed(path, value))


@pytest.mark.parametrize("text", ["", "{", "[]", "null", "[" * 100_000, '{"tick": Infinity}', b"\xff\xfe\x00"])
def test_what_is_no_plan_is_refused(text: str | bytes) -> None:
    with pytest.raises(PlanError):
        from_json(text)


def test_files_that_hold_none_are_refused(tmp_path: Path) -> None:
    (tmp_path / "a.bundle").write_bytes(b"PK, but no bundle")
    for name in ("a.bundle", "nothing"):
        with pytest.raises(MindError):
            read_plan(tmp_path / name)
