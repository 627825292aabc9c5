"""`mindc whatif` on a robot's recording: the readings of the record, the commands compared."""

import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from mindrun.engine.changes import ChangeError
from mindrun.engine.engine import Engine
from mindrun.graph.bundle import digest, read_bundle
from mindrun.graph.graph import Graph
from mindrun.robot.recording import About, Recorder
from numpy.typing import NDArray

from mindlang.whatif.request import Request, changes_of
from tests.calling import Call

TICKS, ANEW = 200, 150  # so many, and the row in which the program was started again
MIND = """
tick 1/60 s
master Go
body Robot is disc
actuator left_wheel is wheel side left neutral 0.5
actuator right_wheel is wheel side right neutral 0.5
sensor eyes is range_finder at 0 90 deg range 12
sensor glow is distance of lamp range 40
sensor rate is derivative of glow range 100
memory mood is cell decay 0.9
skill Wander is rule
  reads mood
  drives left_wheel at 0.2 + mood
  drives right_wheel at 0.9 - mood
skill Seek is rule
  reads glow
  reads rate
  drives left_wheel at glow
  drives right_wheel at rate
skill Go is rule
  reads eyes
  reads glow
  influences Wander at 1 - glow
  influences Seek at glow when glow > 0.5
  drives mood at glow
task Roam in arena size 40
  contains lamp is zone size 2
  lasts 200 ticks
  rewards forward per tick
"""


@pytest.fixture
def day(tmp_path: Path, mindc: Call) -> tuple[Path, Path]:
    """A recording of noise, and the bundle that was running."""
    source, bundle, path = tmp_path / "ball.mind", tmp_path / "ball.bundle", tmp_path / "day.rec"
    source.write_text(MIND)
    assert mindc("build", source, "-o", bundle).code == 0
    record(path, bundle, noise(read_bundle(bundle).graph))
    return path, bundle


def noise(graph: Graph) -> NDArray[np.float32]:
    return np.random.default_rng(5).random((TICKS, graph.width)).astype(np.float32)


def record(
    path: Path, bundle: Path, readings: NDArray[np.float32], sensors: tuple[str, ...] = ("eyes", "glow")
) -> None:
    found = read_bundle(bundle)
    engine = Engine(found.policy, found.procedures)
    with Recorder(path, About.of(found.graph, digest(bundle), found.graph.master, sensors)) as recorder:
        for number, row in enumerate(readings):
            tick = number % ANEW
            if tick == 0:
                engine.reset()
            commands = engine.tick(row)
            recorder.write(
                tick=tick,
                time=number / 60,
                readings=engine.readings,
                influence=engine.influence,
                commands=commands,
                sent=commands,
            )


def found(mindc: Call, day: tuple[Path, Path], *options: object) -> dict[str, Any]:
    said = mindc("whatif", *day, *options, "--json")
    assert said.code == 0, said.err
    data: dict[str, Any] = json.loads(said.out)
    return data


def test_silence_is_what_a_mind_without_the_skill_sends(mindc: Call, day: tuple[Path, Path], tmp_path: Path) -> None:
    bundle = read_bundle(day[1])
    other = tmp_path / "other.mind"
    other.write_text(MIND.replace("influences Seek at glow when", "influences Seek at 0 when"))
    mindc("build", other, "-o", tmp_path / "other.bundle")
    changed = read_bundle(tmp_path / "other.bundle")
    ours, theirs = Engine(bundle.policy, {}), Engine(changed.policy, {})
    apart = []
    for number, row in enumerate(noise(bundle.graph)):
        if number == ANEW:
            ours.reset()
            theirs.reset()
        apart.append(np.abs(ours.tick(row).astype(float) - theirs.tick(row)))
    from_tick = np.array(apart)[49:, 0]
    said = found(mindc, day, "--without", "Seek", "--tick", 50)
    assert said["open_loop"]
    assert said["ticks"] == TICKS
    left = said["commands"]["left_wheel"]
    assert left["ticks"] == np.count_nonzero(from_tick)
    assert left["mean"] == pytest.approx(from_tick.mean())
    assert left["most"] == from_tick.max()
    assert left["most_tick"] == from_tick.argmax() + 50
    first = min(each["tick"] for each in said["differs"] if each["what"] == "command")
    assert first == np.flatnonzero(np.array(apart)[49:].any(axis=1))[0] + 50


