"""What `mindc propose` knows of a task, what it tries, and that what it proposes is a source."""

import json
from contextlib import nullcontext
from dataclasses import replace
from pathlib import Path

import pytest
from mindrun.sim.rollout import Rollout

from benchmarks.propose import answer, hidden, proposal
from mindlang.compiler.compile import load
from mindlang.propose.candidates import Candidate, learning_candidates, like_candidates
from mindlang.propose.search import Proposal, propose
from mindlang.propose.static import Known, known_of
from mindlang.propose.trial import Stage
from tests.calling import Call

ROVER = """\
tick 1/60 s
master Rest
body Robot is disc size 2 density 2 linear_damping 5 angular_damping 20
actuator left_wheel is wheel side left thrust 80 neutral 0.5
actuator right_wheel is wheel side right thrust 80 neutral 0.5
actuator light is lamp neutral 0
actuator claw is gripper neutral 0
sensor feeler is range_finder at -45 0 45 deg range 12
sensor gem_bearing is bearing of gem
sensor home_bearing is bearing of home
sensor holding is held of gem

skill Rest is rule
  drives left_wheel at 1/2
  drives right_wheel at 1/2

task Go in plain
  contains gem is item size 3 reached moves
  lasts 1000 ticks
  rewards 1 on reach of gem

task Wander in arena size 40
  contains home is zone size 5
  lasts 1000 ticks
  rewards 1 on visit of patch size 4

task Fetch in arena size 40
  contains gem is item size 1
  contains home is zone size 10
  lasts 1000 ticks
  rewards 1 on delivery of gem
"""
DRIVES = ("drives left_wheel", "drives right_wheel")


@pytest.fixture
def rover(tmp_path: Path) -> Path:
    path = tmp_path / "rover.mind"
    path.write_text(ROVER)
    return path


