"""`mindc explain`, as people and programs call it."""

import json
import subprocess
import sys
from pathlib import Path
from zipfile import ZipFile

import pytest

from mindlang.explaining.collection import codes
from tests.calling import Call, caller
from tests.project.sources import ROOT


@pytest.fixture
def mindc(capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> Call:
    return caller(capsys, monkeypatch)


def test_a_code_is_explained_with_its_examples(mindc: Call) -> None:
    said = mindc("explain", "influence-cycle")
    assert said.code == 0
    assert said.out.startswith("influence-cycle (error)\nSkills influence one another in a circle.\n")
    assert "\nWrong:\n  skill Go is rule\n" in said.out
    assert "\nRight:\n  skill Go is rule\n" in said.out
    assert "\x1b" not in said.out
    assert max(map(len, said.out.splitlines())) <= 80


def test_a_lint_rule_is_explained_by_itself(mindc: Call) -> None:
    assert mindc("explain", "unread-sensor").out.startswith("unread-sensor (lint rule)\nA sensor that nobody reads.\n")


def test_a_code_may_be_copied_with_its_brackets(mindc: Call) -> None:
    assert mindc("explain", "[comma]").out == mindc("explain", "comma").out


def test_alone_it_lists_all_codes_with_their_sentences(mindc: Call) -> None:
    said = mindc("explain")
    assert said.code == 0
    for article in codes().values():
        assert f"  {article.name} " in said.out
        assert f"  {article.summary}\n" in said.out
    assert said.out.index("Errors: Names\n") < said.out.index("\nLint rules\n")


def test_a_kind_is_explained_with_its_arguments_and_what_its_commands_mean(mindc: Call) -> None:
    said = mindc("explain", "wheel")
    assert said.code == 0
    assert said.out.startswith("wheel (kind of actuator)\nWhat drives one side of the robot.\n")
    for line in (
        "  0.5   stopped",
        "  side          on which side of the robot it is: left or right (required)",
        "  thrust        the force at the command 1: a force (default: 80)",
    ):
        assert f"\n{line}\n" in said.out
    assert said.out.endswith("Example:\n  actuator left_wheel is wheel side left neutral 0.5 thrust 80\n")


def test_drivers_words_and_commands_are_explained_too(mindc: Call) -> None:
    assert mindc("explain", "ultrasonic").out.startswith("ultrasonic (driver of sensors)\n")
    assert "  trigger       a list, each a GPIO number" in mindc("explain", "ultrasonic").out
    assert mindc("explain", "per", "tick").out.startswith("per tick (word)\n")
    assert "Its kinds: disc" not in mindc("explain", "sensor").out
    assert "Its kinds: average, battery" in mindc("explain", "sensor").out
    assert mindc("explain", "train").out.startswith("train (command)\nTeach the skills")
    assert mindc("explain", "edit rename").out.startswith("edit rename (command)\n")


def test_a_name_of_several_things_is_explained_for_each_and_a_noun_chooses(mindc: Call) -> None:
    both = mindc("explain", "box").out
    assert both.startswith("box (kind of body)\n")
    assert "\n\nbox (kind of thing)\n" in both
    assert mindc("explain", "thing", "box").out == both[both.index("box (kind of thing)") :]
    assert mindc("explain", "thing box").out == mindc("explain", "thing", "box").out
    assert mindc("explain", "driver", "bumper").out.startswith("bumper (driver of sensors)\n")
    assert mindc("explain", "task", "arena").out == mindc("explain", "scene arena").out


def test_json_is_one_document(mindc: Call) -> None:
    (one,) = json.loads(mindc("explain", "comma", "--json").out)["articles"]
    assert one["name"] == "comma"
    assert one["wrong"]
    assert one["right"]
    everything = json.loads(mindc("explain", "--json").out)["articles"]
    assert one in everything
    assert [each["name"] for each in everything] == list(codes())
    assert [each["noun"] for each in json.loads(mindc("explain", "box", "--json").out)["articles"]] == ["body", "thing"]
    (wheel,) = json.loads(mindc("explain", "wheel", "--json").out)["articles"]
    assert wheel["scale"] == {"0": "full reverse", "0.5": "stopped", "1": "full forward"}
    assert wheel["arguments"][0] == {
        "key": "side",
        "for": "on which side of the robot it is",
        "takes": "left or right",
        "default": None,
    }


def test_a_name_of_nothing_is_answered_by_one_that_is_near(mindc: Call) -> None:
    assert mindc("explain", "coma") == (2, "", "There is nothing called coma.\n  Did you mean comma?\n")
    assert mindc("explain", "weel").err == "There is nothing called weel.\n  Did you mean wheel?\n"
    hint = "mindc kinds lists the kinds and drivers, mindc explain the codes."
    assert mindc("explain", "xyzzy").err == f"There is nothing called xyzzy.\n  {hint}\n"
    said = mindc("explain", "decay")
    assert said.code == 2
    assert said.err.endswith("  It is an argument of memory cell: mindc explain cell says what it takes.\n")


def test_kinds_are_listed_by_noun(mindc: Call) -> None:
    everything = mindc("kinds")
    assert everything.code == 0
    for line in ("Actuators", "  wheel               What drives one side of the robot.", "Drivers for sensors"):
        assert f"{line}\n" in everything.out
    sensors = mindc("kinds", "sensor").out
    assert sensors.startswith("Sensors\n  average       The mean of a sensor over some ticks.\n")
    assert "Actuators" not in sensors
    assert mindc("kinds", "task").out == mindc("kinds", "scene").out
    said = json.loads(mindc("kinds", "memory", "--json").out)["kinds"]
    assert [(each["noun"], each["name"]) for each in said] == [
        ("memory", each) for each in ("cell", "counter", "place", "register")
    ]


def test_a_noun_without_kinds_is_refused_with_those_that_have_some(mindc: Call) -> None:
    assert mindc("kinds", "senor") == (2, "", "There are no kinds of senor.\n  Did you mean sensor?\n")
    said = mindc("kinds", "xyzzy")
    assert said.code == 2
    assert "Write body, actuator, sensor, memory" in said.err


def test_the_explanations_are_in_the_wheel(tmp_path: Path) -> None:
    build = [sys.executable, "-m", "hatchling", "build", "-t", "wheel", "-d", str(tmp_path)]
    done = subprocess.run(build, cwd=ROOT, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    with ZipFile(next(tmp_path.glob("*.whl"))) as wheel:
        texts = {f"mindlang/explaining/{name}.md" for name in ("arguments", "kinds", "drivers", "words")}
        texts.add("mindlang/compiler/errors.md")
        assert texts <= set(wheel.namelist())
