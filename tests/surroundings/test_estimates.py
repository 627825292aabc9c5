"""What would take more memory than there is is refused before it begins; the estimate is near the truth."""

import tracemalloc
from pathlib import Path

import numpy as np
import pytest
from mindrun.graph.graph import Graph
from mindrun.graph.policy import Policy
from mindrun.sim.rollout import Rollout
from mindrun.sim.state import empty_state

from mindlang import limits
from mindlang.compiler.compile import load
from mindlang.limits import bytes_for, bytes_of
from mindlang.run import setup, tables
from mindlang.run.setup import layouts, run_all
from mindlang.run.tables import csv_parts, runs_table
from tests.calling import Call

RUNS = 5_000
MIND = """
tick 1/60 s
master Go
body Robot is disc size 2
actuator left_wheel is wheel side left neutral 0.5{delay}
sensor eyes is range_finder at {angles} deg
skill Go is mlp hidden {hidden}
  reads eyes
  drives left_wheel
task Roam in arena size {arena}
  contains rock is obstacle count {count}
  lasts 60 s
  counts visit of patch size {patch}
  rewards 1 on visit of patch size {patch}
curriculum School is genetic population 20
  teaches Go on Roam for 5 generations
"""
SMALL = {"delay": "", "angles": "0", "hidden": 1, "arena": 50, "count": 10, "patch": 4}
LARGE = (
    {},
    {"delay": " delay 900 ticks"},
    {"angles": " ".join(map(str, range(300)))},
    {"hidden": "3 width 200"},
    {"count": 1000},
    {"patch": 0.1},
    {"count": "10\n  contains crate is box count 20"},
)


def graph_of(folder: Path, **said: object) -> Graph:
    path = folder / "m.mind"
    path.write_text(MIND.format(**SMALL | said))
    graph = load(path).graph
    assert graph
    return graph


def test_the_estimate_is_near_what_the_lanes_take(tmp_path: Path) -> None:
    for said in LARGE:
        rollout = Rollout(Policy(graph_of(tmp_path, **said), {}), "Roam", "Go", ["Go"], lanes=64)
        state = empty_state(rollout.tables, rollout.sizes, 64)
        parts = [part for name, part in vars(state).items() if name != "senses"]  # which has arrays of the others
        taken = sum(array.nbytes for part in parts for array in vars(part).values())
        genomes = limits.GENOME_COPIES * 64 * 4 * rollout.genome_length
        assert 0.8 * taken < bytes_of(rollout, 64, 1) - genomes < 2 * taken + 2**20, said


def test_the_estimate_is_near_what_many_runs_take(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(setup, "SLICE_RUNS", 100)
    monkeypatch.setattr(tables, "SLICE_ROWS", 100)
    graph_of(tmp_path)
    path, line = tmp_path / "m.mind", "  rewards 1 on visit of patch size 4\n"
    path.write_text(path.read_text().replace("lasts 60 s", "lasts 2 ticks").replace(line, line * 9))
    graph = load(path).graph
    assert graph
    first = Rollout(Policy(graph, {}), "Roam", "Go", ["Go"])
    rollout = Rollout(Policy(graph, {"Go": np.zeros(first.genome_length, np.float32)}), "Roam", "Go")
    _, few, many = (most_bytes(rollout, runs) for runs in (RUNS, RUNS, 2 * RUNS))  # what comes once comes first
    taken = (many - few) / RUNS
    assert 0.9 * taken < bytes_for(graph.tasks[0]) < 2 * taken


def most_bytes(rollout: Rollout, runs: int) -> int:
    """What is taken at most while the results of so many runs become a table."""
    tracemalloc.start()
    try:
        seeds = layouts(1, runs)
        scores = run_all(rollout, seeds)
        tracemalloc.reset_peak()
        parts = csv_parts(runs_table(rollout.task, scores, seeds))
        assert sum(map(len, parts)) > runs
        return tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()


@pytest.mark.parametrize(
    ("said", "what"),
    [
        ({"angles": " ".join(map(str, np.arange(0, 300, 0.06)))}, "the weights"),
        ({"patch": 0.1, "arena": 100_000}, "the patches to visit"),
    ],
    ids=["angles", "patches"],
)
def test_a_lesson_that_fits_no_memory_is_refused(
    mindc: Call, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, said: dict[str, object], what: str
) -> None:
    monkeypatch.setattr(limits, "available", lambda: 1 << 30)
    graph_of(tmp_path, **said)
    ended = mindc("train", tmp_path / "m.mind", "--runs", tmp_path / "runs", "--seed", 1)
    assert ended.code == 1
    assert "Roam takes about" in ended.err
    assert what in ended.err


def test_what_would_take_years_is_refused(mindc: Call, tmp_path: Path) -> None:
    graph_of(tmp_path)
    path, runs = tmp_path / "m.mind", tmp_path / "runs"
    path.write_text(path.read_text().replace("lasts 60 s", "lasts 10000000 ticks"))
    ended = mindc("train", path, "--runs", runs, "--seed", 1, "--generations", 10_000_000, "--population", 10_000)
    assert ended.code == 1
    assert "years and more" in ended.err
    assert "A run lasts up to 10,000,000 ticks." in ended.err


@pytest.mark.parametrize(
    ("line", "code"),
    [
        ("\n".join(f"  contains rock{i} is obstacle count 1000" for i in range(3)), "too-many-obstacles"),
        ("\n".join(f"  contains ball{i} is item" for i in range(101)), "too-many-things"),
    ],
)
def test_a_world_takes_so_much(mindc: Call, tmp_path: Path, line: str, code: str) -> None:
    graph_of(tmp_path)
    path = tmp_path / "m.mind"
    path.write_text(path.read_text().replace("  lasts 60 s", f"{line}\n  lasts 60 s"))
    assert f"[{code}]" in mindc("check", path).err


def test_a_mind_takes_so_many_readings(mindc: Call, tmp_path: Path) -> None:
    path = tmp_path / "m.mind"
    path.write_text(MIND.format(**SMALL | {"angles": " ".join(["0.5"] * 20_001)}))
    assert "[too-many-readings]" in mindc("check", path).err
