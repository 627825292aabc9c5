"""A perceptron becomes a network that grows and does the same to the bit, and one that has grown is pruned."""

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from mindrun.files.npy import to_npy
from mindrun.kinds.functions.mlp import Mlp
from mindrun.kinds.functions.neat import Neat
from networkx import node_link_graph

from mindlang.compiler.compile import load
from mindlang.editing.project import EditError
from mindlang.lint.lint import lint
from mindlang.lock import lock_path, read_lock, write_lock
from mindlang.lock.blobs import blob, digest
from mindlang.lock.status import Trained
from tests.calling import Call
from tests.edits.taught import MIND, statuses, teach, write_mind
from tests.edits.test_weights import commands, made, some_readings
from tests.server.test_changes import everywhere
from tests.view.serving import simulated

ROWS = np.random.default_rng(1).random((30, 3)).astype(np.float32)


@given(st.integers(0, 3), st.sampled_from([0, 1, 4]), st.integers(0, 1), st.integers(0, 1), st.integers(0, 2**32 - 1))
def test_it_does_what_the_perceptron_did(hidden: int, width: int, bias: int, centred: int, seed: int) -> None:
    old = Mlp(hidden, width, bias, centred)
    new = Neat(hidden * old.neurons(3, 2), centred=centred)
    weights = np.random.default_rng(seed).normal(0, 3, old.genome_length(3, 2)).astype(np.float32)
    grown = new.recast(weights, (3, 2), old)
    assert grown is not None
    assert old.ready(3, 2, weights, {})(ROWS).tobytes() == new.ready(3, 2, grown, {})(ROWS).tobytes()
    assert int((grown != 0).sum()) == weights.size
    narrow = replace(new, most=new.most - 1) if new.most else replace(new, bias=-1)
    assert narrow.recast(weights, (3, 2), old) is None


@pytest.mark.parametrize("function", ["mlp hidden 1", "mlp hidden 2 width 5 bias 1", "mlp centred 1"])
def test_a_mind_does_the_same_after_it(tmp_path: Path, function: str) -> None:
    path = write_mind(tmp_path, MIND.replace("skill Go is mlp hidden 1", f"skill Go is {function}"))
    teach(path)
    before = commands(path, some_readings(path))
    sentences = made(path, "grow", skill="Go")
    assert sentences == ["Go keeps its weights, as a matrix of links", "3 trained skills keep what was learnt"]
    assert commands(path, some_readings(path)) == before
    states = [state for name, state in statuses(path).items() if name != "Grab"]
    assert all(isinstance(state, Trained) and not state.changes for state in states)


@pytest.mark.parametrize("links", ["forward", "any"])
def test_pruning_leaves_what_leads_to_an_output(tmp_path: Path, links: str) -> None:
    function = Neat(5, links)  # type: ignore[arg-type]
    path = write_mind(tmp_path, MIND.replace("skill Go is mlp hidden 1", f"skill Go is neat most 5 links {links}"))
    teach(path)
    found = np.random.default_rng(2).normal(0, 2, function.genome_length(1, 2)).astype(np.float32)
    function.network(found, 2).cells[:, [3, 5]] = 0  # nobody reads the second neuron and the fourth
    learnt(path, "Go", found)
    before = commands(path, some_readings(path))
    assert "prune" in {each.edit for each in everywhere(path, path.read_text())[1]}
    made(path, "prune", skill="Go")
    assert f"skill Go is neat most 3{' links any' * (links == 'any')}  #" in path.read_text()
    assert commands(path, some_readings(path)) == before
    with pytest.raises(EditError, match="From each neuron of Go a way leads to an output"):
        made(path, "prune", skill="Go")