@pytest.fixture(scope="module")
def without_zone(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The mind of Collect without GoToDropZone, what is above it, and their lessons."""
    return hidden(tmp_path_factory.mktemp("hidden"), "GoToDropZone", decoys=False)


def stage_of(path: Path, task: str, skill: str = "New", workers: int = 1) -> Stage:
    compiled = load(path)
    known = known_of(compiled, task)
    return Stage(
        compiled, path, known, skill, skill, 1, workers, Rollout.compile, lambda *_: nullcontext(lambda more: None)
    )


@pytest.mark.parametrize(
    ("task", "changing", "actuators"),
    [
        ("Go", ["gem_bearing", "holding"], ["left_wheel", "right_wheel"]),
        ("Wander", ["feeler", "home_bearing"], ["left_wheel", "right_wheel"]),
        ("Fetch", ["feeler", "gem_bearing", "home_bearing", "holding"], ["left_wheel", "right_wheel", "claw"]),
    ],
)
def test_it_knows_what_can_change_and_what_the_task_can_feel(
    rover: Path, task: str, changing: list[str], actuators: list[str]
) -> None:
    known = known_of(load(rover), task)
    assert [*known.changing] == changing
    assert [*known.actuators] == actuators
    assert known.needs_claw == (task == "Fetch")
    assert known.constants.keys().isdisjoint(known.changing)


def test_exchanged_readings_are_of_the_same_kind_and_another_thing(without_zone: Path) -> None:
    known = known_of(load(without_zone), "GoToDropZone")
    [found] = like_candidates(known, ["GoToObject", "Avoid"])
    assert found == Candidate("like", ("drop_zone_bearing for object_bearing",), origin="GoToObject")


def test_a_whole_hierarchy_is_exchanged_where_its_subskills_have_counterparts(tmp_path: Path) -> None:
    known = known_of(load(hidden(tmp_path, "GoToDropZone+Avoid", decoys=False)), "GoToDropZone+Avoid")
    [found] = like_candidates(known, ["GoToObject+Avoid"])
    assert found.reads == ("drop_zone_bearing for object_bearing", "drop_zone_drift for object_drift")
    assert found.sends == ("influences GoToDropZone for GoToObject",)


def test_a_master_that_needs_a_claw_has_the_rule_that_drives_it(tmp_path: Path) -> None:
    known = known_of(load(hidden(tmp_path, "Collect", decoys=False)), "Collect")
    able = [skill.name for skill in known.mind.skills]
    masters = [each for each in learning_candidates(known, able, dict.fromkeys(able, 0.0)) if each.way == "master"]
    assert len(masters) == 10
    assert all("influences Grab at 1" in each.sends for each in masters)
    assert all({"holding", "in_drop_zone"} <= {*each.reads} for each in masters)


def test_candidates_compile_and_what_is_proposed_keeps_its_evidence(without_zone: Path) -> None:
    stage = stage_of(without_zone, "GoToDropZone", "GoToDropZone")
    able = [skill.name for skill in stage.known.mind.skills]
    gains = dict.fromkeys(able, 1.0)
    for each in (*like_candidates(stage.known, able), *learning_candidates(stage.known, able, gains)):
        assert stage.graph_of(each), each
        assert each.way != "from" or stage.begin(each), each
    lines = stage.lines(Candidate("scratch", ("drop_zone_bearing", "bias"), DRIVES), {"bias": "a constant"})
    assert "  reads bias  # a constant" in lines
    assert "sensor bias is computed at 1" in lines


def test_attempts_are_the_same_for_any_number_of_workers(rover: Path) -> None:
    scores = []
    for workers in (1, 3):
        stage = stage_of(rover, "Go", workers=workers)
        trial = stage.begin(Candidate("scratch", ("gem_bearing",), DRIVES))
        assert trial
        stage.teach(trial, 2, attempts=2)
        assert trial.score > 0
        scores.append([each.tolist() for each in trial.scores])
    assert scores[0] == scores[1]


def test_what_is_held_at_its_mean_is_constant_there(rover: Path) -> None:
    stage = stage_of(rover, "Go")
    trial = stage.begin(Candidate("scratch", ("gem_bearing", "bias"), DRIVES))
    assert trial
    stage.teach(trial, 1)
    means = stage.means(trial)
    assert means["bias"] == (1.0,)
    assert 0 < means["gem_bearing"][0] < 1
    assert stage.holding(trial, ["bias"], means).tolist() == trial.scores[trial.best].tolist()
    assert stage.holding(trial, ["gem_bearing"], means).mean() < trial.score


def test_names_that_are_taken_or_unknown_are_refused(mindc: Call, rover: Path) -> None:
    assert mindc("propose", rover, "Go", "--skill", "Rest").err.startswith("There is already a skill called Rest.")
    assert mindc("propose", rover, "Gone").code == 2
    assert mindc("propose", rover, "Go", "--skill", "9").code == 2


@pytest.mark.slow
def test_a_robot_with_one_line_of_reward_can_do_it(mindc: Call, rover: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(rover.parent)
    rover.write_text(ROVER.replace("1000", "3000"))
    before = rover.read_text()
    found = json.loads(mindc("propose", rover, "Go", "--json", "-q").out)
    assert rover.read_text() == before
    assert found["reads"] == ["gem_bearing"]
    assert mindc("propose", rover, "Go", "--apply", "-q").out == found["diff"]
    assert "reads gem_bearing  # +" in rover.read_text()
    assert mindc("check", rover).code == 0


@pytest.mark.slow
def test_decoys_and_workers_change_nothing(tmp_path: Path) -> None:
    path = hidden(tmp_path, "GoToDropZone", decoys=True)
    stage, found = proposal(path, "GoToDropZone", seed=1, workers=2)
    assert answer(stage, found.winner.candidate) == ({"drop_zone_bearing"}, set())
    alone = propose(replace(stage, workers=1))
    assert _shown(alone) == _shown(found)


def _shown(found: Proposal) -> tuple[Candidate, float, list[tuple[Candidate, int, float]]]:
    return found.winner.candidate, found.winner.score, found.tried


def test_known_says_what_a_skill_and_all_below_it_read(without_zone: Path) -> None:
    known: Known = known_of(load(without_zone), "GoToObject+Avoid")
    assert known.reads_of("GoToObject+Avoid") == (
        *("proximity", "object_bearing", "object_drift", "object_in_reach", "moving", "pulse"),
    )
    assert known.driven_by(["GoToObject+Avoid"]) == {"left_wheel", "right_wheel"}
