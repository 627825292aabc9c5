"""The lines that `mindrun calibrate` prints can stand in robot.yaml; and a motor turns slowly, until it is seen."""

import os
import signal
from dataclasses import replace
from pathlib import Path

import pytest
from mindrun.cli.calibrate import least_lines, lines, reading_statistics
from mindrun.errors import MindError
from mindrun.graph.wiring import SensorWire
from mindrun.kinds.actuators.actuator import Motor, Steering, Thruster, Wheel
from mindrun.kinds.sensors.compass import Compass
from mindrun.kinds.sensors.motion import Inertial, Odometer, Speed
from mindrun.kinds.sensors.nearest import Distance
from mindrun.robot import least_command
from mindrun.robot.least_command import STEP_SHARE, Witness, least_shares, measured_least
from mindrun.robot.sensing import Sample

from tests.robot.devices import devices
from tests.robot.driving import NAME, mindrun, program
from tests.robot.faults import Scripted, graph


def samples(*values: float | None) -> list[Sample]:
    return [Sample((value,), float(number)) for number, value in enumerate(values)]


def wire() -> SensorWire:
    return SensorWire("sense", Scripted(1, []), 0.0, 2.0)


def test_a_range_that_was_seen_is_proposed_without_exponents() -> None:
    said = lines(wire(), samples(0.00002, *[0.5] * 20, 1.25), Inertial())
    assert said[2:5] == ["sense:", "  from: 0.00002", "  to: 1.25"]
    assert said[-1] == "# for the .mind file: noise 0.0% dead_zone 0.0% lost 0%"


def test_the_scale_of_training_stays() -> None:
    said = lines(wire(), samples(0.2, 0.4), Distance("ball"))
    assert not any("from:" in line for line in said)
    assert "# from and to are those of training (0 to 2), and no matter of what was seen" in said


def test_what_does_not_change_is_told() -> None:
    assert "# it has not changed: move what it measures" in lines(wire(), samples(1.0, 1.0), Inertial())


def test_noise_is_the_spread_at_rest_and_losses_are_counted() -> None:
    seen = reading_statistics([0.0, 1.0, *[0.5, 0.52] * 10, None, None])
    assert seen
    assert (seen.low, seen.high) == (0.0, 1.0)
    assert abs(seen.noise - 0.01) < 1e-9
    assert abs(seen.lost - 2 / 24) < 1e-9
    assert reading_statistics([None]) is None


@pytest.mark.parametrize("turned", [0.0, 90.0, 179.0, 180.0, -180.0])
def test_a_direction_trembles_as_much_wherever_it_points(turned: float) -> None:
    """A compass that faces away from north says 179 and −179 degrees in turn."""
    seen = samples(*((turned + off + 180) % 360 - 180 for off in [-1.0, 1.0] * 10))
    said = lines(SensorWire("sense", Scripted(1, []), 180.0, -180.0), seen, Compass())
    assert said[1].endswith("noise 1, lost 0%")
    assert said[-1] == "# for the .mind file: noise 0.6% dead_zone 0.8% lost 0%"


# How much of a command a motor needs

TICK = 0.25
NEUTRALS = {"left_wheel": 0.5, "right_wheel": 0.5, "claw": 0.0}


class StickyMotor:
    """A motor that turns from a share of its command on, which each way has its own, and its encoder."""

    def __init__(self, forward: float, backward: float, noise: float = 0.0) -> None:
        self.forward, self.backward, self.noise = forward, backward, noise
        self.commands = [0.5]

    def send(self, command: float) -> None:
        self.commands.append(command)

    @property
    def turns(self) -> bool:
        share = 2 * self.commands[-1] - 1
        return share >= self.forward - 1e-9 or -share >= self.backward - 1e-9

    def encoder(self) -> Sample:
        trembles = self.noise * (len(self.commands) % 3 - 1)
        return Sample((trembles + self.turns * (2 * self.commands[-1] - 1),), float(len(self.commands)))


def test_a_motor_is_raised_both_ways_until_somebody_sees_it_move() -> None:
    motor, told = StickyMotor(0.12, 0.2), list[str]()
    found = least_shares(0.5, TICK, motor.send, Witness(lambda: motor.turns), told.append)
    assert found == pytest.approx({"forward": 0.12, "backward": 0.2})
    assert told[0], told[-1] == ("forward 1%", "backward 20%")
    steps = [abs(now - before) for before, now in zip(motor.commands, motor.commands[1:], strict=False)]
    assert all(step <= STEP_SHARE / 2 + 1e-9 or now == 0.5 for step, now in zip(steps, motor.commands[1:], strict=True))
    assert motor.commands[-1] == 0.5
    assert motor.commands.count(0.5) > 2 * 3 / TICK


