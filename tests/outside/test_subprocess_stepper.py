"""Environments that end their process, or do something else to it: one sentence, and who asked goes on."""

import gc
import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

pytest.importorskip("gymnasium")

import numpy as np
from mindrun.errors import MindError
from mindrun.graph.policy import Policy
from mindrun.sim.outside import rollout as environment_rollout
from mindrun.sim.outside import subprocess_stepper
from mindrun.sim.outside.rollout import EnvironmentRollout
from mindrun.sim.outside.stepper import EnvironmentRun, LocalStepper
from mindrun.sim.outside.subprocess_stepper import VARIABLE, SubprocessStepper, is_own, stepper_for
from mindrun.sim.trace import take_over, trace

import mindlang
from tests.calling import caller
from tests.outside import minds, worlds
from tests.outside.test_commands import RULES
from tests.outside.test_environment_workers import LESSON, ROOT, mindc, until, workers_of
from tests.outside.test_outside_rollout import MINDS

ENDS = {"Exit": "exit code 3", "Fault": "SIGSEGV", "Leave": "SystemExit"}


def deadly(way: str, place: str) -> str:
    return f"tests.outside.deadly:deadly/{way}-{place}-v0"


def scored(way: str, place: str, seed: int = 5) -> "np.ndarray[tuple[int, ...], np.dtype[np.float64]]":
    """What a run comes to there."""
    rollout = minds.rollout_of(minds.text(scene=deadly(way, place)))
    return rollout.score(np.zeros((1, rollout.genome_length), np.float32), [seed]).total


@pytest.mark.parametrize(
    ("way", "place", "where"),
    [
        ("Exit", "make", ""),
        ("Fault", "reset", "the beginning of the run of seed 5"),
        *((way, "step", "step 3 of the run of seed 5") for way in ENDS),
    ],
)
def test_an_environment_that_ends_its_process_is_told_with_step_and_seed(way: str, place: str, where: str) -> None:
    with pytest.raises(MindError, match=f"environment {deadly(way, place)} ") as found:
        scored(way, place)
    assert where in found.value.hint
    assert ENDS[way] in found.value.hint


def test_a_program_goes_on_with_other_environments_and_with_the_same() -> None:
    rollout = minds.rollout_of(minds.text(scene=deadly("Exit", "step")))
    for seed in (5, 6):
        with pytest.raises(MindError, match="has ended its process") as found:
            rollout.score(np.zeros((1, rollout.genome_length), np.float32), [seed])
        assert f"in step 3 of the run of seed {seed}" in found.value.hint
    np.testing.assert_array_equal(scored("Exit", "render"), scored("Fault", "render"))


def test_what_it_does_to_its_process_it_does_to_no_other(capfd: pytest.CaptureFixture[str]) -> None:
    handlers = [signal.getsignal(number) for number in (signal.SIGINT, signal.SIGTERM)]
    undisturbed = scored("Exit", "render")
    for way in ("Print", "Signals", "Read"):
        np.testing.assert_array_equal(scored(way, "step"), undisturbed)
    assert [signal.getsignal(number) for number in (signal.SIGINT, signal.SIGTERM)] == handlers
    said = capfd.readouterr()
    assert said.out == ""
    assert said.err == "from Python: ü\nfrom C\n"


def test_its_process_ends_with_it_whatever_thread_an_environment_has_left() -> None:
    stepper = SubprocessStepper(deadly("Thread", "make"))
    stepper.begin([("", 0)], [5])
    process = stepper._process._process
    assert process is not None
    assert process.poll() is None
    del stepper
    gc.collect()
    assert process.poll() is not None


@pytest.mark.parametrize("name", MINDS)
def test_it_comes_to_the_same_bits_there_as_here(name: str) -> None:
    source = MINDS[name].replace("gymnasium ", "gymnasium tests.outside.kept:")
    policy, found = Policy(minds.graph_of(source), {}), []
    for steppers in (LocalStepper, SubprocessStepper):
        rollout = EnvironmentRollout(policy, "Go", "Go", ["Go"], lanes=3, steppers=steppers)
        scores = rollout.score(minds.genomes(rollout, 4), [1, 2**64 - 1])
        found.append((scores.total.tobytes(), scores.ticks.tobytes(), rollout.tally().tobytes()))
    assert found[0] == found[1]


