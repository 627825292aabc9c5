"""The Python surface: typed examples (tests/pages runs them), no prints, and weights that meet no other graph."""

import os
import re
import shutil
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from mindrun.engine.engine import Engine
from mindrun.errors import MindError, WeightsError
from mindrun.graph.policy import Policy

import mindlang
from mindlang import TrainOptions
from mindlang.run.setup import layouts
from tests.api.conftest import COLLECT

ROOT = Path(__file__).parents[2]
PAGE = ROOT / "docs" / "python.md"


def code() -> str:
    """All examples of the page, one after the other."""
    found = "\n".join(re.findall(r"```python\n(.*?)```", PAGE.read_text(encoding="utf-8"), re.DOTALL))
    assert len(found.splitlines()) > 30
    return found


@pytest.mark.slow
def test_the_examples_are_typed(tmp_path: Path) -> None:
    """As a program of a user is, whose checker is strict."""
    (tmp_path / "program.py").write_text(code(), encoding="utf-8")
    words = [sys.executable, "-m", "mypy", "--strict", "--explicit-package-bases", "--follow-imports=silent"]
    ours = os.environ | {"MYPYPATH": f"{ROOT}{os.pathsep}{ROOT / 'runtime'}"}
    done = subprocess.run([*words, "program.py"], cwd=tmp_path, env=ours, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout


def test_nothing_prints(collect: Path, capfd: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(collect)
    mind = mindlang.load("collect.mind")
    mind.engine().tick(np.zeros(mind.graph.width))
    mind.train("GoToObject", options=TrainOptions(generations=1, population=10), seed=1)
    mindlang.load("nothing.mind")
    edited = mind.edit("rename", old="proximity", new="whiskers")
    assert edited.summary
    mind.bench("GoToObject", runs=3)
    assert capfd.readouterr() == ("", "")


def swapped(path: Path) -> str:
    """The text of a mind in which GoToObject drives its wheels in another order."""
    text = path.read_text()
    moved = text.replace(
        "  reads object_bearing\n  drives left_wheel\n  drives right_wheel\n",
        "  reads object_bearing\n  drives right_wheel\n  drives left_wheel\n",
    )
    assert moved != text
    return moved


def test_weights_follow_the_lines_of_the_source(collect: Path) -> None:
    before = mindlang.load(collect / "collect.mind")
    readings = np.random.default_rng(1).random((50, before.graph.width)).astype(np.float32)
    engine = before.engine()
    commands = [engine.tick(row) for row in readings]
    (collect / "collect.mind").write_text(swapped(collect / "collect.mind"))
    after = mindlang.load(collect / "collect.mind").engine()
    assert all(np.array_equal(after.tick(row), was) for row, was in zip(readings, commands, strict=True))


def test_weights_never_meet_a_graph_in_another_order(collect: Path) -> None:
    policy = mindlang.load(collect / "collect.mind").policy()
    other = mindlang.loads(swapped(collect / "collect.mind")).graph
    with pytest.raises(WeightsError, match=r"of GoToObject belong to a graph that reads and sends in another order"):
        Policy(other, policy.weights)
    with pytest.raises(WeightsError, match="there are weights of Avoid, but no such skill has its own"):
        replace(policy, graph=replace(policy.graph, skills=()))


def test_what_was_not_taught_is_said_with_what_to_do(tmp_path: Path) -> None:
    shutil.copy(COLLECT / "collect.mind", tmp_path)
    mind = mindlang.load(tmp_path / "collect.mind")
    with pytest.raises(MindError, match="has not been taught") as caught:
        mind.engine()
    assert "mindc train" in caught.value.hint
    with pytest.raises(MindError, match="has not been taught"):
        mind.rollout("Collect")
    learning = mind.rollout("GoToObject", learners=["GoToObject"])
    assert learning.score(np.zeros((2, learning.genome_length), np.float32), [1]).total.shape == (2, 1)


def test_an_edit_is_written_and_gives_the_mind_as_it_is_then(collect: Path) -> None:
    mind = mindlang.load(collect / "collect.mind")
    edited = mind.edit("rename", old="Avoid", new="Dodge", noun="skill")
    assert "-skill Avoid is mlp" in edited.diff
    assert "Dodge has the weights of Avoid" in edited.summary
    after = edited.write()
    assert "Dodge" in [skill.name for skill in after.graph.skills]
    readings = np.full(mind.graph.width, 0.4)
    now = after.engine().tick(readings)
    assert np.array_equal(now, Engine(mindlang.load(COLLECT / "collect.mind").policy()).tick(readings))
    with pytest.raises(MindError, match="has been changed meanwhile"):
        mind.edit("rename", old="proximity", new="whiskers").write()


def test_a_bench_is_means_with_their_errors(collect: Path) -> None:
    mind = mindlang.load(collect / "collect.mind")
    found = mind.bench("GoToObject", runs=8, seed=2)
    one = mind.rollout("GoToObject").score(np.zeros((1, 0), np.float32), layouts(2, 8))
    assert found["count_mean"] == one.counts.mean()
    assert found["count_standard_error"] == pytest.approx(one.counts.std(ddof=1) / 8**0.5)
    assert (found["runs"], found["task"], found["master"]) == (8, "GoToObject", "GoToObject")
    best = list(mind.trace("GoToObject", found["best_seed"]).moments)
    assert len(best) == one.ticks[0, int(one.total[0].argmax())]
