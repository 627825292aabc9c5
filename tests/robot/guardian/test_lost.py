"""Devices that come loose while the robot drives, and are plugged in again."""

from dataclasses import dataclass, field
from threading import Event

from hypothesis import given, settings
from hypothesis import strategies as st
from mindrun.driver import DeviceError
from mindrun.robot.drivers.mock import MockActuator
from mindrun.robot.guardian.guard import FOLLOWING
from mindrun.robot.guardian.plan import Channel
from mindrun.robot.guardian.process import ActuatorOutput

from tests.draws import cases
from tests.robot.guardian.faked import TICK, Device, Faked, faked
from tests.robot.guardian.test_output import PATIENCE, REST, Gate, started, until_settled

WHEELS = [Channel(name, REST, MockActuator()) for name in ("left_wheel", "right_wheel")]


@dataclass(slots=True)
class Loose(Device):
    """Comes loose at a write, and is there again when it was not at so many openings; `log` is all that happened.

    Opened anew it takes so many `boots` writes until it works.
    """

    at: int = 0
    openings: int = 0
    boots: int = 0
    tries: int = 0
    is_loose: bool = False
    log: list[float | str] = field(default_factory=list)

    def open(self) -> Device:
        if self.is_loose and self.openings:
            self.openings -= 1
            raise DeviceError("nobody is there")
        self.is_loose = False
        self.log.append("open")
        return self

    def write(self, value: float) -> None:
        self.tries += 1
        self.is_loose |= self.tries == self.at
        if self.log.count("open") > 1 and not self.is_loose and self.boots:
            self.boots -= 1
            raise DeviceError("it boots")
        if self.is_loose:
            raise DeviceError("no answer")
        self.written.append(value)
        self.log.append(value)

    def close(self) -> None:
        self.log.append("close")


def drive(robot: Faked, ticks: int, tries: int) -> None:
    """Frames, in each tick one, and so many tries of each device."""
    for _ in range(ticks):
        robot.now[0] += TICK
        robot.frame(0.75, 0.75)
        for _ in range(tries - 1):
            robot.write()
        if robot.state != FOLLOWING:
            assert robot.devices[1].written[-1] == REST, "it has nothing to do with the other"


@settings(max_examples=cases(60))
@given(at=st.integers(2, 12), openings=st.integers(0, 12), boots=st.integers(0, 12), tries=st.integers(1, 3))
def test_what_comes_loose_is_opened_anew_and_begins_at_neutral(at: int, openings: int, boots: int, tries: int) -> None:
    loose = Loose(at=at, openings=openings, boots=boots)
    with faked(*WHEELS, devices=(loose, Device())) as robot:
        drive(robot, 20 + openings + boots, tries)
        assert (robot.state, robot.last) == (FOLLOWING, [0.75, 0.75])
        assert loose.log.count("open") == loose.log.count("close") + 1 == 2
        begun = [loose.log[place + 1] for place, what in enumerate(loose.log) if what == "open"]
        assert begun == [REST, REST]
        assert robot.process.guard.failures == 1
        said = [line for line in robot.said if "left_wheel" in line and not line.startswith("neutral")]
        assert said == [
            "all actuators to neutral, but left_wheel may still move: left_wheel failed: no answer",
            "left_wheel is fine again",
        ]


def test_what_stays_away_is_waited_for_and_holds_the_others_at_neutral() -> None:
    """However long: to latch would end the program, and nobody would be there when it is plugged in again."""
    with faked(*WHEELS, devices=(Loose(at=5, openings=10_000), Device())) as robot:
        drive(robot, 2_000, 1)
        assert robot.state == "neutral"
        assert robot.process.guard.why == "left_wheel failed: no answer"


def test_who_fails_while_nothing_is_armed_is_why_nothing_moves_later() -> None:
    with faked(*WHEELS, devices=(Loose(at=3, openings=50), Device())) as robot:
        robot.frame(0.75, 0.75)
        robot.frame(0.75, 0.75, armed=False)
        assert robot.process.guard.why == "not armed"
        robot.now[0] += TICK
        robot.frame(0.75, 0.75)
        assert robot.process.guard.why == "not every actuator has come to neutral"
        drive(robot, 5, 1)
        assert robot.process.guard.why.startswith("left_wheel failed: ")
        drive(robot, 60, 1)
        assert robot.state == FOLLOWING


def test_a_chip_that_is_opened_anew_may_have_reset_the_others_and_they_are_told_neutral_before() -> None:
    loose, other = Loose(at=3), Loose()
    with faked(*WHEELS, devices=(loose, other)) as robot:
        drive(robot, 3, 1)
        mine, others = robot.process.outputs
        while loose.log.count("open") == 1:
            robot.now[0] += TICK
            robot.process.step(None)
            others.attempt()
            was_settled = others.settled
            mine.attempt()
        assert (was_settled, others.settled) == (True, False)
        others.attempt()
        assert other.log[-1] == REST


def test_a_device_that_works_again_is_told_neutral_without_being_opened_anew() -> None:
    """To open one can take seconds, in which a wheel turns."""
    loose = Loose(at=3, openings=10)
    with faked(*WHEELS, devices=(loose, Device())) as robot:
        drive(robot, 4, 1)
        loose.is_loose = False
        drive(robot, 2, 1)
        assert loose.log.count("open") == 1


def test_who_refuses_neutral_for_less_than_two_ticks_is_not_opened_anew() -> None:
    loose = Loose()
    with faked(*WHEELS, devices=(loose, Device())) as robot:
        robot.frame(0.75, 0.75)
        loose.is_loose = True
        robot.frame(0.75, 0.75, armed=False)
        robot.wait(1.5 * TICK)
        assert loose.log == ["open", REST, 0.75]
        robot.wait(TICK)
        assert loose.log[3:] == ["close", "open", REST]


def test_who_is_lost_a_second_time_before_it_was_said_to_be_back_stops_all_the_same() -> None:
    with faked(*WHEELS) as robot:
        drive(robot, 2, 1)
        robot.devices[0].fails = True
        drive(robot, 3, 1)
        assert robot.state == FOLLOWING
        robot.process._lost.add("left_wheel")
        drive(robot, 1, 1)
        assert robot.process.guard.why == "left_wheel failed: no answer"


def test_what_is_opened_anew_and_works_no_better_is_opened_again() -> None:
    loose = Loose(at=3, boots=10_000)
    with faked(*WHEELS, devices=(loose, Device())) as robot:
        drive(robot, round(17.0 / TICK), 1)
        assert loose.log.count("open") == 1 + 4, "at once, and every five seconds"


def test_what_never_worked_is_not_opened_anew() -> None:
    """At the start it may take its time, in which to open it again would let it begin again."""
    loose = Loose(at=1)
    with faked(*WHEELS, devices=(loose, Device())) as robot:
        drive(robot, 1000, 1)
        assert loose.log == ["open"]


def test_an_opening_that_hangs_keeps_no_other_from_neutral() -> None:
    opening, free = Event(), Event()

    def hang() -> Device:
        opening.set()
        assert free.wait(PATIENCE)
        return Device()

    lost = ActuatorOutput("claw", REST, lambda: None, hang, -1.0)
    lost._is_new_until = -1.0
    lost.start(Device(fails=True))
    assert opening.wait(PATIENCE)
    device = Gate()
    with started(device) as output:
        output.rest()
        device.let()
        lost.rest()
        assert lost.hangs(1e9) == 0.0, "what is closed moves nothing by a write that hangs"
        free.set()
        until_settled(lost)
    lost.close(PATIENCE)
