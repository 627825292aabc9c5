"""`mindc run --record`: a run as a recording, which is read again, computed again and seen as the run was."""

import json
from dataclasses import fields
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from mindrun.engine.changes import ChangedEngine
from mindrun.graph.bundle import Bundle, digest
from mindrun.graph.graph import Graph
from mindrun.graph.policy import Policy
from mindrun.graph.recording_header import GOES_ON
from mindrun.robot.recording import read
from mindrun.robot.replay import replay, replay_recording

from mindlang.compiler.compile import load
from mindlang.lock.status import ReadyMind
from mindlang.run.recorded_run import RecordedRun, record_run
from mindlang.run.recording import run_bytes, run_of, running_bundle
from mindlang.run.setup import RunSetup, set_up
from mindlang.view.viewed import Viewed
from mindlang.view.viewed_recording import viewed_recording
from mindlang.view.viewed_run import ViewedRun
from tests.calling import Call
from tests.draws import cases
from tests.hierarchies import PROCEDURES, SCALES
from tests.sim.test_random_worlds import weights_for
from tests.sim.worlds import random_world

SLOW = [HealthCheck.too_slow, HealthCheck.data_too_large, HealthCheck.large_base_example]


def assert_same(now: RecordedRun, then: RecordedRun) -> None:
    """Every array of two runs to the bit, but where things are that are nowhere; no recording has what acted."""
    for name in (field.name for field in fields(RecordedRun) if field.name not in ("setup", "acting")):
        a, b = getattr(now, name), getattr(then, name)
        if name in ("things", "turned"):
            a, b = (np.where(np.abs(each) < 1e9, each, np.nan) for each in (a, b))
        if name in ("readings", "influence", "commands", "lines"):
            b = b[:, : a.shape[1]]
        assert np.array_equal(a, b, equal_nan=name not in ("events", "held", "touching", "ended")), name


@settings(max_examples=cases(40), suppress_health_check=SLOW)
@given(random_world(), st.sampled_from(SCALES), st.integers(0, 2**64 - 1))
def test_any_run_is_read_again_and_computed_again(graph: Graph, scale: float, seed: int) -> None:
    """Whatever its sensors lose, delay or add: what the skills read is what was recorded."""
    policy = Policy(graph, weights_for(graph, scale, np.random.default_rng(seed % 1000)))
    setup = RunSetup(graph.tasks[0], graph.master, ReadyMind(policy, (), ()), PROCEDURES)
    run = record_run(setup, setup.rollout(), seed)
    with TemporaryDirectory() as folder:
        path = Path(folder) / "run.rec"
        path.write_bytes(run_bytes(run, setup, seed))
        about, parts = read(path)
        rows = np.concatenate([*parts])
        assert about.world
        assert (about.world.task, about.world.seed) == ("World", seed)
        assert replay(path, about.bundle, ChangedEngine(policy, PROCEDURES)).differs is None
    assert np.array_equal(rows["sent"], run.commands)
    assert_same(run_of(about, rows, Bundle(policy, {}), PROCEDURES), run)


@pytest.fixture
def taken(mindc: Call, rules: Path, tmp_path: Path) -> tuple[Path, Path]:
    """A run of a collision, recorded, and the bundle that is built of its mind."""
    rec, bundle = tmp_path / "run.rec", tmp_path / "rules.bundle"
    assert mindc("run", rules, "--task", "Roam", "--seed", 3, "--record", rec, "--trace", tmp_path / "t.csv").code == 0
    assert mindc("build", rules, "-o", bundle).code == 0
    return rec, bundle


def whole(viewed: Viewed) -> Viewed:
    """All of its rows known."""
    while not viewed.over:
        viewed.grow()
    return viewed


def test_it_names_the_bundle_that_is_built_of_its_mind(taken: tuple[Path, Path]) -> None:
    rec, bundle = taken
    assert read(rec)[0].bundle == digest(bundle)
    found = replay_recording(rec, bundle)
    assert (found.differs, found.ticks > 10) == (None, True)


