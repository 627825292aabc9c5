"""The comparison of the lander with one perceptron: as many weights, as many steps, and nothing is done twice."""

import json
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

from mindlang import load
from tests.language.examples import ROOT

LANDER = ROOT / "examples" / "lander"

pytest.importorskip("gymnasium")
pytest.importorskip("Box2D")


def teach(out: Path) -> str:
    options = ("--seeds", "1", "--runs", "2", "--processes", "1", "--scale", "0.01", "--out", str(out))
    command = [sys.executable, str(LANDER / "teach.py"), *options]
    return subprocess.run(command, capture_output=True, text=True, check=True, cwd=ROOT, env={**os.environ}).stdout


def outcome(path: Path) -> dict[str, Any]:
    found: dict[str, Any] = json.loads(path.read_text(encoding="utf-8"))
    return found


def test_the_perceptron_has_as_many_weights_as_the_hierarchy() -> None:
    hierarchy = load(LANDER / "lander.mind").rollout("Land", "Land", ["Upright", "Brake", "Aim", "Land"])
    perceptron = load(LANDER / "monolith.mind").rollout("Land", "Pilot", ["Pilot"])
    assert hierarchy.genome_length == perceptron.genome_length


@pytest.mark.slow
def test_a_seed_is_taught_once_and_the_perceptron_has_its_steps(tmp_path: Path) -> None:
    said = teach(tmp_path)
    hierarchy, perceptron = outcome(tmp_path / "hierarchy-1.json"), outcome(tmp_path / "mlp-1.json")
    for mine, its in zip(perceptron["steps"], hierarchy["steps"], strict=True):
        assert mine >= its
    (tmp_path / "mlp-1.json").unlink()
    again = teach(tmp_path)
    assert len(again.splitlines()) == 1 < len(said.splitlines())  # the perceptron alone
    assert outcome(tmp_path / "mlp-1.json")["mean"] == perceptron["mean"]
    assert "| hierarchy | 1 |" in (tmp_path / "RESULTS.md").read_text(encoding="utf-8")
