"""Where a servo looks that nothing measures: as in the world, to the bit; at rest where it is; within its limits."""

from dataclasses import replace
from math import radians, tau
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from mindrun.cli.doctor import wired
from mindrun.engine.changes import ChangedEngine
from mindrun.graph.bundle import Bundle
from mindrun.graph.describe import describe
from mindrun.graph.graph import Graph
from mindrun.graph.policy import Policy
from mindrun.graph.wiring import ActuatorWire, Wiring, flaws, reckoned
from mindrun.robot.drivers.mock import MockActuator
from mindrun.robot.guardian.guard import meant, started
from mindrun.robot.guardian.plan import Channel, plan_of
from mindrun.robot.loop import Loop, Rate
from mindrun.robot.recording import read
from mindrun.robot.sensing import ReadingFilter
from mindrun.robot.servos import ReckonedServo, reckoned_servos
from mindrun.sim.commanded_lanes import CommandedWorld

from mindlang.robot.to_fill_in import robot_yaml
from tests.calling import Call
from tests.robot.driving import NAME, mindrun
from tests.robot.faults import Clock, Sent
from tests.sim.minds import compile_text

MIND = """\
tick 1/20 s
master Go
body Robot is disc
actuator left_wheel is wheel side left neutral 0.5
actuator pan is servo {says}
sensor pulse is sine period 0.7 s
sensor gaze is direction of pan
skill Go is rule
  reads pulse
  reads gaze
  drives pan at pulse * 1.3 - gaze * 0.2
task Look in arena size 40
  lasts 60 ticks
  rewards gaze per tick
"""
SAYS = "range 70 deg speed 213 deg per s neutral 0.38", "neutral 0.6 delay 3 ticks", "range 180 deg neutral 1"
SHARES = st.floats(0, 1, allow_subnormal=False)


def wiring_of(graph: Graph, **of_pan: float) -> Wiring:
    wires = (ActuatorWire(each.name, MockActuator()) for each in graph.actuators)
    return Wiring("any", (), tuple(replace(wire, **of_pan) if wire.actuator == "pan" else wire for wire in wires))


def servo_of(graph: Graph, **of_pan: float) -> ReckonedServo:
    plan = plan_of(graph.tick, {each.name: each.kind.neutral for each in graph.actuators}, wiring_of(graph, **of_pan))
    (servo,) = reckoned_servos(wiring_of(graph), graph, plan)
    return servo


def robot(graph: Graph, servo: ReckonedServo) -> Loop:
    clock = Clock()
    pace = Rate(graph.tick, clock, clock.sleep)
    loop = Loop(ChangedEngine(Policy(graph, {})), ReadingFilter(graph, [servo]), Sent(), pace, True, servos=[servo])
    pace.begin()
    return loop


@pytest.mark.parametrize("says", SAYS)
def test_a_robot_reckons_what_the_world_reads_to_the_bit(says: str) -> None:
    graph = compile_text(MIND.format(says=says))
    loop, world, engine = (
        robot(graph, servo_of(graph)),
        CommandedWorld(graph, "Look", 1),
        ChangedEngine(Policy(graph, {})),
    )
    seen = []
    for _ in range(50):
        loop.tick()
        readings = world.readings()
        commands = engine.tick(readings)
        assert loop.engine.readings.tobytes() == engine.readings.tobytes()
        assert loop.guardian.commands[-1].tobytes()  # type: ignore[attr-defined] == commands.tobytes()
        seen.append(float(loop.engine.readings[1]))
        world.step(commands)
    assert len(set(seen)) > 5


@pytest.mark.parametrize("why", ["unarmed", "held"])
def test_what_does_not_move_is_at_its_neutral(why: str) -> None:
    graph = compile_text(MIND.format(says="range 70 deg neutral 0.38"))
    loop = robot(graph, servo_of(graph))
    loop.tick()
    loop.armed, loop.guardian.holds = why != "unarmed", "pan failed" * (why == "held")  # type: ignore[misc]
    loop.tick()
    loop.tick()
    assert loop.engine.readings[1] == np.float32(0.5 - (1 - 2 * float(np.float32(0.38))) * radians(70) / tau)


def test_it_stays_within_limits_and_does_not_turn_faster_than_slew() -> None:
    graph = compile_text(MIND.format(says="neutral 0.5"))
    servo = servo_of(graph, low=0.2, high=0.75, slew=4.0)
    angles = []
    for _ in range(3):
        servo.turn(1.0)
        angles.append(np.degrees(-servo.angle))
    assert angles == pytest.approx([36, 45, 45], abs=1e-4)


@given(neutral=SHARES, trim=st.floats(-0.5, 0.5), least=st.floats(0, 0.99), command=SHARES)
def test_what_is_meant_is_what_was_commanded(neutral: float, trim: float, least: float, command: float) -> None:
    channel = Channel("pan", neutral, MockActuator(), trim=trim, least=least)
    value = started(channel, command)
    assert 0 <= meant(channel, value) <= 1
    room = {0.0: neutral + trim, 1.0: 1 - neutral - trim}[float(command > neutral)]
    if room > 1e-3:  # a trim may leave none
        assert meant(channel, value) == pytest.approx(command, abs=1e-6)


def test_no_line_of_robot_yaml_names_it() -> None:
    graph = compile_text(MIND.format(says="neutral 0.5"))
    assert not [*flaws(wiring_of(graph), graph)]
    assert reckoned(wiring_of(graph), graph) == {"gaze": "pan"}
    assert "# gaze is reckoned from what pan is sent" in robot_yaml(graph, "any")[0]
    assert "sensor gaze is reckoned from what pan is sent" in describe(Bundle(Policy(graph, {}), {}, wiring_of(graph)))
    assert {check.what: check.words for check in wired(wiring_of(graph), graph)}["gaze"].startswith("reckoned")


def test_a_build_and_a_robot_say_that_it_is_reckoned_and_a_replay_knows_it(
    mindc: Call, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("MIND_ROBOT", str(tmp_path / "identity"))
    mind, wires, bundle, day = (tmp_path / name for name in ("look.mind", "robot.yaml", "look.bundle", "day.rec"))
    mind.write_text(f"mind 1\n{MIND.format(says=SAYS[0])}", encoding="utf-8")
    mocks = "".join(f"  {name}:\n    driver: mock\n" for name in ("left_wheel", "pan"))
    wires.write_text(f"robot: {NAME}\nsensors:\nactuators:\n{mocks}", encoding="utf-8")
    said = mindc("build", mind, "--robot", wires, "-o", bundle)
    assert "note: gaze has no driver: it is reckoned from what pan is sent" in said.err
    assert mindrun("adopt", bundle).returncode == 0
    assert "gaze is reckoned from what pan is sent" in mindrun(bundle, "--arm", "--ticks", 12, "--record", day).stderr
    about, (rows,) = read(day)
    assert about.sensors == ("gaze",)
    assert len({*rows["readings"][:, 1].tolist()}) > 5
    assert mindrun("replay", day, bundle).returncode == 0
