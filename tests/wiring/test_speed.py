"""What cannot be as fast as its wiring asks is built, and told."""

from pathlib import Path
from types import SimpleNamespace

import pytest
from hypothesis import given
from hypothesis import strategies as st
from mindrun.graph.graph import Graph

from mindlang.cli._diagnostic_printer import plain
from mindlang.compiler.compile import load
from mindlang.compiler.diagnostic import Diagnostic, Findings
from mindlang.compiler.source import Source, Span
from mindlang.robot.claims import check_shared
from mindlang.robot.driver_inspection import Timing
from mindlang.robot.wire import Checked, check_wiring

MIND = """\
mind 1
tick {tick} s
unit 1 m
master Go
body Robot is disc
actuator left is wheel side left neutral 0.5
actuator right is wheel side right neutral 0.5
sensor eye is {kind}
skill Go is rule
  reads eye
  drives left at eye
  drives right at eye
task Go in arena size 20
  contains ball is item size 2
  lasts 10 ticks
"""
WIRING = """\
robot: any
sensors:
  eye:
    driver: {sensor}
actuators:
  left:
    driver: {actuator}: 1
  right:
    driver: {actuator}: 2
"""
SPEED, NEAR = "odometer side left range 1", "range_finder at 0 deg range {range}"
MOCK, BOARD, CARD = "mock, device", "grove_motor, motor", "pca9685, channel"


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("speed")


def checked(folder: Path, kind: str, sensor: str, actuator: str = CARD, tick: str = "1/20") -> Checked:
    return wired(folder, MIND.format(kind=kind, tick=tick), WIRING.format(sensor=sensor, actuator=actuator))


def wired(folder: Path, mind: str, wiring: str) -> Checked:
    """The wiring of a mind; a comma in it begins another line of options."""
    (folder / "any.mind").write_text(mind)
    graph = load(folder / "any.mind").graph
    assert isinstance(graph, Graph)
    return check_wiring(Source("robot.yaml", wiring.replace(", ", "\n    "), folder), graph, 1.0)


def codes(found: Checked) -> list[str]:
    """Those of the warnings of a wiring that is taken."""
    assert found.wiring, [plain(diagnostic) for diagnostic in found.diagnostics]
    return [diagnostic.code for diagnostic in found.diagnostics]


def spoken(of: Diagnostic) -> str:
    """The part of a wiring that a diagnostic is about."""
    assert of.span
    return of.span.text


@given(st.integers(1, 2000), st.just(0) | st.integers(5, 100), st.integers(-40, 40), st.integers(-40, 40))
def test_an_encoder_counts_a_thousand_steps_a_second(
    folder: Path, steps: int, centimetres: int, low: int, high: int
) -> None:
    if low == high:
        return
    ends = f"steps: {steps}, circumference: {centimetres} cm, from: {low / 10} m/s, to: {high / 10} m/s"
    found = checked(folder, SPEED, f"encoder, a: 5, b: 6, {ends}")
    asked = steps * max(abs(low), abs(high)) * 10
    if asked != 1000 * centimetres:  # just as many are rounded
        assert codes(found) == ["too-fast"] * (asked > 1000 * centimetres)


@given(st.integers(1, 100), st.integers(1, 60))
def test_an_echo_takes_as_long_as_sound(folder: Path, metres: int, rate: int) -> None:
    pins = f"trigger: 5, echo: 6, range: {metres / 10} m, to: {metres / 10} m, rate: {rate} Hz, max_age: 60 s"
    found = checked(folder, NEAR.format(range=100), f"ultrasonic, {pins}")
    assert codes(found) == ["too-often"] * (rate * 2 * metres / 10 > 343.2)


@pytest.mark.parametrize(
    ("kind", "sensor", "most"),
    [
        (NEAR.format(range=1), "vl53l0x", 30),
        (NEAR.format(range=1), "grove_ultrasonic, ports: 4", 25),
        ("battery", "ads1115", 125),
        ("turn_rate", "mpu6050", 100),
        ("compass", "lsm9ds1_compass", 80),
        ("bearing of ball", "ball_tracker", 30),
        ("eye of ball at 0 deg range 1", "ball_eye, angles: 0 deg", 30),
        (SPEED, "encoder, a: 5, b: 6, steps: 20", 50),
    ],
)
def test_a_chip_measures_as_often_as_it_can(folder: Path, kind: str, sensor: str, most: int) -> None:
    assert codes(checked(folder, kind, f"{sensor}, rate: {most} Hz")) == []
    assert codes(checked(folder, kind, f"{sensor}, rate: {most + 1} Hz")) == ["too-often"]