@pytest.mark.parametrize("noise", [0.0, 0.02])
def test_an_encoder_sees_it_as_soon_as_it_is_not_as_at_rest(noise: float) -> None:
    motor = StickyMotor(0.12, 0.2, noise)
    found = least_shares(0.5, TICK, motor.send, Witness(None, motor.encoder), lambda _: None)
    assert found == pytest.approx({"forward": 0.13, "backward": 0.21}, abs=0.011)


def test_a_motor_that_nothing_moves_is_told_and_stays_slow() -> None:
    motor = StickyMotor(2, 2)
    with pytest.raises(MindError, match="nothing has moved forward up to 50% of a command"):
        least_shares(0.5, TICK, motor.send, Witness(None, motor.encoder), lambda _: None)
    assert max(motor.commands) == 0.75


def test_an_encoder_that_fails_ends_it() -> None:
    motor = StickyMotor(0.1, 0.1)
    broken = Witness(None, lambda: Sample((), 1.0, "does not answer"))
    with pytest.raises(MindError, match="would see it move does not answer"):
        least_shares(0.5, TICK, motor.send, broken, lambda _: None)
    assert {*motor.commands} == {0.5}


def test_the_larger_share_is_what_is_written() -> None:
    found = {"forward": 0.12, "backward": 0.2}
    said = least_lines("left", Wheel("left", 0.5), found)
    assert said[:3] == ["# left starts at 12% forward and 20% backward", "left:", "  least: 20%"]
    assert said[3].endswith("starts 20%")
    assert len(least_lines("left", Thruster(0.5), found)) == 3


def test_an_odometer_sees_its_wheel_and_a_speed_the_motor() -> None:
    left, right, motor = Wheel("left", 0.5), Wheel("right", 0.5), Motor(0.5)
    assert [Odometer("left").sees(each) for each in (left, right, motor)] == [True, False, False]
    assert [Speed().sees(each) for each in (left, motor, Steering(0.5))] == [False, True, False]
    assert not Compass().sees(motor)


@pytest.fixture
def quick(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(least_command, "REST_SECONDS", 0.1)
    monkeypatch.setattr(least_command, "STEP_SECONDS", 0.1)


@pytest.mark.usefixtures("quick")
def test_the_guardian_moves_the_motor_and_nothing_else(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    with devices(tmp_path, NEUTRALS) as found:

        def is_seen() -> bool:
            told = [each.value for each in [*found.told] if each.actuator == "left_wheel"]
            return abs(told[-1] - 0.5) > 0.015 - 1e-9

        monkeypatch.setattr(least_command, "_enter_pressed", is_seen)
        wiring = found.wiring(NAME)
        wires = (replace(wire, least=0.3) for wire in wiring.actuators)  # which is not there meanwhile
        slow = replace(graph("bearing"), tick=0.25)  # a busy machine is a tick late, not two
        shares = measured_least(slow, replace(wiring, actuators=tuple(wires)), "left_wheel", None, print)
        assert all(0.03 - 1e-9 <= share < 0.2 for share in shares.values())
        moved = [each for each in found.told if not each.neutral(NEUTRALS)]
        assert {each.actuator for each in moved} == {"left_wheel"}
        assert all(abs(each.value - 0.5) < 0.1 for each in moved)
        assert found.at_rest


@pytest.mark.usefixtures("quick")
def test_a_signal_ends_it_at_rest(tmp_path: Path) -> None:
    with devices(tmp_path, NEUTRALS) as found:
        eye = SensorWire("sense", Scripted(1, [[0.0]]), 0.0, 1.0)
        with pytest.raises(KeyboardInterrupt):
            measured_least(
                graph("bearing"), found.wiring(NAME), "left_wheel", eye, lambda _: os.kill(os.getpid(), signal.SIGINT)
            )
        assert found.at_rest


def test_nothing_moves_without_arm_and_only_what_drives(bundle: Path) -> None:
    said = mindrun("calibrate", bundle, "left_wheel")
    assert said.returncode == 2
    assert "wheels off the ground, then add --arm" in said.stderr
    said = mindrun("calibrate", bundle, "claw", "--arm")
    assert "no sensor or motor claw is wired" in said.stderr
    said = program("calibrate", bundle, "left_wheel", "--arm", stdin=-3)  # DEVNULL
    assert said.returncode == 2
    assert "nobody can say when it moves" in said.stderr
