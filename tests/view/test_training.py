"""Trainings that are seen while they grow, and the champions of their generations at play."""

import json
import os
import shutil
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from mindrun.graph.policy import Policy
from mindrun.graph.weights import parts
from mindrun.sim.rollout import Rollout
from mindrun.sim.trace import trace
from mindrun.train.champion_log import CHAMPION_ROWS, read_champions
from mindrun.train.progress import LINES, read_progress
from mindrun.train.run_folder import open_run

from mindlang.compiler.compile import load
from mindlang.training.subject import open_subject
from mindlang.view.learning import Learning, open_learning
from tests.calling import Call
from tests.train.test_train_command import MIND
from tests.view.browser import WAIT_MILLISECONDS, Opened, chromium
from tests.view.serving import Served, request, served

MINDC = (sys.executable, "-c", "from mindlang.cli import main; main()")
LESSON = ("drive.mind", "Go", "--seed", "3", "--generations", "25", "--attempts", "2")
SEED = 7


@pytest.fixture(scope="module")
def taught(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with a mind, and runs/ with one run that has ended."""
    folder = tmp_path_factory.mktemp("taught")
    (folder / "drive.mind").write_text(MIND)
    subprocess.run([*MINDC, "train", *LESSON, "-q"], cwd=folder, env=os.environ, check=True)
    return folder


@pytest.fixture
def run(taught: Path, tmp_path: Path) -> Path:
    """A copy of the run, which a test may change."""
    (found,) = (taught / "runs").glob("*/*")
    return Path(shutil.copytree(found, tmp_path / "runs" / found.parent.name / found.name))


def learning_of(path: Path) -> Learning:
    return open_learning(path, SEED)


def begun(path: Path) -> tuple[Learning, Any]:
    learning = learning_of(path)
    return learning, learning.begin(*learning.newest())


def test_a_view_begins_with_the_newest_champion_and_tells_all_that_was_learnt(run: Path) -> None:
    learning, viewed = begun(run.parent.parent)
    with served(viewed, learning) as view, view.viewer() as viewer:
        about, learnt = viewer.hear("about"), viewer.hear("learnt")
    records, kept = read_progress(run), read_champions(run)
    assert about["source"] == "training"
    assert about["training"]["generation"] == about["training"]["since"] == kept[-1].generation
    assert [tuple(each) for each in learnt["generations"]] == [
        tuple(record[name] for name in ("attempt", "generation", "best", "reevaluated", "verdict"))
        for record in records
    ]
    assert learnt["newest"] == [0, *kept[-1].position]


def test_the_champion_of_a_generation_is_the_one_that_plays(run: Path, taught: Path) -> None:
    learning, viewed = begun(run)
    with served(viewed, learning) as view, view.viewer() as viewer:
        viewer.hear("about")
        viewer.say(say="champion", run=0, attempt=1, generation=15, seed="11")
        about = viewer.hear("about")
        viewer.run(100)
        data = viewer.frame(say="rows", **{"from": 1, "to": 200})
    found = [each for each in read_champions(run) if each.position <= (1, 15)][-1]
    assert about["training"] | {"score": None} == {
        "run": 0, "attempt": 1, "generation": 15, "since": found.generation, "score": None
    }  # fmt: skip
    graph = open_subject(taught / "drive.mind", load(taught / "drive.mind")).graph
    opened = open_run(run)
    weights = dict(opened.weights) | parts(graph, opened.manifest.learners, found.genome)
    moments = [*trace(Rollout(Policy(graph, weights), "Reach", "Go"), 11).moments]
    doubles = np.frombuffer(data[24:], "<f8", len(moments) * about["doubles"]).reshape(len(moments), -1)
    assert doubles[:, :3].tobytes() == np.array([moment.body[:3] for moment in moments]).tobytes()


def test_what_comes_is_told_once(run: Path) -> None:
    lines, rows = (run / LINES).read_bytes(), (run / CHAMPION_ROWS).read_bytes()
    (run / LINES).write_bytes(b"".join(lines.splitlines(keepends=True)[:5]))
    learning, viewed = begun(run)
    with served(viewed, learning) as view, view.viewer() as viewer:
        assert len(viewer.hear("learnt")["generations"]) == 5
        (run / CHAMPION_ROWS).write_bytes(rows)
        (run / LINES).write_bytes(lines + b'{"attempt": ')  # a line that is being written
        heard: list[Any] = []
        while len(heard) < len(read_progress(run)) - 5:
            heard += viewer.hear("learnt")["generations"]
    assert [each[:2] for each in heard] == [
        [record["attempt"], record["generation"]] for record in read_progress(run)[5:]
    ]


def test_a_run_that_begins_later_is_seen_too(run: Path, tmp_path: Path) -> None:
    learning, viewed = begun(tmp_path)
    with served(viewed, learning) as view, view.viewer() as viewer:
        assert viewer.hear("learnt")["run"] == 0
        shutil.copytree(run, run.parent / "later")
        assert viewer.hear("learnt")["run"] == 1
        viewer.say(say="champion", run=1, attempt=2, generation=1)
        assert viewer.hear("about")["training"]["run"] == 1


def test_the_copy_of_the_mind_is_taken_where_the_mind_has_changed(run: Path) -> None:
    manifest = json.loads((run / "manifest.json").read_text())
    manifest["source"] = str(run.parent / "drive.mind")
    (run / "manifest.json").write_text(json.dumps(manifest))
    (run.parent / "drive.mind").write_text(MIND.replace("thrust 80", "thrust 90"))
    assert begun(run)[1].known == 0


WRONG: list[dict[str, object]] = [
    *({"run": wrong} for wrong in (1, -1, "0", None, 1 << 40)),
    *({"attempt": wrong} for wrong in (0, 9, "1", None, 1.5)),
    *({"generation": wrong} for wrong in (0, 26, True, [])),
    *({"seed": wrong} for wrong in (3, "", "-1", "1e3", "0x1", "٣", "9" * 21, str(1 << 64), [])),
    {"fork": 0},
    {"more": 1},
]


@pytest.fixture(scope="module")
def view(taught: Path) -> Iterator[Served]:
    learning, viewed = begun(taught / "runs")
    with served(viewed, learning) as found:
        yield found


@pytest.mark.parametrize("wrong", WRONG, ids=str)
def test_a_champion_that_is_none_is_refused(view: Served, wrong: dict[str, object]) -> None:
    with view.viewer() as viewer:
        viewer.hear("about")
        viewer.say(**{"say": "champion", "run": 0, "attempt": 1, "generation": 1} | wrong)
        assert viewer.hear("refused")["why"]
    assert view.status(request(view)) == 200


def test_only_who_may_change_the_run_chooses_a_champion(taught: Path) -> None:
    learning, viewed = begun(taught / "runs")
    with served(viewed, learning) as view, view.viewer() as first, view.viewer() as second:
        first.hear("about"), second.hear("about")
        second.say(say="champion", run=0, attempt=1, generation=1)
        assert "somebody else" in second.hear("refused")["why"]
        first.say(say="champion", run=0, attempt=1, generation=1)
        assert second.hear("about")["training"]["attempt"] == 1


def test_what_is_no_training_is_said(run: Path, tmp_path: Path, mindc: Call) -> None:
    (tmp_path / "empty").mkdir()
    nothing = mindc("view", tmp_path / "empty")
    assert (nothing.code, nothing.out) == (2, "")
    assert nothing.err.startswith(f"there is no run in {tmp_path / 'empty'}")
    assert "mindc train" in nothing.err
    assert mindc("view", run, "--task", "Reach").code == 2
    (run / LINES).write_bytes(b"no log\n")
    damaged = mindc("view", run)
    assert (damaged.code, damaged.out) == (2, "")
    assert f"no run in {run} says of a generation" in damaged.err
    (run / "manifest.json").write_text("{}")
    assert mindc("view", run).code == 1


def test_the_page_plays_the_champion_that_is_clicked(taught: Path) -> None:
    learning, viewed = begun(taught / "runs")
    with chromium() as browser, served(viewed, learning) as view:
        opened = Opened(browser, f"http://{view.host}/#{view.token}")
        page = opened.page
        page.wait_for_selector("#learning .u-over")
        assert "attempt 2" in page.text_content("#learning-now")
        assert page.get_attribute("#follow-newest", "aria-pressed") == "true"
        box = page.locator("#learning .u-over").bounding_box()
        page.mouse.click(box["x"] + 2, box["y"] + box["height"] / 2)
        page.get_by_text("generation 1, plays").wait_for(timeout=WAIT_MILLISECONDS)
        assert page.get_attribute("#follow-newest", "aria-pressed") == "false"
        page.click("#show-values")
        assert page.is_visible("#curves .u-over")
        opened.close()


def test_what_was_learnt_is_told_again_through_another_connection_and_counted_once(taught: Path) -> None:
    learning, viewed = begun(taught / "runs")
    with chromium() as browser, served(viewed, learning) as view:
        opened = Opened(browser, f"http://{view.host}/#{view.token}")
        told = "document.querySelector('#learning-runs .kind')?.textContent"
        opened.wait(f"{told} > 0")
        generations = opened.page.inner_text("#learning-runs .kind")
        view.drop()
        opened.wait("!document.querySelector('#notice').hidden")
        opened.wait(f"document.querySelector('#notice').hidden && {told} > 0")
        assert opened.page.inner_text("#learning-runs .kind") == generations
        opened.close()
