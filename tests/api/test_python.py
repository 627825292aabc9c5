"""The Python surface: the page's examples run, nothing prints, and weights never meet a graph that is not theirs."""

import re
import shutil
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from mindrun.errors import MindError, WeightsError
from mindrun.policy import Policy

import mindlang
from mindlang.training.lesson_choice import TrainOptions

ROOT = Path(__file__).parents[2]
COLLECT = ROOT / "examples" / "collect"
PAGE = ROOT / "docs" / "python.md"


@pytest.fixture
def collect(tmp_path: Path) -> Path:
    """The example in a folder of its own."""
    for name in ("collect.mind", "collect.lock", "weights"):
        copy = shutil.copytree if (COLLECT / name).is_dir() else shutil.copy
        copy(COLLECT / name, tmp_path / name)
    return tmp_path


def test_the_examples_run(collect: Path) -> None:
    code = "\n".join(re.findall(r"```python\n(.*?)```", PAGE.read_text(encoding="utf-8"), re.DOTALL))
    assert len(code.splitlines()) > 30
    done = subprocess.run([sys.executable, "-c", code], cwd=collect, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    assert "whiskers" in done.stdout
    assert (collect / "collect.bundle").stat().st_size > 1000


def test_importing_it_imports_nothing() -> None:
    code = "import mindlang, sys; print([m for m in ('numpy', 'numba', 'lark') if m in sys.modules])"
    assert subprocess.run([sys.executable, "-c", code], capture_output=True, text=True).stdout == "[]\n"


def test_nothing_prints(collect: Path, capfd: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(collect)
    mind = mindlang.load("collect.mind")
    mind.engine().tick(np.zeros(mind.graph.width))
    mind.train("GoToObject", options=TrainOptions(generations=1, population=10), seed=1)
    mindlang.load("nothing.mind")
    mind.edit("rename", old="proximity", new="whiskers")
    assert capfd.readouterr() == ("", "")


def test_what_is_wrong_is_a_value(tmp_path: Path) -> None:
    assert [each.code for each in mindlang.load(tmp_path / "none.mind").diagnostics] == ["unreadable"]
    wrong = mindlang.loads("tick 1/60 s\nmaster Nobody\n")
    assert not wrong.is_valid
    assert {"unknown-skill", "no-body"} <= {each.code for each in wrong.diagnostics}
    with pytest.raises(MindError):
        _ = wrong.graph


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
    policy = mindlang.load(collect / "collect.mind").ready().policy
    other = mindlang.loads(swapped(collect / "collect.mind")).graph
    with pytest.raises(WeightsError, match=r"of GoToObject belong to a graph that reads and sends in another order"):
        Policy(other, policy.weights)
    with pytest.raises(WeightsError, match="there are weights of Avoid, but there is no such skill"):
        replace(policy, graph=replace(policy.graph, skills=()))


def test_a_training_is_cancelled_and_goes_on(collect: Path) -> None:
    mind = mindlang.load(collect / "collect.mind")
    seen: list[int] = []

    def train(cancelled: bool) -> list[dict[str, object]]:
        return mind.train(
            "GoToObject",
            options=TrainOptions(generations=4, population=10),
            seed=3,
            runs=collect / "runs",
            on_generation=lambda record: seen.append(record.generation),
            cancelled=lambda: cancelled and len(seen) == 2,
        )

    assert train(cancelled=True) == []
    [result] = train(cancelled=False)
    assert seen == [1, 2, 3, 4]
    assert result["skill"] == "GoToObject"


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
