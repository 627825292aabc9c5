"""`mindc whatif` in the simulator: what is changed, where it differs first, and what came of both runs."""

import json
from dataclasses import fields, replace
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest
from mindrun.engine.changes import ChangeError, change_of, silenced
from mindrun.robot.recording import read

from mindlang.compiler.compile import load
from mindlang.pictures.picture import outcome_words, view_of
from mindlang.pictures.theme import PAPER
from mindlang.run.recorded_run import RecordedRun, run_result
from mindlang.run.setup import RunSetup, set_up
from mindlang.whatif.comparison import compare_runs
from mindlang.whatif.request import Request, changes_of
from tests.calling import Call

PLAYED = ("--task", "Roam", "--seed", 3)


def found(mindc: Call, rules: Path, *options: object) -> dict[str, Any]:
    said = mindc("whatif", rules, *PLAYED, *options, "--json")
    assert said.code == 0, said.err
    data: dict[str, Any] = json.loads(said.out)
    return data


def setup_of(rules: Path, task: str = "Roam") -> RunSetup:
    return set_up(str(rules), load(rules), task, None)


def test_the_run_as_it_was_is_the_run(mindc: Call, rules: Path) -> None:
    plain = json.loads(mindc("run", rules, *PLAYED, "--json").out)
    was = found(mindc, rules, "--without", "Turn", "--tick", 20)["as_it_was"]
    assert was == {name: plain[name] for name in was}


def test_what_came_of_the_changed_run_is_what_the_changed_mind_does(mindc: Call, rules: Path) -> None:
    changed = found(mindc, rules, "--without", "Turn")["changed"]
    rules.write_text(rules.read_text().replace("influences Turn at 0.2", "influences Turn at 0"))
    plain = json.loads(mindc("run", rules, *PLAYED, "--json").out)
    assert changed == {name: plain[name] for name in changed}


def test_the_first_tick_that_differs_is_the_first(rules: Path) -> None:
    setup = setup_of(rules)
    rollout = setup.rollout()
    graph = setup.ready.policy.graph
    for changes in (silenced(graph, "Turn", 30), change_of(graph, "reading", "ball_bearing", [[0.2]], 17, 20)):
        compared = compare_runs((setup, rollout), 3, changes[0].first, changes)
        was, now = compared.was.run, compared.now.run
        ticks = min(was.ticks, now.ticks)
        blocks = ("readings", "influence", "commands")
        unlike = np.any([(getattr(was, b)[:ticks] != getattr(now, b)[:ticks]).any(axis=1) for b in blocks], axis=0)
        assert compared.differences[0].tick == np.flatnonzero(unlike)[0] + 1 == changes[0].first
        moved = next(each.tick for each in compared.differences if each.what == "robot")
        assert moved == np.flatnonzero((was.body[1 : ticks + 1] != now.body[1 : ticks + 1]).any(axis=1))[0] + 1
        assert np.array_equal(was.body[: changes[0].first], now.body[: changes[0].first])


def test_a_change_may_be_in_the_last_tick_and_no_later(rules: Path) -> None:
    setup = setup_of(rules, "Chase")
    graph = setup.ready.policy.graph
    cast = setup, setup.rollout()
    found = compare_runs(cast, 3, 1199, silenced(graph, "Turn", 1199)).differences
    assert {(each.tick, each.what) for each in found} >= {(1199, "command"), (1200, "robot")}
    assert {each.tick for each in compare_runs(cast, 3, 1200, silenced(graph, "Turn", 1200)).differences} == {1200}
    with pytest.raises(ChangeError, match=r"over after tick 1,200: there is no tick 1,201"):
        compare_runs(cast, 3, 1201, silenced(graph, "Turn", 1201))


def test_a_change_to_what_it_is_anyway_differs_nowhere(mindc: Call, rules: Path) -> None:
    said = mindc("whatif", rules, *PLAYED, "--set", "Turn=0.2", "--ticks", 100)
    assert said.code == 0
    assert "nothing differs, to the bit" in said.out


