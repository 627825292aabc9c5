"""A sensor that reads the other way round is built, and told."""

from pathlib import Path

import pytest
from mindrun.graph.graph import Graph

from mindlang.cli._diagnostic_printer import plain
from mindlang.compiler.compile import load
from mindlang.compiler.source import Source
from mindlang.robot.wire import Checked, check_wiring

MIND = """\
tick 1/30 s
master Go
body Robot is disc
actuator wheel is wheel side left neutral 0.5
sensor eye is {kind}
skill Go is rule
  reads eye
  drives wheel at eye
task Go in arena size 20
  contains ball is item size 2
  lasts 10 ticks
"""
WIRING = """\
robot: any
sensors:
  eye:
    driver: {driver}
actuators:
  wheel:
    driver: mock
"""
SONAR = "ultrasonic, trigger: 5, echo: 6"
EYE = "range_finder at 0 deg"
CONTACT = "contact of ball"
FAR, TOUCHED = "The farther, the more metres.", "Touched, it is 1."
NEARER = "to: 0 m, from: 1 m"


def checked(tmp_path: Path, kind: str, driver: str) -> Checked:
    (tmp_path / "any.mind").write_text(MIND.format(kind=kind))
    graph = load(tmp_path / "any.mind").graph
    assert isinstance(graph, Graph)
    return check_wiring(Source("robot.yaml", WIRING.format(driver=driver.replace(", ", "\n    ")), tmp_path), graph)


@pytest.mark.parametrize(
    ("kind", "driver", "hint"),
    [
        (EYE, "switch, pin: 5", f"{TOUCHED} Write from: 1 and to: 0."),
        (EYE, "switch, pin: 5, from: 0, to: 1", f"{TOUCHED} Write from: 1 and to: 0."),
        (EYE, f"{SONAR}, from: 0.6 m, to: 0 m", f"{FAR} Write from: 0 m and to: 0.6 m."),
        (EYE, f"{SONAR}, from: 2 m", f"{FAR} Write from: 1 m and to: 2 m."),
        (EYE, f"grove_ultrasonic, ports: 4, {NEARER}", f"{FAR} Write from: 0 m and to: 1 m."),
        (EYE, f"ball_tracker, measure: distance, {NEARER}", f"{FAR} Write from: 0 m and to: 1 m."),
        (CONTACT, SONAR, f"{FAR} Write from: 1 m and to: 0 m."),
        ("eye of ball at 0 deg", f"ball_eye, angles: 0 deg, {NEARER}", f"{FAR} Write from: 0 m and to: 1 m."),
        ("distance of ball", f"vl53l0x, {NEARER}", f"{FAR} Write from: 0 m and to: 1 m."),
        ("bumper at 0 deg", "bumper, pins: 5, from: 1, to: 0", f"{TOUCHED} Write from: 0 and to: 1."),
        ("held of ball", "switch, pin: 5, from: 1, to: 0", f"{TOUCHED} Write from: 0 and to: 1."),
    ],
)  # fmt: skip
def test_it_is_a_warning_that_says_what_to_write(tmp_path: Path, kind: str, driver: str, hint: str) -> None:
    found = checked(tmp_path, kind, driver)
    assert found.wiring
    (warning,) = found.diagnostics
    assert (warning.severity, warning.code, warning.hint) == ("warning", "reads-backwards", hint)
    assert plain(warning).startswith("robot.yaml:")
    assert f" {kind.split()[0]} reads " in warning.message


@pytest.mark.parametrize(
    ("kind", "driver"),
    [
        (EYE, "switch, pin: 5, from: 1, to: 0"),
        (EYE, SONAR),
        (EYE, f"{SONAR}, from: 3 cm, to: 60 cm"),
        (EYE, "mock"),
        (EYE, "ads1115, from: 3 V, to: 0.4 V"),
        (CONTACT, "switch, pin: 5"),
        (CONTACT, f"{SONAR}, from: 10 cm, to: 0 cm"),
        ("battery", "ads1115"),
        ("eye of ball at 0 deg", "ball_eye, angles: 0 deg"),
        ("distance of ball", "vl53l0x"),
        ("bumper at 0 deg", "bumper, pins: 5"),
        ("light of ball", "mcp3008, inputs: 0, from: 0.9, to: 0.1"),
        ("floor of ball", "line_sensor, pins: 5, inverted: true"),
        ("odometer side left", "encoder, a: 5, b: 6, steps: 20"),
        ("turn_rate", "mpu6050"),
    ],
)
def test_what_reads_forwards_or_may_is_no_matter(tmp_path: Path, kind: str, driver: str) -> None:
    found = checked(tmp_path, kind, driver)
    assert found.wiring
    assert found.diagnostics == ()


@pytest.mark.parametrize("written", ["5", "[5]"])
def test_a_single_number_is_a_list_of_one(tmp_path: Path, written: str) -> None:
    wiring = checked(tmp_path, EYE, f"ultrasonic, trigger: {written}, echo: 6").wiring
    assert wiring
    assert wiring.sensors[0].driver.trigger == (5,)  # type: ignore[attr-defined]
