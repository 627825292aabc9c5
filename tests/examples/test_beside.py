"""Minds beside one perceptron: as many weights, as many steps, and nothing is done twice."""

import json
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

from mindlang import load
from tests.examples.test_environments import EXAMPLES, Example
from tests.language.examples import ROOT

COMPARED = [example for example in EXAMPLES if (example.path.parent / "beside.toml").exists()]
LANDER = ROOT / "examples" / "lander"


def teach(out: Path) -> str:
    options = ("--seeds", "1", "--runs", "2", "--processes", "1", "--scale", "0.01", "--out", str(out))
    command = [sys.executable, str(ROOT / "examples" / "beside.py"), str(LANDER), *options]
    return subprocess.run(command, capture_output=True, text=True, check=True, cwd=ROOT, env={**os.environ}).stdout


def outcome(path: Path) -> dict[str, Any]:
    found: dict[str, Any] = json.loads(path.read_text(encoding="utf-8"))
    return found


@pytest.mark.parametrize("example", COMPARED, ids=lambda example: example.name)
def test_the_perceptron_has_as_many_weights_as_the_hierarchy(example: Example) -> None:
    pytest.importorskip("gymnasium")
    pytest.importorskip(example.package)
    mind, alone = load(example.path), load(example.path.parent / "monolith.mind")
    learners = {lesson.skill for lesson in mind.graph.lessons}
    hierarchy = mind.rollout(example.task, mind.graph.master, sorted(learners))
    pilots = {lesson.skill for lesson in alone.graph.lessons if lesson.master == alone.graph.master}
    perceptron = alone.rollout(example.task, alone.graph.master, sorted(pilots))
    assert hierarchy.genome_length == perceptron.genome_length


@pytest.mark.slow
def test_a_seed_is_taught_once_and_the_perceptron_has_its_steps(tmp_path: Path) -> None:
    pytest.importorskip("gymnasium")
    pytest.importorskip("Box2D")
    said = teach(tmp_path)
    hierarchy, perceptron = outcome(tmp_path / "hierarchy-1.json"), outcome(tmp_path / "mlp-1.json")
    assert {*perceptron["steps"]} == {*hierarchy["steps"]} == {"restarting", "evolution_strategy"}
    for learner, steps in perceptron["steps"].items():
        assert steps >= hierarchy["steps"][learner]
    (tmp_path / "mlp-1.json").unlink()
    again = teach(tmp_path)
    assert len(again.splitlines()) == 1 < len(said.splitlines())  # the perceptron alone
    assert outcome(tmp_path / "mlp-1.json")["mean"] == perceptron["mean"]
    assert "| hierarchy | 1 |" in (tmp_path / "RESULTS.md").read_text(encoding="utf-8")