def test_a_setting_is_for_one_tick_and_a_sensor_for_all_that_follow(rules: Path) -> None:
    setup = setup_of(rules)
    graph = setup.ready.policy.graph
    asked = Request(10, None, ("Turn",), ("feeler=0.5,1,0",), ("Turn=1",))
    made = [changes_of(replace(asked, ticks=ticks), graph, setup.master) for ticks in (None, 3, 1)]
    assert [[each.last for each in changes] for changes in made] == [[None] * 4 + [10], [12] * 5, [10] * 5]
    assert [(each.first, each.values) for each in made[0]] == [(10, (value,)) for value in (0.0, 0.5, 1.0, 0.0, 1.0)]
    place = next(sensor for sensor in graph.sensors if sensor.name == "ball_bearing").start
    read = [
        run_result(setup, setup.rollout(), 3, changes_of(request, graph, setup.master)).run.readings[:, place] == 0.25
        for request in (Request(10, settings=("ball_bearing=0.25",)), Request(10, sensors=("ball_bearing=0.25",)))
    ]
    assert read[0].nonzero()[0].tolist() == [9]
    assert read[1].nonzero()[0].tolist() == [*range(9, len(read[1]))]


@pytest.fixture
def other(mindc: Call, rules: Path, tmp_path: Path) -> Path:
    """A run of another seed, recorded."""
    path = tmp_path / "other.rec"
    assert mindc("run", rules, "--task", "Roam", "--seed", 4, "--record", path).code == 0
    return path


def test_a_sensor_reads_what_was_recorded_tick_by_tick_and_then_its_own(
    mindc: Call, rules: Path, other: Path, tmp_path: Path
) -> None:
    """Its own recording changes nothing; that of another run is read in its own ticks, and no longer than it lasts."""
    mine = tmp_path / "mine.rec"
    assert mindc("run", rules, *PLAYED, "--record", mine).code == 0
    assert found(mindc, rules, "--sensor", f"feeler={mine}", "--sensor", f"ball_bearing={mine}")["differs"] == []
    setup = setup_of(rules)
    graph = setup.ready.policy.graph
    sensor = next(each for each in graph.sensors if each.name == "feeler")
    columns = slice(sensor.start, sensor.start + sensor.width)
    of, parts = read(other)
    recorded = np.concatenate([*parts])["readings"][:, columns]
    short = tmp_path / "short.rec"
    short.write_bytes(other.read_bytes()[: -(len(recorded) - 40) * of.row.itemsize])
    changes = changes_of(Request(30, sensors=(f"feeler={short}",)), graph, setup.master, rules)
    assert [each.last for each in changes] == [40, 40, 40]
    for ticks, last in ((5, 34), (11, 40), (12, 40)):
        shorter = changes_of(Request(30, ticks, sensors=(f"feeler={short}",)), graph, setup.master, rules)
        assert [(each.last, len(each.values)) for each in shorter] == [(last, last - 29)] * 3
    now, own = (run_result(setup, setup.rollout(), 3, made).run.readings[:, columns] for made in (changes, ()))
    assert np.array_equal(now[:29], own[:29])
    assert np.array_equal(now[29:40], recorded[29:40])
    assert not np.array_equal(now[40:60], recorded[40:60])
    said = mindc("whatif", rules, *PLAYED, "--sensor", f"feeler={short}")
    assert "note: a recording ends with tick 40" in said.err


@pytest.mark.parametrize(
    ("words", "said"),
    [
        ("eye={rec}", "there is no sensor called eye"),
        ("feeler=no.rec", "cannot read no.rec"),
        ("feeler={mind}.rec", "is no recording of this mindrun"),
        ("feeler={rec},{other}", "is not what was recorded"),
        ("feeler={folder}/empty.rec", "has 0 ticks: there is no tick 1"),
        ("feeler={rec},{folder}/damaged.mind", "damaged.lock is damaged"),
    ],
)
def test_a_recording_that_does_not_fit_is_refused_in_a_sentence(
    mindc: Call, rules: Path, other: Path, words: str, said: str
) -> None:
    without = rules.with_name("without.mind")
    without.write_text(rules.read_text().replace("feeler", "felt"))
    rules.with_name("rules.mind.rec").write_text("no recording\n")
    rules.with_name("empty.rec").write_bytes(other.read_bytes().partition(b"\n")[0] + b"\n")
    rules.with_name("damaged.mind").write_text(rules.read_text())
    rules.with_name("damaged.lock").write_text("no lock\n")
    words = words.format(rec=other, mind=rules, other=without, folder=rules.parent)
    answer = mindc("whatif", rules, *PLAYED, "--sensor", words)
    assert (answer.code, answer.out) == (2, "")
    assert said in answer.err
    assert "NAME.bundle" not in answer.err, "a bundle is said, or is not what is wrong"


