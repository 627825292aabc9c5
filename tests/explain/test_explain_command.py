"""`mindc explain`, as people and programs call it."""

import json
import subprocess
import sys
from pathlib import Path
from zipfile import ZipFile

import pytest

from mindlang.explaining.explanation import explanations
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
    for explanation in explanations().values():
        assert f"  {explanation.code} " in said.out
        assert f"  {explanation.title}\n" in said.out
    assert said.out.index("Errors: Names\n") < said.out.index("\nLint rules\n")


def test_json_is_one_document(mindc: Call) -> None:
    one = json.loads(mindc("explain", "comma", "--json").out)
    assert one["code"] == "comma"
    assert one["wrong"]
    assert one["right"]
    everything = json.loads(mindc("explain", "--json").out)
    assert one in everything["codes"]
    assert [each["code"] for each in everything["codes"]] == list(explanations())


def test_a_code_that_is_none_is_answered_by_one_that_is(mindc: Call) -> None:
    assert mindc("explain", "coma") == (2, "", "There is no code called coma.\n  Did you mean comma?\n")
    hint = "mindc explain lists them; those of a robot.yaml are in docs/robot-yaml.md."
    assert mindc("explain", "xyzzy").err == f"There is no code called xyzzy.\n  {hint}\n"


def test_the_explanations_are_in_the_wheel(tmp_path: Path) -> None:
    build = [sys.executable, "-m", "hatchling", "build", "-t", "wheel", "-d", str(tmp_path)]
    done = subprocess.run(build, cwd=ROOT, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    with ZipFile(next(tmp_path.glob("*.whl"))) as wheel:
        assert "mindlang/explaining/errors.md" in wheel.namelist()
