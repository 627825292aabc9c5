"""`mindc build`, from the source and its lock to a bundle that runs."""

import json
from functools import partial
from pathlib import Path

import numpy as np
import pytest
from mindrun.engine.engine import Engine
from mindrun.graph.bundle import read_bundle
from mindrun.graph.weights import genes

from mindlang.compiler.compile import load
from mindlang.lock import Taught, read_lock
from mindlang.lock.blobs import FOLDER, record
from mindlang.lock.signature import arrange
from tests.calling import Call
from tests.lint.minds import WORLD

SOURCE = """tick 1/60 s
master Top
body Robot is disc

actuator left_wheel is wheel side left neutral 0.5
actuator claw is gripper neutral 0

sensor battery is battery
sensor pulse is sine period 2 s

skill Top is mlp hidden 1
  reads battery
  influences Go
  influences Grip at 1

skill Go is mlp hidden 2
  reads battery
  reads pulse
  drives left_wheel

skill Grip is procedure from claw.grip
  reads battery
  drives claw
"""
TAUGHT = Taught("Go", "Go", False, 10, 20, 1, 1.5)


@pytest.fixture
def source(tmp_path: Path) -> Path:
    """A mind with a procedure, whose skills have all been taught."""
    path = tmp_path / "small.mind"
    path.write_text(SOURCE)
    (tmp_path / "claw.py").write_text("def grip(battery):\n    return battery / 2\n")
    compiled = load(path).graph
    assert compiled
    graph = arrange(compiled, {})
    rng = np.random.default_rng(1)
    for skill in graph.skills:
        if genes(skill):
            weights = rng.standard_normal(genes(skill)).astype(np.float32)
            record(path.with_suffix(".lock"), graph, {skill.name: weights}, TAUGHT, {}, WORLD)
    return path


@pytest.fixture
def build(mindc: Call) -> Call:
    """Mindc build in this process."""
    return partial(mindc, "build")


def test_a_bundle_is_built_and_runs(build: Call, source: Path) -> None:
    out = source.with_suffix(".bundle")
    said = build(source, "-o", out, "--json")
    assert said.code == 0, said.err
    assert json.loads(said.out)["skills"] == ["Go", "Top"]
    bundle = read_bundle(out)
    assert Engine(bundle.policy, bundle.procedures).tick([1.0, 0.0])[1] == 0.5
    first = out.read_bytes()
    build(source, "-o", out)
    assert out.read_bytes() == first


def test_moving_lines_changes_no_byte_of_the_weights(build: Call, source: Path) -> None:
    moved = SOURCE.replace("  reads battery\n  reads pulse\n", "  reads pulse  # first\n  reads battery\n")
    build(source, "-o", source.with_suffix(".bundle"))
    source.write_text(moved)
    assert build(source, "-o", source.with_name("moved.bundle")).code == 0
    first, second = read_bundle(source.with_suffix(".bundle")), read_bundle(source.with_name("moved.bundle"))
    assert first.graph == second.graph
    assert first.policy.weights["Go"].tobytes() == second.policy.weights["Go"].tobytes()


def test_stale_weights_are_refused_with_the_difference(build: Call, source: Path) -> None:
    source.write_text(SOURCE.replace("  reads pulse\n", ""))
    said = build(source, "-o", source.with_suffix(".bundle"))
    assert said.code == 1
    assert said.err.splitlines() == [
        "the weights of Go are stale: reads pulse is gone",
        f"  mindc train {source} Go",
    ]
    assert not source.with_suffix(".bundle").exists()


def test_only_what_the_master_reaches_is_needed(build: Call, source: Path) -> None:
    source.write_text(SOURCE.replace("mlp hidden 1", "mlp hidden 3"))
    assert build(source, "-o", source.with_suffix(".bundle")).code == 1
    assert build(source, "-o", source.with_suffix(".bundle"), "--master", "Go").code == 0
    assert read_bundle(source.with_suffix(".bundle")).graph.master == "Go"


def _cut_lock(source: Path) -> None:
    source.with_suffix(".lock").write_text("damaged")


def _flip_weights(source: Path) -> None:
    entry = read_lock(source.with_suffix(".lock"))["Go"]
    blob = source.parent / FOLDER / f"{entry.weights}.npy"
    blob.write_bytes(blob.read_bytes()[:-1] + b"!")


@pytest.mark.parametrize("damage", [_cut_lock, _flip_weights])
def test_what_is_damaged_is_unreadable_input(build: Call, source: Path, damage) -> None:
    damage(source)
    out = source.with_suffix(".bundle")
    out.write_text("old")
    said = build(source, "-o", out)
    assert said.code == 2
    assert len(said.err.splitlines()) == 1
    assert out.read_text() == "old"


def test_a_procedure_that_is_gone_is_told_where_it_stands(build: Call, source: Path) -> None:
    (source.parent / "claw.py").unlink()
    out = source.with_suffix(".bundle")
    out.write_text("old")
    said = build(source, "-o", out)
    assert said.code == 1
    assert "[faulty-procedure]" in said.err
    assert "skill Grip is procedure from claw.grip" in said.err
    assert out.read_text() == "old"


def test_wrong_usage(build: Call, source: Path) -> None:
    out = source.with_suffix(".bundle")
    said = build(source, "-o", out, "--master", "Goo")
    assert (said.code, said.err) == (2, "There is no skill Goo.\n  Did you mean Go?\n")
    assert build(source).code == 2
    assert build(source.with_name("no.mind"), "-o", out).code == 2
    said = build(source, "-o", source.parent / "no" / "a.bundle")
    assert (said.code, "Traceback" in said.err) == (1, False)
    assert said.err.endswith(f"cannot be written: there is no folder {source.parent / 'no'}\n")


def test_building_runs_no_procedure(build: Call, source: Path) -> None:
    (source.parent / "claw.py").write_text("def grip(battery):\n    return 0.5\n\nraise SystemExit('it ran')\n")
    assert build(source, "-o", source.with_suffix(".bundle")).code == 0