@pytest.mark.parametrize(
    ("before", "after", "said"),
    [
        ("at 0 30 330 deg", "at 0 deg", "feeler has 3 readings in {rec}, and 1 here"),
        ("tick 1/60 s", "tick 1/50 s", "a tick of {rec} is 0.0166667 s, and one of this run 0.02 s"),
        ("feeler", "feelers", "{rec} has no readings of feelers"),
    ],
)
def test_a_recording_of_an_older_version_needs_its_bundle_and_the_same_sensor(
    mindc: Call, rules: Path, other: Path, before: str, after: str, said: str
) -> None:
    old = rules.with_name("old.mind")
    old.write_text(rules.read_text())
    assert before in rules.read_text()
    rules.write_text(rules.read_text().replace(before, after))
    name = after if before == "feeler" else "feeler"
    alone = mindc("whatif", rules, *PLAYED, "--sensor", f"{name}={other}")
    assert alone.code == 2
    assert f"{other}: {rules} is not what was recorded" in alone.err
    assert f"--sensor {name}={other},NAME.bundle" in alone.err
    answer = mindc("whatif", rules, *PLAYED, "--sensor", f"{name}={other},{old}")
    assert answer.code == 2
    assert said.format(rec=other) in answer.err


def test_the_summary_is_for_people(mindc: Call, rules: Path) -> None:
    said = mindc("whatif", rules, *PLAYED, "--tick", 20, "--without", "Chase", "--sensor", "ball_bearing=0.5")
    assert said.code == 0
    assert "Roam with Roam in charge, seed 3" in said.out
    assert "without Chase and ball_bearing=0.5, from tick 20 on" in said.out
    assert "tick 20  influence of Chase 1 → 0" in said.out
    assert "as it was" in said.out


def test_a_mind_without_the_line_takes_over_as_if_the_skill_were_silenced(mindc: Call, rules: Path) -> None:
    other = rules.with_name("other.mind")
    other.write_text(rules.read_text().replace("influences Turn at 0.2", "influences Turn at 0"))
    silent, taken = (found(mindc, rules, "--tick", 30, *how) for how in (("--without", "Turn"), ("--with", other)))
    assert taken["changes"] == [f"with {other}"]
    assert {**taken, "changes": []} == {**silent, "changes": []}
    from_first = found(mindc, rules, "--with", other)["changed"]
    plain = json.loads(mindc("run", other, *PLAYED, "--json").out)
    assert from_first == {name: plain[name] for name in from_first}


def test_what_another_mind_makes_of_a_run_follows_what_was(rules: Path) -> None:
    """The same mind goes on as if nothing had been, in the tick after an event; a new name had no influence before."""
    ours, other = setup_of(rules, "Chase"), rules.with_name("other.mind")
    other.write_text(rules.read_text().replace("Turn", "Spin"))
    theirs = setup_of(other, "Chase")
    was = run_result(ours, ours.rollout(), 3).run
    tick = int(np.flatnonzero(was.events[:, 0])[0]) + 2
    same, renamed = (
        compare_runs((ours, ours.rollout()), 3, tick, (), (setup, setup.rollout())) for setup in (ours, theirs)
    )
    for field in {each.name for each in fields(RecordedRun)} - {"setup"}:
        assert np.array_equal(getattr(same.now.run, field), getattr(was, field), equal_nan=True)
    assert same.differences == renamed.differences == []
    turn, spin = (
        run.influence[:, run.graph.skill_numbers[name]] for run, name in ((was, "Turn"), (renamed.now.run, "Spin"))
    )
    assert np.isnan(spin[: tick - 1]).all()
    assert np.array_equal(spin[tick - 1 :], turn[tick - 1 :])


