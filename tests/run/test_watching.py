"""Runs with several robots, written down through one: as a recording, an answer, a table and a picture."""

import json
from csv import DictReader
from pathlib import Path

import numpy as np
import pytest
from mindrun.engine.changes import ChangedEngine
from mindrun.numbers.arrays import Doubles
from mindrun.robot.recording import RecordingError, read
from mindrun.robot.replay import replay

from mindlang.compiler.compile import load
from mindlang.pictures.canvas import Canvas, Viewport, blank
from mindlang.pictures.path import draw_others
from mindlang.pictures.scene import draw_items, thing_colours
from mindlang.pictures.theme import PAPER
from mindlang.run.recorded_run import RecordedRun, record_run
from mindlang.run.recording import bundle_without_robot, run_bytes, run_of, running_bundle
from mindlang.run.setup import RunSetup, set_up
from tests.calling import RULES, Call
from tests.run.test_run_recording import assert_same

TEAM = """
task Meet in arena size 30
  contains mate is robot count 1
  contains stray is robot count 1 under Turn
  contains ball is item size 2 reached moves
  lasts 300 ticks
  rewards 10 on reach of ball
  rewards -1 on collision with mate
"""
SEED, ROBOTS = 3, 3


@pytest.fixture
def team(tmp_path: Path) -> Path:
    path = tmp_path / "team.mind"
    path.write_text(RULES + TEAM)
    return path


def watching(team: Path, robot: int, master: str = "Roam") -> RunSetup:
    return set_up(str(team), load(team), "Meet", master, robot=robot)


def run_through(team: Path, robot: int, master: str = "Roam") -> RecordedRun:
    setup = watching(team, robot, master)
    return record_run(setup, setup.rollout(), SEED)


@pytest.mark.parametrize("master", ["Roam", "Chase"])
@pytest.mark.parametrize("robot", range(ROBOTS))
def test_a_recording_says_of_which_robot_it_is_and_is_computed_again(team: Path, robot: int, master: str) -> None:
    setup, path = watching(team, robot, master), team.with_name("run.rec")
    run = run_through(team, robot, master)
    path.write_bytes(run_bytes(run, setup, SEED))
    about, parts = read(path)
    assert about.world
    assert (about.world.robot, about.master) == (robot, (master, master, "Turn")[robot])
    mind = bundle_without_robot(setup.mind, team.parent)
    assert replay(path, about.bundle, ChangedEngine(mind.policy, team.parent, about.master)).differs is None
    again = run_of(about, np.concatenate([*parts]), running_bundle(team, about), team.parent)
    assert again.setup.robot == robot
    assert_same(again, run)


def test_a_recording_of_a_robot_that_its_world_has_not_is_of_something_else(team: Path) -> None:
    setup, path = watching(team, 0), team.with_name("run.rec")
    path.write_bytes(run_bytes(run_through(team, 0), setup, SEED))
    about, _ = read(path)
    assert about.world
    object.__setattr__(about.world, "robot", ROBOTS)
    with pytest.raises(RecordingError, match="other columns"):
        running_bundle(team, about)


def test_an_answer_and_a_table_are_of_the_robot_that_is_watched(mindc: Call, team: Path, tmp_path: Path) -> None:
    rec, table = tmp_path / "run.rec", tmp_path / "run.csv"
    chosen = "--task", "Meet", "--seed", SEED, "--robot", 1
    assert mindc("run", team, *chosen, "--record", rec, "--trace", table).code == 0
    now = json.loads(mindc("why", team, *chosen, "--tick", 100, "left_wheel", "--json").out)
    then = json.loads(mindc("why", rec, team, "--tick", 100, "left_wheel", "--json").out)
    assert (now["robot"], then["robot"]) == (1, 1)
    assert now["paths"] == then["paths"]
    run, other = run_through(team, 1), run_through(team, 0)
    with table.open() as file:
        rows = [*DictReader(file)]
    assert "robot 1 x" not in rows[0]  # that is x
    for name, column in (("x", 0), ("y", 1), ("angle", 2)):
        assert np.array_equal([float(row[f"robot 0 {name}"]) for row in rows], other.body[1:, column])
        assert np.array_equal([float(row[name]) for row in rows], run.body[1:, column])


def test_a_robot_that_the_world_has_not_is_refused_with_those_that_it_has(mindc: Call, team: Path) -> None:
    found = mindc("run", team, "--task", "Meet", "--robot", ROBOTS)
    assert (found.code, found.out) == (2, "")
    assert found.err == "there is no robot 3 in Meet\n  its robots are 0 to 2\n"
    assert "its only robot is robot 0" in mindc("run", team, "--task", "Chase", "--robot", 1).err


class Discs(Canvas):
    """The middles of discs that are filled and the points of lines, by their colours."""

    def __init__(self) -> None:
        super().__init__(blank(400, 400, PAPER.floor), Viewport(-20.0, 20.0, 10.0))
        self.drawn: dict[object, list[Doubles]] = {}

    def disc(self, x: float, y: float, radius: float, colour: object, *rest: object, **how: object) -> None:
        if not how.get("width"):
            self.drawn.setdefault(colour, []).append(np.array([x, y]))

    def line(self, points: object, colour: object, *rest: object, **how: object) -> None:
        self.drawn.setdefault(colour, []).append(np.array(points))


def test_a_picture_has_all_robots_with_their_ways(team: Path) -> None:
    runs = [run_through(team, robot) for robot in range(ROBOTS)]
    for robot, run in enumerate(runs):
        canvas, ways = Discs(), Discs()
        draw_items(canvas, run, PAPER, run.ticks)
        draw_others(ways, run, PAPER, 0, run.ticks)
        colours = dict(zip(run.labels, thing_colours(run.contents, PAPER), strict=True))
        for other in {*range(ROBOTS)} - {robot}:
            colour, body = colours[f"robot {other}"], runs[other].body
            assert any(np.array_equal(middle, body[-1, :2]) for middle in canvas.drawn[colour])
            assert any(np.array_equal(way, body[:, :2]) for way in ways.drawn[colour])
        assert sum(map(len, ways.drawn.values())) == ROBOTS - 1
