"""Weights from elsewhere are tried in the environment in which their skill is taught."""

import json
from pathlib import Path

import pytest

import mindlang
from mindlang.weights.network import genome_in, network_of, read_bytes
from tests.calling import Call
from tests.outside import minds

SCHOOL = "curriculum School is genetic population 4 layouts 1\n  teaches Go on Go for 1 generations\n"


def test_what_is_imported_scores_what_its_runs_score(
    mindc: Call, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    minds.register()
    Path("go.mind").write_text(minds.text() + SCHOOL, encoding="utf-8")
    mindlang.load("go.mind").train(seed=1)
    assert mindc("weights", "export", "go.mind", "Go", "go.safetensors").code == 0
    said = mindc("weights", "import", "go.mind", "Go", "go.safetensors", "--json")
    assert said.code == 0, said.err
    found = json.loads(said.out)
    graph = mindlang.load("go.mind").graph
    genome = genome_in(Path("go.safetensors"), read_bytes(Path("go.safetensors")), network_of(graph, "Go"))
    rollout = mindlang.load("go.mind").rollout("Go", learners=["Go"])
    assert found["ticks"] == rollout.score(genome[None], [1]).ticks[0, 0]
    assert found["score"] != 0
