"""What a notebook needs: a run as columns, and how skills were learnt as a figure."""

import sys
from pathlib import Path

import numpy as np
import pytest
from matplotlib.figure import Figure
from mindrun.train.run_folder import create
from mindrun.train.training import train

import mindlang
from mindlang import MindError
from tests.calling import Call
from tests.train.climbing import Sphere, lesson, manifest, unwatched


def test_a_run_as_columns_is_what_the_file_has(mindc: Call, rules: Path, tmp_path: Path) -> None:
    table = mindlang.load(rules).trace_table("Chase", seed=3)
    path = tmp_path / "run.csv"
    mindc("run", rules, "--task", "Chase", "--seed", 3, "--trace", path)
    header, *rows = path.read_text().splitlines()
    assert header.split(",") == [*table]
    assert {len(column) for column in table.values()} == {len(rows)} == {1200}
    written = np.array([row.split(",")[[*table].index("total")] for row in rows], float)
    assert np.array_equal(written, table["total"])


def test_the_columns_are_those_of_the_trace(rules: Path) -> None:
    mind = mindlang.load(rules)
    table = mind.trace_table("Roam", seed=5, master="Turn")
    moments = list(mind.trace("Roam", seed=5, master="Turn").moments)
    for i, actuator in enumerate(mind.graph.actuators):
        assert np.array_equal(table[f"command {actuator.name}"], [moment.commands[i] for moment in moments])


def test_pandas_takes_it(rules: Path) -> None:
    pandas = pytest.importorskip("pandas")
    frame = pandas.DataFrame(mindlang.load(rules).trace_table("Chase", seed=3))
    assert frame["tick"].tolist() == [*range(1, 1201)]


@pytest.mark.parametrize("mean", [False, True])
def test_a_training_as_a_figure(tmp_path: Path, mean: bool) -> None:
    run = create(tmp_path / "runs", manifest(lesson(3)), {}, {})
    train(run, Sphere(), unwatched())
    for where in (run.folder, str(tmp_path / "runs")):
        figure = mindlang.plot_training(where, mean=mean)
        assert isinstance(figure, Figure)
        assert figure.axes[0].get_title(loc="left") == "Climb"


def test_what_cannot_be_drawn_is_said(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    with pytest.raises(MindError, match="there is no run nowhere"):
        mindlang.plot_training("nowhere")
    with pytest.raises(MindError, match="there is no run to draw"):
        mindlang.plot_training()
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    with pytest.raises(MindError, match="not installed") as caught:
        mindlang.plot_training(tmp_path)
    assert "mindlang[plot]" in caught.value.hint