def test_what_derives_from_a_replaced_sensor_sees_it(mindc: Call, day: tuple[Path, Path]) -> None:
    said = found(mindc, day, "--sensor", "glow=0.75", "--tick", 20)
    assert {each["name"] for each in said["differs"] if each["what"] == "reading"} == {"glow", "rate"}
    assert said["differs"][0]["tick"] == 20
    assert found(mindc, day, "--set", "mood=1", "--tick", 30)["differs"][0]["name"] == "mood"


def test_a_sensor_reads_what_another_day_had(mindc: Call, day: tuple[Path, Path], tmp_path: Path) -> None:
    path, bundle = tmp_path / "other.rec", day[1]
    graph = read_bundle(bundle).graph
    readings = noise(graph)
    glow = next(sensor for sensor in graph.sensors if sensor.name == "glow").start
    readings[19:, glow] = 0.75
    record(path, bundle, readings)
    said, constant = (found(mindc, day, "--sensor", f"glow={what}", "--tick", 20) for what in (path, 0.75))
    assert said | {"changes": []} == constant | {"changes": []}
    assert found(mindc, day, "--sensor", f"eyes={path}")["differs"] == []
    last = found(mindc, day, "--sensor", f"glow={path}", "--tick", 200)
    assert {(each["tick"], each["now"]) for each in last["differs"] if each["name"] == "glow"} == {(200, 0.75)}
    late = mindc("whatif", *day, "--sensor", f"glow={path}", "--tick", 201)
    assert (late.code, "there is no tick 201" in late.err) == (2, True)


def test_another_mind_sends_what_it_would_for_the_same_readings(
    mindc: Call, day: tuple[Path, Path], tmp_path: Path
) -> None:
    other = tmp_path / "other.mind"
    other.write_text(MIND)
    assert found(mindc, day, "--with", other)["differs"] == []
    other.write_text(MIND.replace("drives left_wheel at 0.2 + mood", "drives left_wheel at 0.3 + mood"))
    said = found(mindc, day, "--with", other, "--tick", 40)
    assert said["differs"][0]["tick"] >= 40
    assert (said["commands"]["left_wheel"]["ticks"] > 0, said["commands"]["right_wheel"]["ticks"]) == (True, 0)
    mindc("build", other, "-o", tmp_path / "other.bundle")
    assert found(mindc, day, "--with", tmp_path / "other.bundle", "--tick", 40)["commands"] == said["commands"]
    other.write_text(MIND.replace("sensor glow", "sensor gleam").replace("glow", "gleam"))
    answer = mindc("whatif", *day, "--with", other)
    assert answer.code == 2
    assert "has no gleam, which other.mind reads" in answer.err


def test_what_another_mind_reads_has_to_be_in_the_recording(
    mindc: Call, day: tuple[Path, Path], tmp_path: Path
) -> None:
    path, other = tmp_path / "blind.rec", tmp_path / "other.mind"
    readings = noise(read_bundle(day[1]).graph)
    readings[:, 2] = np.nan  # the glow
    record(path, day[1], readings, ("eyes",))
    other.write_text(MIND.replace("0.2 + mood", "0.3 + mood"))
    answer = mindc("whatif", path, day[1], "--with", other)
    assert (answer.code, answer.err) == (2, "the recording has no glow, which other.mind reads\n")
    derived = MIND.replace("  reads glow\n", "").replace(" when glow > 0.5", "").replace("1 - glow", "0.4")
    derived = derived.replace("at glow", "at 0.3")
    other.write_text(derived)
    assert "has no glow, which" in mindc("whatif", path, day[1], "--with", other).err
    other.write_text(derived.replace("  reads rate\n", "").replace("at rate", "at 0.6"))
    said = found(mindc, (path, day[1]), "--with", other)
    assert {each["what"] for each in said["differs"]} == {"reading", "influence", "command"}
    assert {each["name"] for each in said["differs"] if each["what"] == "reading"} == {"mood"}


