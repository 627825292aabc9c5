"""`mindc build --robot`: mind and wiring are checked against each other here, not on the robot."""

import json
from pathlib import Path

import pytest
from mindrun.graph.bundle import fingerprint, read_bundle
from mindrun.graph.describe import describe

from tests.calling import Call

ROBOT = """robot: desk
sensors:
  ball_bearing:
    driver: mock
  feeler:
    driver: mock
    count: 3
actuators:
  left_wheel:
    driver: mock
    slew: 2 /s
  right_wheel:
    driver: mock
"""


@pytest.fixture
def robot(tmp_path: Path) -> Path:
    """The wiring of the small mind."""
    path = tmp_path / "robot.yaml"
    path.write_text(ROBOT, encoding="utf-8")
    return path


def test_the_wiring_is_in_the_bundle(mindc: Call, rules: Path, robot: Path, tmp_path: Path) -> None:
    said = mindc("build", rules, "--robot", robot, "-o", tmp_path / "a.bundle", "--json")
    assert said.code == 0, said.err
    bundle = read_bundle(tmp_path / "a.bundle")
    assert bundle.wiring
    assert json.loads(said.out)["robot"] == {"name": "desk", "wiring": fingerprint(bundle.wiring)}
    assert [wire.sensor for wire in bundle.wiring.sensors] == ["ball_bearing", "feeler"]
    assert [wire.rest for wire in bundle.wiring.sensors] == [0.5, 0.0]
    assert [wire.dead_zone for wire in bundle.wiring.sensors] == [0.0, 0.005]
    assert "actuator left_wheel is wired to mock: 0 to 1, at most 2 a second" in describe(bundle)


def test_the_same_wiring_in_other_words_is_the_same_bundle(
    mindc: Call, rules: Path, robot: Path, tmp_path: Path
) -> None:
    mindc("build", rules, "--robot", robot, "-o", tmp_path / "a.bundle")
    robot.write_text(ROBOT.replace("2 /s", "2.0 /s # slowly").replace("robot: desk", 'robot: "desk"'))
    said = mindc("build", rules, "--robot", robot, "-o", tmp_path / "b.bundle")
    assert said.err.endswith("Roam in charge, 0 trained skills, wired to desk\n")
    assert (tmp_path / "a.bundle").read_bytes() == (tmp_path / "b.bundle").read_bytes()


def test_a_mistake_ends_with_1_and_writes_nothing(mindc: Call, rules: Path, robot: Path, tmp_path: Path) -> None:
    robot.write_text(ROBOT.replace("count: 3", "count: 2"), encoding="utf-8")
    said = mindc("build", rules, "--robot", robot, "-o", tmp_path / "a.bundle")
    assert (said.code, said.out) == (1, "")
    assert "The mind's feeler has 3 readings, and this driver 2. [wrong-width]" in said.err
    assert f"{robot}:6:13: error" in said.err
    assert not (tmp_path / "a.bundle").exists()


def test_only_what_the_master_reads_has_to_be_wired(mindc: Call, rules: Path, robot: Path, tmp_path: Path) -> None:
    robot.write_text(ROBOT.replace("  ball_bearing:\n    driver: mock\n", ""), encoding="utf-8")
    assert "reads ball_bearing" in mindc("build", rules, "--robot", robot, "-o", tmp_path / "a.bundle").err
    said = mindc("build", rules, "--robot", robot, "-o", tmp_path / "a.bundle", "--master", "Turn")
    assert said.code == 0, said.err


@pytest.mark.parametrize(
    ("content", "why"),
    [
        (None, "No such file"),
        (b"a: \0", "is a binary file"),
        (b"\xff", "is not UTF-8"),
        (b"#" * 300_000, "larger than 256 kB"),
    ],
)
def test_what_cannot_be_read_ends_with_2(
    mindc: Call, rules: Path, tmp_path: Path, content: bytes | None, why: str
) -> None:
    path = tmp_path / "robot.yaml"
    if content is not None:
        path.write_bytes(content)
    said = mindc("build", rules, "--robot", path, "-o", tmp_path / "a.bundle")
    assert said.code == 2
    assert why in said.err
    assert mindc("build", rules, "--robot", tmp_path, "-o", tmp_path / "a.bundle").code == 2