def test_it_is_seen_as_the_run_is(taken: tuple[Path, Path], rules: Path) -> None:
    rec, bundle = taken
    setup = set_up(str(rules), load(rules), "Roam", None)
    run = whole(ViewedRun(setup, setup.rollout(), 3, {}).begun())
    for mind in (bundle, rules):
        seen = whole(viewed_recording(rec, mind))
        assert seen.failed is None
        assert (seen.known, seen.ended_by) == (run.known, run.ended_by)
        assert seen.ended_by == "collision"
        ticks = np.arange(run.known + 1)
        for name in run.columns:
            if name != "flow":
                assert np.array_equal(seen.group(name, ticks), run.group(name, ticks), equal_nan=True), name
        for name in ("task", "seed", "rewards", "ends"):
            assert seen.about[name] == run.about[name]
        assert seen.about["world"]["boxes"] == run.about["world"]["boxes"]
        robot = len(seen.about["events"]) - len(run.about["events"])
        assert [(tick, event - robot) for tick, event in seen.happened if event >= robot] == run.happened


def test_rewards_and_shares_are_those_of_the_run(mindc: Call, taken: tuple[Path, Path], rules: Path) -> None:
    rec, bundle = taken
    ours = json.loads(mindc("why", rules, "--task", "Roam", "--seed", 3, "reward", "--json").out)
    for mind in (bundle, rules):
        said = json.loads(mindc("why", rec, mind, "reward", "--json").out)
        assert (said["by_line"], said["by_event"]) == (ours["by_line"], ours["by_event"])
    assert mindc("whatif", rec, rules, "--without", "Chase").code == 0


def test_a_run_to_a_breakpoint_is_recorded_to_there(mindc: Call, rules: Path, tmp_path: Path) -> None:
    """A breakpoint may have the run notice what its task does not; the recording has the events of the task."""
    rec, stops = tmp_path / "run.rec", tmp_path / "x.break"
    stops.write_text("stop on visit of patch size 4\nstop in tick 20\n")
    said = mindc("run", rules, "--task", "Roam", "--seed", 3, "--break", stops, "--record", rec)
    assert (said.code, rec.exists()) == (1, True), said.err
    about, parts = read(rec)
    rows = np.concatenate([*parts])
    assert about.world
    assert 0 < len(rows) <= 20
    assert rows["world"]["ended"][-1] == GOES_ON
    assert about.world.events == len(running_bundle(rules, about).graph.tasks[1].events)


def test_another_master_is_that_of_its_bundle(mindc: Call, rules: Path, tmp_path: Path) -> None:
    rec, bundle = tmp_path / "run.rec", tmp_path / "chase.bundle"
    assert mindc("run", rules, "--task", "Chase", "--master", "Chase", "--record", rec, "--no-interruption").code == 0
    assert mindc("build", rules, "--master", "Chase", "-o", bundle).code == 0
    assert replay_recording(rec, bundle).differs is None
    for mind in (bundle, rules):
        assert whole(viewed_recording(rec, mind)).known == 1200


def test_another_source_is_refused(mindc: Call, taken: tuple[Path, Path], rules: Path, tmp_path: Path) -> None:
    other = tmp_path / "other.mind"
    other.write_text(rules.read_text().replace("0.9", "0.8"))
    broken = tmp_path / "broken.mind"
    broken.write_text("master\n")
    for words, said in (
        (("why", taken[0], other, "left_wheel"), "other.mind is not what was recorded: its bundle"),
        (("view", taken[0], broken, "--no-browser"), "broken.mind has mistakes"),
        (("whatif", taken[0], tmp_path / "none.mind", "--without", "Chase"), "none.mind"),
    ):
        answer = mindc(*words)
        assert (answer.code, answer.out) == (2, "")
        assert said in answer.err


def test_where_it_cannot_be_written(mindc: Call, rules: Path, tmp_path: Path) -> None:
    said = mindc("run", rules, "--task", "Chase", "--record", tmp_path / "run.csv")
    assert said.code == 2
    assert "must end in .rec" in said.err