def test_a_run_that_another_mind_takes_over_is_stepped_where_it_was_begun() -> None:
    graph = minds.graph_of(MINDS["numbers"].replace("gymnasium ", "gymnasium tests.outside.kept:"))
    policy = Policy(graph, {"Go": minds.genomes(minds.rollout_of(MINDS["numbers"]), 1)[0]})
    ours, theirs = (EnvironmentRollout(policy, "Go", "Go", steppers=SubprocessStepper) for _ in range(2))
    plain = [moment.readings.tolist() for moment in trace(ours, 7).moments]
    assert [moment.readings.tolist() for moment in take_over(ours, 7, 4, theirs).moments] == plain[3:]


def test_a_check_of_what_is_slow_ends_and_says_that_nothing_is_known(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(environment_rollout, "CHECKED_SECONDS", 0.0)
    name = "tests.outside.kept:tests/Line-v0"
    rollout = minds.rollout_of(minds.text(scene=name), steppers=SubprocessStepper)
    rollout.make_again(minds.genomes(rollout, 1)[0], 1)
    [note] = rollout.notes
    assert note.startswith(f"whether {name} does the same again is not known: ")


HANGS = [
    ("Sleep", "step", "step 3 of the run of seed 5"),
    ("Hold", "reset", "the beginning of the run of seed 5"),
    ("Stop", "render", "its image after step 3 of the run of seed 5"),
    ("Hold", "close", "its close after step 3 of the run of seed 5"),
]


LIMIT_SECONDS = 0.5  # of what never comes back


def made_and_closed(stepper: SubprocessStepper, place: str) -> None:
    """A run of three steps, and an image of it; from a place on nobody waits for long."""
    runs: list[EnvironmentRun] = []

    def begin() -> None:
        runs.extend(stepper.begin([("", 0)], [5]))

    def step() -> None:
        stepper.step(runs, np.zeros((1, 1)))

    calls = [("reset", begin), ("", step), ("", step), ("step", step)]
    calls += [("render", lambda: stepper.image(runs[0])), ("close", lambda: stepper.close(runs))]
    for name, call in calls:
        if name == place:
            stepper._process.step_seconds = LIMIT_SECONDS
        call()


@pytest.fixture
def looks(monkeypatch: pytest.MonkeyPatch) -> None:
    """So often does it look whether an environment comes any further."""
    monkeypatch.setattr(subprocess_stepper, "LOOK_SECONDS", 0.05)


def test_one_that_does_not_come_back_from_its_constructor(looks: None, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv(VARIABLE, "1")
    with pytest.raises(
        MindError, match="deadly/Hold-make-v0 does not come back from being asked for its spaces, in 1 "
    ):
        minds.rollout_of(minds.text(scene=deadly("Hold", "make")))


@pytest.mark.parametrize(("way", "place", "where"), HANGS)
def test_an_environment_that_does_not_come_back_is_killed_and_told(
    looks: None, way: str, place: str, where: str
) -> None:
    """Code in C that holds the interpreter, a process that has stopped, a sleep: the watch is not in that process."""
    stepper = SubprocessStepper(deadly(way, place))
    with pytest.raises(MindError) as found:
        made_and_closed(stepper, place)
    assert str(found.value) == f"the environment {deadly(way, place)} does not come back from {where}, in 0.5 seconds"
    assert not stepper._process.has_begun
    assert VARIABLE in found.value.hint


def test_of_many_environments_that_one_is_told_and_slow_ones_have_their_time_each(looks: None) -> None:
    stepper = SubprocessStepper(deadly("Doze", "step"))
    runs = stepper.begin([("", 0)], range(8))
    stepper._process.step_seconds = 2.0  # half a second longer than all of them together need
    for _ in range(3):
        stepper.step(runs, np.zeros((8, 1)))
    stepper = SubprocessStepper(deadly("Stop", "step"))
    runs = stepper.begin([("", 0)], [1, 2, 3])
    stepper.step(runs[1:2], np.zeros((1, 1)))
    stepper.step(runs, np.zeros((3, 1)))
    stepper._process.step_seconds = LIMIT_SECONDS
    with pytest.raises(MindError, match=r"from step 3 of the run of seed 2, in 0\.5 seconds"):
        stepper.step(runs, np.zeros((3, 1)))


def test_a_process_that_hangs_ends_with_the_program_that_asked(tmp_path: Path) -> None:
    """Killed, too, when it cannot end anything any more."""
    rules(tmp_path, deadly("Stop", "step"))
    words = [sys.executable, "-c", "from mindlang.cli import main; main()", "run", "go.mind", "--seed", "5"]
    path = os.pathsep.join([str(ROOT), str(ROOT / "runtime")])
    asking = subprocess.Popen(words, cwd=tmp_path, env={**os.environ, "PYTHONPATH": path}, stderr=subprocess.DEVNULL)
    until(lambda: any("mindrun.sim.outside" in each for each in workers_of(tmp_path, "T")))
    asking.kill()
    asking.wait()
    until(lambda: workers_of(tmp_path) == [])


def test_a_command_ends_where_an_environment_hangs(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv(VARIABLE, "3")
    world = deadly("Hold", "step")
    (tmp_path / "go.mind").write_text(minds.text(scene=world) + LESSON)
    done = mindc(tmp_path, "train", "go.mind", "--seed", "1", "--workers", "2")
    said = " ".join(done.stderr.split())
    assert (done.returncode, done.stdout) == (1, "")
    assert f"the environment {world} does not come back from step 3 of the run of seed" in said
    assert "in 3 seconds" in said
    assert workers_of(tmp_path) == []


def test_what_a_program_registers_itself_is_stepped_there() -> None:
    worlds.register()
    assert is_own(worlds.name(worlds.Line))
    assert isinstance(stepper_for(worlds.name(worlds.Line)), LocalStepper)
    assert not is_own("CartPole-v1")
    assert isinstance(stepper_for("CartPole-v1"), SubprocessStepper)


def rules(folder: Path, world: str, lesson: str = "") -> Path:
    """A mind there as a file."""
    path = folder / "go.mind"
    path.write_text(RULES.replace("WORLD", world) + lesson)
    return path


def test_a_command_says_so_and_ends_as_for_any_other_fault(tmp_path: Path) -> None:
    rules(tmp_path, deadly("Fault", "step"))
    done = mindc(tmp_path, "bench", "go.mind", "--runs", "2", "--workers", "1")
    said = " ".join(done.stderr.split())
    assert (done.returncode, done.stdout) == (1, "")
    assert "step 3 of the run of seed" in said
    assert deadly("Fault", "step") in said
    assert "SIGSEGV" in said
    assert "Traceback" not in said
    assert workers_of(tmp_path) == []


def test_an_image_that_ends_the_process_is_a_sentence(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    mind = rules(tmp_path, deadly("Exit", "render"))
    said = caller(capsys, monkeypatch)("run", mind, "--seed", 5, "--picture", tmp_path / "run.png")
    assert said.code == 2
    assert f"the environment {deadly('Exit', 'render')} cannot be drawn" in said.err
    assert "of the run of seed 5, and the fault is the environment's: exit code 3." in said.err
    assert not (tmp_path / "run.png").exists()


def test_a_training_says_at_which_step_of_which_run_and_can_go_on(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "go.mind").write_text(minds.text(scene=deadly("Exit", "step")) + LESSON)
    done = caller(capsys, monkeypatch)("train", "go.mind", "--seed", 1, "--workers", 1)
    said = " ".join(done.err.split())
    assert done.code == 1
    assert f"the environment {deadly('Exit', 'step')} has ended its process" in said
    assert "It was in step 3 of the run of seed" in said
    assert "exit code 3" in said
    assert "to go on: mindc train --resume runs/" in said
    assert not (tmp_path / "go.lock").exists()


def test_a_program_is_told_by_an_exception(tmp_path: Path) -> None:
    mind = mindlang.load(rules(tmp_path, deadly("Exit", "step")))
    for ask in (lambda: mind.bench(runs=3), lambda: [*mind.trace(seed=5).moments]):
        with pytest.raises(MindError, match="has ended its process"):
            ask()


EVERYWHERE = """\
import gymnasium, os

class Ending(gymnasium.Env):
    def __init__(self):
        os._exit(3)

gymnasium.register("Ending-v0", Ending)
"""


def test_check_goes_on_where_an_environment_of_this_machine_ends_the_process(tmp_path: Path) -> None:
    """It cannot be made here, which is no mistake of the file."""
    (tmp_path / "sitecustomize.py").write_text(EVERYWHERE)  # which every Python imports when it begins
    rules(tmp_path, "Ending-v0")
    found = {}
    for command in ("check", "run"):
        words = [sys.executable, "-c", "from mindlang.cli import main; main()", command, "go.mind"]
        surroundings = {**os.environ, "PYTHONPATH": os.pathsep.join([str(tmp_path), *filter(None, sys.path)])}
        found[command] = subprocess.run(
            words, cwd=tmp_path, env=surroundings, capture_output=True, text=True, check=False, timeout=600
        )
    assert (found["check"].returncode, "Ending" in found["check"].stderr) == (0, False)
    assert found["run"].returncode == 2
    assert "The environment Ending-v0 cannot be made." in found["run"].stderr
    assert "(exit code 3)" in found["run"].stderr
