"""Every robot with every task that it can do: made, checked, built, taught, tested as its user would."""

import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
import yaml
from hypothesis import given
from hypothesis import strategies as st

from mindlang.api import load, loads
from mindlang.compiler.source import Source
from mindlang.robot.wire import check_wiring
from mindlang.templates import missing, robots, tasks
from mindlang.templates.project import NAME, make_folder, project
from tests.calling import Call
from tests.edits.taught import teach

TOGETHER = [(robot, task) for robot in robots().values() for task in tasks().values() if not missing(robot, task)]
TERMINAL_LINES, TERMINAL_COLUMNS = 24, 80
YAML_WORDS = ("no", "on", "y", "null", "True")  # are none to YAML
PYTEST = (sys.executable, "-m", "pytest", "-q", "-rs", "-p", "no:cacheprovider")


@pytest.fixture(params=TOGETHER, ids=lambda both: f"{both[0].name}-{both[1].name}")
def mind(request: pytest.FixtureRequest, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """A new project's mind, in the working folder."""
    robot, task = request.param
    make_folder(tmp_path / "rover", project("rover", robot, task))
    monkeypatch.chdir(tmp_path / "rover")
    return Path("rover.mind")


def test_a_project_is_checked_linted_and_tidy(mindc: Call, mind: Path) -> None:
    assert mindc("check", mind).err == "nothing wrong\n"
    assert mindc("lint", mind).err == "nothing found\n"
    assert mindc("fmt", "--check", mind).code == 0
    assert "$" not in mind.read_text(encoding="utf-8")


def test_a_project_is_built_with_its_wiring(mindc: Call, mind: Path) -> None:
    teach(mind)
    said = mindc("build", mind, "--robot", "robot.yaml", "-o", "rover.bundle")
    assert said.code == 0, said.err
    assert "wired to rover" in said.err


def test_every_skill_of_a_project_is_taught(mind: Path) -> None:
    graph = load(mind).graph
    assert graph.lessons
    assert graph.master in {skill.name for skill in graph.skills}


def test_a_readme_is_a_screen(mind: Path) -> None:
    lines = Path("README.md").read_text(encoding="utf-8").splitlines()
    assert len(lines) <= TERMINAL_LINES
    assert max(map(len, lines)) <= TERMINAL_COLUMNS


def test_what_was_learnt_belongs_under_version_control(mind: Path) -> None:
    ignored = Path(".gitignore").read_text(encoding="utf-8")
    assert "runs/" in ignored
    assert "lock" not in [line.strip("*./") for line in ignored.splitlines() if not line.startswith("#")]


@given(st.from_regex(NAME, fullmatch=True).map(lambda name: name[:40]) | st.sampled_from(YAML_WORDS))
def test_every_name_is_one_of_a_mind_a_test_and_a_robot(name: str) -> None:
    robot, task = TOGETHER[0]
    texts = project(name, robot, task)
    compile(texts[f"test_{name}.py"], "test", "exec")
    assert yaml.safe_load(texts["robot.yaml"])["robot"] == name
    graph = loads(texts[f"{name}.mind"]).graph
    assert check_wiring(Source("robot.yaml", texts["robot.yaml"]), graph).diagnostics == ()


def test_no_robot_and_no_task_stands_alone() -> None:
    assert {robot.name for robot, _ in TOGETHER} == set(robots())
    assert {task.name for _, task in TOGETHER} == set(tasks())


def test_nothing_of_a_robot_is_there_for_no_task() -> None:
    """A part of a robot that no task asks for would be data that nobody has ever tried."""
    for robot in robots().values():
        needed = {need for task in tasks().values() if not missing(robot, task) for need in task.needs}
        assert {*robot.sense, *robot.act} <= needed


@pytest.mark.slow
def test_a_project_learns_what_it_promises(mindc: Call, mind: Path) -> None:
    """With one seed; benchmarks/new.py has the figures over several."""
    said = mindc("train", mind, "--seed", 1, "--quiet")
    assert said.code == 0, said.err
    said = mindc("run", mind, "--seed", 1, "--picture", "rover.png")
    assert said.code == 0, said.err
    assert Path("rover.png").stat().st_size > 0
    said = mindc("build", mind, "--robot", "robot.yaml", "-o", "rover.bundle")
    assert said.code == 0, said.err
    done = subprocess.run(PYTEST, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout
    assert "skipped" not in done.stdout


def test_a_test_waits_until_something_has_been_taught(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """In the first project: that it waits is said in one file, whatever is to be learnt."""
    make_folder(tmp_path / "rover", project("rover", *TOGETHER[0]))
    monkeypatch.chdir(tmp_path / "rover")
    done = subprocess.run(PYTEST, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout
    assert "1 passed, 1 skipped" in done.stdout
    assert "mindc train rover.mind teaches it first" in done.stdout