@pytest.mark.parametrize(
    ("actuator", "tick", "said"),
    [
        (BOARD, "1/100", []),
        (BOARD, "1/200", ["too-often"]),  # of 4 ms each
        (CARD, "1/300", []),
        (CARD, "1/500", ["busy-bus"]),
    ],
)
def test_a_tick_is_as_long_as_its_commands(folder: Path, actuator: str, tick: str, said: list[str]) -> None:
    assert codes(checked(folder, "battery", "mock", actuator, tick)) == said


def test_sensors_and_actuators_share_a_bus(folder: Path) -> None:
    assert codes(checked(folder, "turn_rate", "mpu6050, rate: 100 Hz", CARD, "1/300")) == []
    assert codes(checked(folder, "turn_rate", "mpu6050, rate: 100 Hz", CARD, "1/390")) == ["busy-bus"]
    assert codes(checked(folder, "turn_rate", "mpu6050, rate: 100 Hz, bus: 3", CARD, "1/390")) == []


def test_the_words(folder: Path) -> None:
    found = checked(folder, SPEED, "encoder, a: 5, b: 6, steps: 360, rate: 60 Hz")
    assert [(one.severity, one.message, one.hint) for one in found.diagnostics] == [
        (
            "warning",
            "It is to read up to 1 m/s, and measures 0.555 m/s at most: faster reads as slower.",
            "Write from: -0.555 m/s and to: 0.555 m/s, and never go faster; or wire one with fewer steps.",
        ),
        (
            "warning",
            "One measurement takes 20 ms here, and 60 a second are asked for.",
            "Write rate: 50 Hz, or less, and a max_age of two measurements at least.",
        ),
    ]


def told(found: Checked) -> list[tuple[str, str, str]]:
    """The words of each, and what they are about."""
    return [(one.message, one.hint, spoken(one)) for one in found.diagnostics]


def test_the_words_of_a_board_and_of_a_bus(folder: Path) -> None:
    assert told(checked(folder, "battery", "mock", BOARD, "1/200")) == [
        (
            "In each second left and right need 1.6 s of /dev/i2c-1 0x0f, which does one thing at a time.",
            "Let the mind tick more slowly or wire some to another board.",
            "grove_motor",
        )
    ]
    assert told(checked(folder, "turn_rate", "mpu6050, rate: 100 Hz", CARD, "1/500")) == [
        (
            "In each second eye, left and right need 1.38 s of I2C bus 1 at its usual 100 kHz.",
            "Measure less often (rate), let the mind tick more slowly or wire some to another bus.",
            "pca9685",
        )
    ]


def test_the_inputs_of_a_converter_are_measured_one_after_the_other(folder: Path) -> None:
    mind = MIND.format(kind="battery\nsensor ear is battery", tick="1/20").replace(
        "reads eye", "reads eye\n  reads ear"
    )

    def two(rate: int, address: str = "0x48") -> Checked:
        ear = f"ear:\n    driver: ads1115, channel: 1, rate: 70 Hz, address: {address}"
        return wired(folder, mind, WIRING.format(sensor=f"ads1115, rate: {rate} Hz\n  {ear}", actuator=CARD))

    assert codes(two(55)) == codes(two(60, "0x49")) == []
    assert told(two(60)) == [
        (
            "In each second eye and ear need 1.04 s of /dev/i2c-1 0x48, which does one thing at a time.",
            "Measure less often (rate) or wire some to another board.",
            "ads1115",
        )
    ]


def test_an_actuator_on_no_board_waits_for_nothing_else() -> None:
    span, findings = Span(Source("a", "x", Path()), 0, 1), Findings()

    def waiting(seconds: float) -> list[str]:
        two = [
            SimpleNamespace(
                name=SimpleNamespace(text=name), noun="actuator", timing=Timing(seconds), span=lambda *_: span
            )
            for name in ("left", "right")
        ]
        check_shared((), [(each, None) for each in two], 0.005, findings)  # type: ignore[misc]
        return [one.message for one in findings.diagnostics]

    assert waiting(0.004) == []
    assert waiting(0.006) == ["In each second left needs 1.2 s.", "In each second right needs 1.2 s."]