def test_what_grew_is_shown(tmp_path: Path, mindc: Call) -> None:
    path = write_mind(tmp_path, MIND.replace("skill Go is mlp hidden 1", "skill Go is neat most 3 links any centred 1"))
    teach(path)
    cells = np.zeros((5, 5), np.float32)  # bias, ball_bearing, three neurons: what these read, and then both wheels
    cells[0, 0], cells[2, 1], cells[2, 4], cells[3, 1], cells[3, 4] = 7, -2, 0.5, 1.25, -4
    learnt(path, "Go", cells.ravel())
    lines = mindc("show", path, "Go").out.splitlines()
    assert lines == [
        "Go: 5 of 25 links",
        "├── left_wheel = 0.50 + 1.25 (ball_bearing - 1/2) - 4.00 (neuron 3 - 1/2)",
        "├── right_wheel = 0.50",
        "└── neuron 3 = σ(-2.00 (ball_bearing - 1/2) + 0.50 (neuron 3 - 1/2))",
    ]
    drawn = node_link_graph(json.loads(mindc("show", path, "Go", "--json").out), edges="links")
    assert dict(drawn.nodes(data="role")) == {
        "left_wheel": "output", "right_wheel": "output", "ball_bearing": "reading", "neuron 3": "neuron",
    }  # fmt: skip
    assert (
        '"neuron 3" -> "left_wheel" [label="-4.00" penwidth=5.0 style=dashed]' in mindc("show", path, "Go", "--dot").out
    )
    assert "Avoid is mlp: only a neat has links that grew" in mindc("show", path, "Avoid").err
    [paged] = simulated(path, "Roam").about["links"]
    assert {(*(paged["nodes"][end]["name"] for end in ends), weight) for *ends, weight in paged["links"]} == {
        (source, to, weight) for source, to, weight in drawn.edges(data="weight")
    }


def test_what_no_link_leads_from_is_told_and_taken_out(tmp_path: Path) -> None:
    text = MIND.replace(
        "skill Go is mlp hidden 1  # to the ball\n", "skill Go is neat most 2\n  reads eye\n  reads charge\n"
    )
    path = write_mind(tmp_path, text)
    teach(path)
    genome = np.random.default_rng(3).normal(0, 1, (4, 8)).astype(np.float32)
    genome[:, 1:4] = 0  # nobody reads the eye
    learnt(path, "Go", genome.ravel())
    before = commands(path, some_readings(path))
    [found] = lint(load(path), ["unused-reading"])
    assert found.message == "Go reads eye, and no link that it has learnt leads from there."
    assert found.hint.startswith(f"mindc edit disconnect {path} Go eye --keep-weights takes the line out")
    made(path, "disconnect", keep_weights=True, skill="Go", target="eye")
    assert commands(path, some_readings(path)) == before
    assert lint(load(path), ["unused-reading"]) == []
    with pytest.raises(EditError, match="Go cannot keep its weights: reads ball_bearing is gone"):
        made(path, "disconnect", keep_weights=True, skill="Go", target="ball_bearing")


def test_a_place_is_read_where_a_link_leads_from_either_of_its_readings(tmp_path: Path) -> None:
    turns = "sensor {0}_turns is odometer side {0}\n"
    declared = turns.format("left") + turns.format("right") + "sensor north is compass\n"
    home = f"{declared}memory home is place left left_turns right right_turns compass north\n"
    text = MIND.replace("memory mood", f"{home}memory mood").replace(
        "skill Go is mlp hidden 1  # to the ball\n", "skill Go is neat most 0\n  reads home\n"
    )
    path = write_mind(tmp_path, text)
    teach(path)
    found = np.zeros((2, 4), np.float32)
    for place, said in ((1, 0), (2, 0), (3, 1)):  # which of the bias, both of the place's and the ball's
        found[:] = 0
        found[0, place] = found[0, 3 if place < 3 else 0] = 1
        learnt(path, "Go", found.ravel())
        assert len([each for each in lint(load(path), ["unused-reading"]) if " home" in each.message]) == said


def learnt(path: Path, skill: str, weights: np.ndarray) -> None:
    """Put weights into the lock in place of those of a skill."""
    lock = read_lock(lock_path(path))
    blob(path.parent, digest(weights)).write_bytes(to_npy(weights))
    write_lock(lock_path(path), lock | {skill: replace(lock[skill], weights=digest(weights))})
