"""What a viewer of a simulated run is told is the run, to the bit."""

from pathlib import Path

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from mindlang.run.edge_flow import edge_flows
from mindlang.run.recorded_run import record_run
from mindlang.view.rows import DOUBLE_BLOCK, SINGLE_BLOCK, RowBlocks
from tests.view.serving import Served, prepared, unpacked


def test_rows_are_the_run(view: Served, path: Path) -> None:
    setup = prepared(path, "Chase")
    run = record_run(setup, setup.rollout(True), 3)
    flows = edge_flows(setup.ready.policy, {}, setup.master, run)
    with view.viewer() as viewer:
        about = viewer.hear("about")
        assert viewer.run(1200)["over"]
        frame = viewer.frame(say="rows", **{"from": 0, "to": 5000, "every": 7}, ask=9)
    fork, ask, ticks, doubles, singles = unpacked(frame, about["doubles"], about["singles"])
    assert (fork, ask) == (0, 9)
    assert ticks.tolist() == [*range(0, 1201, 7)]

    def group(name: str) -> np.ndarray:
        block, first, count = about["columns"][name]
        return (doubles, singles)[block][:, first : first + count]

    assert group("robot").tobytes() == run.body[ticks].tobytes()
    assert group("things").reshape(len(ticks), -1, 4)[:, :, :3].tobytes() == run.things[ticks].tobytes()
    assert group("held")[:, 0].tolist() == run.held[ticks].tolist()
    for name, rows in (("readings", run.readings), ("influence", run.influence), ("commands", run.commands)):
        assert group(name)[1:].tobytes() == rows[ticks[1:] - 1].tobytes()
        first = group(name)[0]  # before anything is read, thought or sent
        assert (first == 0).all() if name == "influence" else np.isnan(first).all()
    assert group("rewards")[1:].tobytes() == run.lines[ticks[1:] - 1].tobytes()
    assert np.array_equal(group("flow")[1:], flows.transmitted(ticks[1:] - 1))


@given(st.lists(st.integers(1, 300), min_size=1, max_size=12), st.data())
def test_rows_of_any_parts_are_those_of_the_whole(lengths: list[int], data: st.DataObject) -> None:
    whole = np.arange(sum(lengths) * 3, dtype=np.float64).reshape(-1, 3)
    blocks, first = RowBlocks(), 0
    for length in lengths:
        part = whole[first : first + length]
        blocks.append(part, part.astype(np.float32))
        first += length
    drawn = data.draw(st.tuples(*[st.integers(0, first)] * 2, st.integers(1, 40), st.integers(1, 500)))
    ticks = blocks.ticks(*drawn)
    columns = data.draw(st.lists(st.integers(0, 2), min_size=1))
    assert np.array_equal(blocks.kept(DOUBLE_BLOCK, ticks), whole[ticks])
    for block in (DOUBLE_BLOCK, SINGLE_BLOCK):
        assert np.array_equal(blocks.kept(block, ticks, columns), whole[ticks][:, columns])
