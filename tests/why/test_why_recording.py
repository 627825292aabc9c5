"""`mindc why` on a robot's recording."""

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from mindrun.engine.engine import Engine
from mindrun.graph.bundle import Bundle, digest, write_bundle
from mindrun.graph.policy import Policy
from mindrun.graph.weights import genes
from mindrun.robot.recording import About, Recorder
from numpy.typing import NDArray

from mindlang.compiler.compile import load
from tests.calling import Call
from tests.run.test_whatif_recording import MIND

TICKS, ANEW, STOPPED = 120, 80, 30  # so many, the row in which the program was started again, the row when it stood
BLIND = 10  # the row in which a reading was no number
REMEMBERING = (
    MIND.replace("  drives mood", "  influences Recall at 0.3\n  drives mood")
    + """
skill Recall is elman width 2
  reads glow
  drives right_wheel
skill Alone is rule
  drives left_wheel at 1
"""
)


@pytest.fixture
def day(tmp_path: Path, mindc: Call) -> tuple[Path, Path]:
    """A recording of noise, in which the robot was stopped once, and the bundle that was running."""
    source, bundle, path = tmp_path / "ball.mind", tmp_path / "ball.bundle", tmp_path / "day.rec"
    source.write_text(REMEMBERING)
    graph = load(source).graph
    assert graph
    recall = next(skill for skill in graph.skills if skill.name == "Recall")
    weights = {"Recall": np.random.default_rng(5).uniform(-2, 2, genes(recall)).astype(np.float32)}
    write_bundle(bundle, Bundle(Policy(graph, weights), {}))
    engine, neutral = Engine(Policy(graph, weights), {}), np.full(2, 0.5, np.float32)
    readings = noise(graph.width)
    with Recorder(path, About.of(graph, digest(bundle), graph.master, ("eyes", "glow"))) as recorder:
        for number, row in enumerate(readings):
            if number == ANEW:
                engine.reset()
            commands = engine.tick(row)
            stands = number == STOPPED
            recorder.write(
                tick=number % ANEW,
                time=number / 60,
                readings=row,
                influence=engine.influence,
                commands=commands,
                sent=neutral if stands else commands,
                stopped=stands,
            )
    return path, bundle


def noise(width: int) -> NDArray[np.float32]:
    """What there was to be read: first both readings of the eyes, then that of the glow."""
    readings = np.random.default_rng(6).random((width, TICKS)).astype(np.float32).T.copy()
    readings[BLIND, 1] = np.nan
    return readings


def found(mindc: Call, day: tuple[Path, Path], *words: object) -> dict[str, Any]:
    said = mindc("why", *day, *words, "--json")
    assert said.code == 0, said.err
    data: dict[str, Any] = json.loads(said.out)
    return data


@pytest.mark.parametrize("row", [0, 17, ANEW - 1, ANEW, ANEW + 1, TICKS - 1])
def test_the_command_is_the_recorded_one_and_what_was_read_is_whole(
    mindc: Call, day: tuple[Path, Path], row: int
) -> None:
    data = found(mindc, day, "--tick", row + 1, "left_wheel")
    assert data["command"] == data["acted"]
    made = {tuple(each["path"]): each for each in data["paths"]}
    wander = made.get(("Go", "Wander", "left_wheel"))
    assert wander
    assert wander["value"] == pytest.approx(min(1.0, 0.2 + wander["reads"]["mood"][0]), rel=1e-6)
    assert sum(each["share"] for each in data["paths"]) == pytest.approx(data["command"], rel=1e-6)
    other = found(mindc, day, "--tick", row + 1, "right_wheel")  # to which Recall sends what it remembers
    assert other["command"] == other["acted"]
    assert "Recall" in {each["path"][1] for each in other["paths"]}


def test_a_memory_is_sent_something_as_well(mindc: Call, day: tuple[Path, Path]) -> None:
    data = found(mindc, day, "--tick", f"3..{BLIND}", "mood")
    (only,) = data["paths"]
    assert only["path"] == ["Go", "mood"]
    assert data["command"] == pytest.approx(only["reads"]["glow"][0])
    mean = noise(3)[2:BLIND].mean(axis=0)
    assert only["reads"] == {"eyes": pytest.approx(mean[:2]), "glow": pytest.approx(mean[2:])}
    over = found(mindc, day, "--tick", f"3..{BLIND + 1}", "mood")["paths"][0]
    assert (over["reads"]["eyes"][0] is None, over["reads"]["eyes"][1]) == (False, None)


def test_a_robot_that_was_stopped_was_sent_something_else(mindc: Call, day: tuple[Path, Path]) -> None:
    said = mindc("why", *day, "--tick", STOPPED + 1, "left_wheel")
    assert said.out.splitlines()[1] == "day.rec, Go in charge"
    assert said.out.splitlines()[-1] == "what was sent to the guardian is 0.5000: the robot was stopped"
    over = mindc("why", *day, "left_wheel")
    assert over.out.splitlines()[-1].endswith(f"in the mean: the robot was stopped in 1 of {TICKS} ticks")


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["reward"], "a robot's recording has no rewards"),
        (["--tick", 121, "left_wheel"], "there is no tick 121: it was over after 120 ticks"),
        (["left_whel"], "there is no actuator, memory or skill called left_whel\n  Did you mean left_wheel?"),
        (["rewards"], "\n  There is left_wheel, right_wheel and mood.\n"),
        (["Alone"], "Alone is not below Go, which is in charge\n  It had no influence while this was recorded.\n"),
        (["--seed", 3, "left_wheel"], "are of runs, not of recordings."),
    ],
)
def test_a_question_without_an_answer(mindc: Call, day: tuple[Path, Path], words: list[object], message: str) -> None:
    said = mindc("why", *day, *words)
    assert (said.code, said.out) == (2, "")
    assert message in said.err


def test_another_bundle_or_no_recording_is_refused(mindc: Call, day: tuple[Path, Path], tmp_path: Path) -> None:
    (tmp_path / "other.mind").write_text(MIND.replace("0.2 + mood", "0.3 + mood"))
    assert mindc("build", tmp_path / "other.mind", "-o", tmp_path / "other.bundle").code == 0
    said = mindc("why", day[0], tmp_path / "other.bundle", "left_wheel")
    assert (said.code, said.out) == (2, "")
    assert "this was recorded with another bundle" in said.err
    assert mindc("why", tmp_path / "none.rec", day[1], "left_wheel").code == 2
    empty = tmp_path / "empty.rec"
    empty.write_bytes(day[0].read_bytes().partition(b"\n")[0] + b"\n")
    assert "empty.rec has no tick in it" in mindc("why", empty, day[1], "left_wheel").err