def test_a_mind_that_does_not_fit_begins_the_run_or_not_at_all(mindc: Call, rules: Path) -> None:
    other = rules.with_name("other.mind")
    other.write_text(rules.read_text().replace("at 0 30 330 deg", "at 0 60 300 deg"))
    answer = mindc("whatif", rules, *PLAYED, "--tick", 30, "--with", other)
    assert answer.code == 2
    assert "its sensors are others" in answer.err
    assert found(mindc, rules, "--with", other)["tick"] == 1
    other.write_text(rules.read_text().replace("task Roam", "task Stroll"))
    assert "no task called Roam" in mindc("whatif", rules, *PLAYED, "--with", other).err
    assert mindc("whatif", rules, *PLAYED, "--with", rules, "--ticks", 3).code == 2


def test_both_paths_are_in_the_picture(mindc: Call, rules: Path, tmp_path: Path) -> None:
    path = tmp_path / "paths.png"
    said = mindc(
        "whatif", rules, "--task", "Chase", "--tick", 100, "--set", "Turn=5", "--ticks", 100, "--picture", path
    )
    assert said.code == 0
    assert "both paths" in said.err
    image = cv2.imread(str(path)).astype(int)
    for colour in PAPER.skills[:2]:
        assert (np.abs(image[100:-80] - colour).max(axis=2) < 30).sum() > 300
    assert mindc("whatif", rules, "--without", "Turn", "--picture", tmp_path / "paths.jpg").code == 2


def test_a_success_is_said_as_one_in_the_picture() -> None:
    found = {"score": 12.34, "by_event": {"reach of ball": 2}, "ticks": 1200, "ended_by": "2 reach of ball"}
    assert outcome_words(found) == "score 12.34, 2 × reach of ball, 1,200 ticks, ended by 2 reach of ball"
    assert outcome_words(found | {"succeeded": True}).endswith("1,200 ticks, success: 2 reach of ball")


def test_the_picture_of_a_plain_scene_has_room_for_both(rules: Path) -> None:
    setup = set_up(str(rules), load(rules), "Chase", None)
    compared = compare_runs((setup, setup.rollout()), 3, 1, silenced(setup.ready.policy.graph, "Chase"))
    both = [compared.was.run, compared.now.run]
    view = view_of(both[0], 900, 900, both[1])
    places = np.concatenate([run.body[:, :2] for run in both])
    pixels = (places - [view.left, view.top]) * view.scale * [1, -1]
    assert (pixels > 0).all()
    assert (pixels < 900).all()


@pytest.mark.parametrize(
    ("options", "said"),
    [
        ((), "nothing is changed"),
        (("--without", "Trun"), "there is no skill called Trun"),
        (("--without", "Nobody"), "called Nobody\n  Below Roam there is Roam, Chase and Turn."),
        (("--task", "Chase", "--master", "Chase", "--without", "Turn"), "Chase does not influence Turn"),
        (("--task", "Chase", "--master", "Chase", "--set", "Turn=1"), "Chase does not influence Turn"),
        (("--set", "nothing"), "--set nothing does not say a number\n  write --set nothing=0.5"),
        (("--set", "=x"), "write --set NAME=0.5"),
        (("--sensor", "feeler"), "--sensor feeler does not say a number"),
        (("--sensor", "feeler=1,2"), "sensor feeler has 3 readings"),
        (("--sensor", "feeler=2"), "feeler cannot be 2"),
        (("--set", "felt=1"), "there is no sensor, memory or skill called felt"),
        (("--without", "Turn", "--tick", 100000), "there is no tick 100,000"),
    ],
)
def test_what_cannot_be_is_said_in_a_sentence(mindc: Call, rules: Path, options: tuple[object, ...], said: str) -> None:
    answer = mindc("whatif", rules, *PLAYED, *options)
    assert answer.code == 2
    assert said in answer.err
    assert answer.out == ""
