"""`mindc why` on a robot's recording."""

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from mindrun.bundle import digest, read_bundle
from mindrun.engine import Engine
from mindrun.robot.recording import About, Recorder

from tests.calling import Call
from tests.run.test_whatif_recording import MIND

TICKS, ANEW, STOPPED = 120, 80, 30  # so many, the row in which the program was started again, the row when it stood


@pytest.fixture
def day(tmp_path: Path, mindc: Call) -> tuple[Path, Path]:
    """A recording of noise, in which the robot was stopped once, and the bundle that was running."""
    source, bundle, path = tmp_path / "ball.mind", tmp_path / "ball.bundle", tmp_path / "day.rec"
    source.write_text(MIND)
    assert mindc("build", source, "-o", bundle).code == 0
    mind = read_bundle(bundle)
    engine, neutral = Engine(mind.policy, mind.procedures), np.full(2, 0.5, np.float32)
    readings = np.random.default_rng(5).random((TICKS, mind.graph.width)).astype(np.float32)
    with Recorder(path, About.of(mind.graph, digest(bundle), mind.graph.master, ("eyes", "glow"))) as recorder:
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


def test_a_memory_is_sent_something_as_well(mindc: Call, day: tuple[Path, Path]) -> None:
    data = found(mindc, day, "--tick", 3, "mood")
    assert [each["path"] for each in data["paths"]] == [["Go", "mood"]]
    assert data["command"] == pytest.approx(data["paths"][0]["reads"]["glow"][0])


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
        (["left_whel"], "there is no actuator, memory or skill called left_whel"),
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