def test_a_mind_that_is_not_taught_cannot_take_over(mindc: Call, day: tuple[Path, Path], tmp_path: Path) -> None:
    other = tmp_path / "other.mind"
    other.write_text(
        MIND.replace("Seek is rule", "Seek is mlp").replace(
            "at glow\n  drives right_wheel at rate", "\n  drives right_wheel"
        )
    )
    answer = mindc("whatif", *day, "--with", other)
    assert (answer.code, answer.out) == (2, "")
    assert answer.err == f"Seek has not been taught\n  mindc train {other} Seek\n"


def test_a_sensor_reads_nothing_that_a_recording_does_not_have(
    mindc: Call, day: tuple[Path, Path], tmp_path: Path
) -> None:
    assert found(mindc, day, "--sensor", f"rate={day[0]}")["differs"] == []
    assert found(mindc, day, "--sensor", f"glow={day[0]}")["differs"] == []
    path, graph = tmp_path / "blind.rec", read_bundle(day[1]).graph
    record(path, day[1], noise(graph), ("eyes",))
    answer = mindc("whatif", *day, "--sensor", f"glow={path}")
    assert answer.err == f"{path} has no readings of glow\n  it has those of eyes\n"
    wide = replace(graph, sensors=(replace(graph.sensors[0], name="glow"), *graph.sensors[2:]))
    with pytest.raises(ChangeError, match=r"^glow has 1 reading in .*day\.rec, and 2 here$"):
        changes_of(Request(sensors=(f"glow={day[0]},{day[1]}",)), wide, "Go")


def test_it_says_that_the_loop_is_open(mindc: Call, day: tuple[Path, Path]) -> None:
    said = mindc("whatif", *day, "--without", "Wander")
    assert said.code == 0
    assert "open loop: the readings are those of the recording" in said.out
    assert "Go in charge, 200 ticks" in said.out
    assert "left_wheel" in said.out


@pytest.mark.parametrize(
    ("options", "code", "said"),
    [
        ((), 2, "nothing is changed"),
        (("--without", "Sek"), 2, "there is no skill called Sek"),
        (("--without", "Seek", "--tick", 201), 2, "has 200 ticks: there is no tick 201"),
        (("--without", "Seek", "--seed", 3), 2, "are of runs, not of recordings"),
    ],
)
def test_what_cannot_be_is_said(
    mindc: Call, day: tuple[Path, Path], options: tuple[object, ...], code: int, said: str
) -> None:
    answer = mindc("whatif", *day, *options)
    assert answer.code == code
    assert said in answer.err


def test_a_recording_alone_is_not_enough(mindc: Call, day: tuple[Path, Path]) -> None:
    answer = mindc("whatif", day[0], "--without", "Seek")
    assert answer.code == 2
    assert "say the bundle that was running" in answer.err


def test_another_bundle_and_what_it_does_not_compute_are_refused(
    mindc: Call, day: tuple[Path, Path], tmp_path: Path
) -> None:
    other = tmp_path / "other.mind"
    other.write_text(MIND.replace("0.9 - mood", "0.8 - mood"))
    mindc("build", other, "-o", tmp_path / "other.bundle")
    answer = mindc("whatif", day[0], tmp_path / "other.bundle", "--without", "Seek")
    assert answer.code == 2
    assert "recorded with another bundle" in answer.err
    path, bundle = tmp_path / "odd.rec", read_bundle(day[1])
    with Recorder(path, About.of(bundle.graph, digest(day[1]), "Go", ("eyes", "glow"))) as recorder:
        recorder.write(tick=0, time=0.0, readings=noise(bundle.graph)[0])
    answer = mindc("whatif", path, day[1], "--without", "Seek")
    assert answer.code == 1
    assert "is not what its bundle computes" in answer.err
