"""`mindc check` of .break files: against the mind that is given, or the one of the same name beside them."""

import json
from pathlib import Path

import pytest

from tests.calling import Call

WIRED = (("sensors", "ball_bearing", "feeler"), ("actuators", "left_wheel", "right_wheel"))


@pytest.fixture
def breaks(rules: Path) -> Path:
    return rules.with_suffix(".break")


def test_it_is_held_against_the_mind_of_its_name(mindc: Call, breaks: Path) -> None:
    breaks.write_text("stop when feeler < 1\nstop on 2 reach of ball\nstop on fault of feeler\n")
    said = mindc("check", breaks)
    assert said.code == 1
    assert f"{breaks}:1:11: error: feeler has 3 readings" in said.err
    assert said.err.endswith("1 mistake\n")
    breaks.write_text("stop when ball_bearing < 1\nstop on 2 reach of ball\nstop on fault of feeler\nstop on stopped\n")
    assert mindc("check", breaks) == (0, "", "nothing wrong\n")


def test_it_is_held_against_the_mind_that_is_given(mindc: Call, rules: Path, breaks: Path) -> None:
    other = breaks.with_name("other.break")
    other.write_text("stop when bal_bearing < 1\n")
    said = mindc("check", other)
    assert (said.code, said.out) == (0, "")
    assert f"note: {other} is read without a mind" in said.err
    data = json.loads(mindc("check", other, rules, "--json").out)
    assert data["files"] == [{"file": str(rules), "ok": True}, {"file": str(other), "ok": False}]
    assert [each["code"] for each in data["diagnostics"]] == ["unknown-reading"]
    second = rules.with_name("second.mind")
    second.write_text(rules.read_text().replace("ball_bearing", "bal_bearing"))
    assert f"note: {other} is read without a mind" in mindc("check", other, rules, second).err
    breaks.write_text("stop when ball_bearing < 1\n")
    assert mindc("check", breaks, rules, second) == (0, "", "nothing wrong\n")


def test_it_is_about_a_task(mindc: Call, breaks: Path) -> None:
    breaks.write_text("stop in tick 1199\n")
    assert mindc("check", breaks, "--task", "Chase").code == 0
    said = mindc("check", breaks, "--task", "Roam")
    assert said.code == 1
    assert "[out-of-range]" in said.err
    said = mindc("check", breaks, "--task", "Chaes")
    assert said.code == 2
    assert "Did you mean Chase?" in said.err


def test_a_task_is_for_breakpoints_alone(mindc: Call, rules: Path) -> None:
    said = mindc("check", rules, "--task", "Chase")
    assert said.code == 2
    assert "--task and --master are for files of breakpoints" in said.err


def test_without_a_mind_that_compiles_its_lines_are_read(mindc: Call, rules: Path, breaks: Path) -> None:
    rules.write_text(rules.read_text().replace("drives", "drive", 1))
    breaks.write_text("stop when nothing_known < 1\nstop at collision\n")
    said = mindc("check", breaks)
    assert said.code == 1
    assert "without a mind that compiles" in said.err
    assert "[missing-on]" in said.err
    assert "nothing_known" not in said.err


def test_what_cannot_be_read(mindc: Call, breaks: Path) -> None:
    assert mindc("check", breaks).code == 2


def test_with_a_bundle_it_is_held_against_what_its_robot_records(mindc: Call, rules: Path, breaks: Path) -> None:
    bundle = rules.with_suffix(".bundle")
    assert mindc("build", rules, "-o", bundle).code == 0
    breaks.write_text("stop on stopped\nstop on fault of feeler\nstop when Turn influences left_wheel above 1%\n")
    assert mindc("check", breaks, bundle) == (0, "", "nothing wrong\n")
    said = mindc("check", breaks, bundle, "--master", "Chase")
    assert (said.code, said.err.count("[skill-not-in-run]")) == (1, 1)
    breaks.write_text("stop on reach of ball\nstop on visit of patch size 4\n")
    said = mindc("check", breaks, bundle)
    assert (said.code, said.err.count("[impossible-event]")) == (1, 2)
    said = mindc("check", breaks, bundle, "--task", "Roam")
    assert (said.code, said.err.count("[unnoticed-event]")) == (1, 1)
    assert f"{breaks}:2:9: error: Task Roam did not notice this event." in said.err
    assert mindc("check", breaks, bundle, "--master", "Chas").code == 2
    assert mindc("check", breaks, bundle.with_name("none.bundle")).code == 2


def test_of_a_robot_that_is_wired_there_are_the_sensors_that_are(mindc: Call, rules: Path, breaks: Path) -> None:
    text = rules.read_text().replace("at 0 30 330 deg", "at 30 deg\nsensor gap is range_finder at 0 deg")
    rules.write_text(text)
    bundle, wiring = rules.with_suffix(".bundle"), rules.with_name("robot.yaml")
    devices = ("{}:\n  {}: {{driver: mock}}\n  {}: {{driver: mock}}\n".format(*names) for names in WIRED)
    wiring.write_text("robot: Robot\n" + "".join(devices))
    assert mindc("build", rules, "--robot", wiring, "-o", bundle).code == 0
    breaks.write_text("stop on fault of gap\n")
    said = mindc("check", breaks, bundle)
    assert (said.code, said.err.count("Wired are ball_bearing and feeler.")) == (1, 1)
    assert mindc("check", breaks, bundle, "--task", "Roam") == (0, "", "nothing wrong\n")
    breaks.write_text("stop when gap < 0.5\n")
    assert "[unmeasured-reading]" in mindc("check", breaks, bundle).err
