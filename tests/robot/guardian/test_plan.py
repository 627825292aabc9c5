"""What the guardian is told about its robot, and what it does not believe."""

import json
import subprocess
from collections.abc import Iterator
from math import inf, nextafter
from pathlib import Path
from typing import Any

import pytest
from mindrun.errors import MindError
from mindrun.graph.bundle import Bundle, write_bundle
from mindrun.graph.policy import Policy
from mindrun.graph.wiring import ActuatorWire, Wiring
from mindrun.kinds.registry import arguments, kinds
from mindrun.numbers.quantity import Reference
from mindrun.robot.drivers.mock import MockActuator
from mindrun.robot.drivers.own import KIND as OWN_KIND
from mindrun.robot.drivers.pca9685 import Pca9685
from mindrun.robot.drivers.simulated import SimulatedActuator
from mindrun.robot.guardian.client import PROGRAM
from mindrun.robot.guardian.plan import Channel, Plan, from_json, plan_of, read_plan, to_json

from tests.minds import always, mind, rule

PLAN = Plan(0.05, (Channel("wheel", 0.5, MockActuator(), -0.1, 0.2, 0.9, 3.0, True), Channel("é", 0, MockActuator())))

FAR = (Channel("claw", 0.5, Pca9685(3, 500.5)), Channel("far", 0.5, SimulatedActuator("s", "a")))
WIDE = Plan(0.05, from_json(to_json(PLAN)).channels + FAR)


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
    with pytest.raises(MindError, match="trim"):
        from_json(changed(("channels", 0, "trim"), 1.5 * trim))


def test_a_plan_is_a_wiring_with_the_neutrals_of_the_mind() -> None:
    wire = ActuatorWire("wheel", MockActuator(), trim=-0.1, low=0.2, high=0.9, slew=3.0, reversed=True)
    assert plan_of(0.05, {"wheel": 0.5, "other": 1}, Wiring("r", (), (wire,))).channels == PLAN.channels[:1]


def test_a_bundle_with_a_wiring_holds_a_plan(tmp_path: Path) -> None:
    graph = mind(rule("Go", always("actuator", 0, 0.9)))
    wheels = (ActuatorWire("left_wheel", MockActuator()), ActuatorWire("right_wheel", MockActuator(), reversed=True))
    write_bundle(tmp_path / "a.bundle", Bundle(Policy(graph, {}), {}, Wiring("rover", (), wheels)))
    plan = read_plan(tmp_path / "a.bundle")
    assert (plan.tick, [each.neutral for each in plan.channels]) == (graph.tick, [0.5, 0.5])
    assert [each.reversed for each in plan.channels] == [False, True]
    assert subprocess.run([*PROGRAM, "--neutral", tmp_path / "a.bundle"]).returncode == 0
    write_bundle(tmp_path / "b.bundle", Bundle(Policy(graph, {}), {}))
    with pytest.raises(MindError, match="for no robot"):
        read_plan(tmp_path / "b.bundle")


@pytest.mark.parametrize("name", sorted(kinds("actuator driver").keys() - {OWN_KIND}))  # tests/wiring/test_own_drivers
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
        (("channels", 0, "driver", "is"), ["mock"]),
        (("channels", 0, "driver", "more"), 1),
    ],
)
def test_what_no_robot_has_is_refused(path: tuple[str | int, ...], value: Any) -> None:
    with pytest.raises(MindError):
        from_json(changed(path, value))


ANYTHING: tuple[Any, ...] = (None, False, True, 0, 1, 0.5, 1.0, "", "x", [], [[]], {}, {"is": "mock"})


def places(tree: Any) -> Iterator[tuple[Any, Any]]:
    """Every place of a JSON tree: what holds it, and its key there."""
    for key in list(tree) if isinstance(tree, dict) else range(len(tree)) if isinstance(tree, list) else ():
        yield tree, key
        yield from places(tree[key])


def test_what_is_of_another_type_or_has_another_name_is_refused_anywhere() -> None:
    tree = json.loads(to_json(WIDE))
    for holder, key in list(places(tree)):
        was = holder[key]
        for value in ANYTHING:
            holder[key] = value
            if type(value) is not type(was) and not (type(was) is float and type(value) is int):
                with pytest.raises(MindError):
                    from_json(json.dumps(tree))
        holder[key] = was
        if isinstance(holder, dict):
            holder[f"{key}_"] = holder.pop(key)
            with pytest.raises(MindError):
                from_json(json.dumps(tree))
            holder[key] = holder.pop(f"{key}_")
    assert from_json(json.dumps(tree)) == WIDE


BOUNDS = {"neutral": (0, 1), "trim": (-1, 1), "low": (0, 0.9), "high": (0.2, 1), "slew": (0, 1e300), "least": (0, 1)}


@pytest.mark.parametrize("name", BOUNDS)
def test_numbers_keep_to_their_bounds(name: str) -> None:
    for bound, direction in zip(BOUNDS[name], (-inf, inf), strict=True):
        assert getattr(from_json(changed(("channels", 0, name), bound)).channels[0], name) == bound
        assert type(getattr(from_json(changed(("channels", 0, name), bound)).channels[0], name)) is float
        if abs(bound) < 1e300:
            with pytest.raises(MindError):
                from_json(changed(("channels", 0, name), nextafter(bound, direction)))


@pytest.mark.parametrize(("tick", "fine"), [(1e-6, True), (1e9, True), (9e-7, False), (1000000001, False)])
def test_a_tick_lasts_for_some_time(tick: float, fine: bool) -> None:
    if fine:
        assert from_json(changed(("tick",), tick)).tick == tick
    else:
        with pytest.raises(MindError, match=r"plan\.tick cannot be"):
            from_json(changed(("tick",), tick))


def test_a_whole_number_that_no_float_holds_is_none() -> None:
    assert from_json(changed(("channels", 0, "slew"), 2**53 - 1)).channels[0].slew == 2**53 - 1
    with pytest.raises(MindError, match="slew is no number that can be"):
        from_json(changed(("channels", 0, "slew"), 2**53))


def test_as_many_actuators_as_a_frame_has_room_for() -> None:
    with pytest.raises(MindError) as caught:
        Plan(0.05, PLAN.channels[:1] * 1001)
    assert str(caught.value) == "a robot has 1 to 1000 actuators, not 1001"
    assert len(Plan(0.05, PLAN.channels[:1] * 1000).channels) == 1000
    with pytest.raises(MindError, match="not 0"):
        plan_of(0.05, {}, Wiring("r", (), ()))


def test_limits_may_meet_but_not_cross() -> None:
    assert Plan(0.05, (Channel("wheel", 0.5, MockActuator(), low=0.5, high=0.5),))
    with pytest.raises(MindError) as caught:
        Plan(0.05, (*PLAN.channels, Channel("claw", 0.5, MockActuator(), low=0.75, high=0.25)))
    assert str(caught.value) == "claw: `low` 0.75 is above `high` 0.25"


@pytest.mark.parametrize("text", ["", "{", "[]", "null", "[" * 100_000, '{"tick": Infinity}', b"\xff\xfe\x00"])
def test_what_is_no_plan_is_refused(text: str | bytes) -> None:
    with pytest.raises(MindError):
        from_json(text)


def test_files_that_hold_none_are_refused(tmp_path: Path) -> None:
    (tmp_path / "a.bundle").write_bytes(b"PK, but no bundle")
    for name in ("a.bundle", "nothing"):
        with pytest.raises(MindError):
            read_plan(tmp_path / name)
