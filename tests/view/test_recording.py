"""A robot's recording, seen: its rows as they were written, and what the robot computed beside them."""

from pathlib import Path

import numpy as np
import pytest
from mindrun.engine.engine import Engine
from mindrun.graph.bundle import Bundle, digest, write_bundle
from mindrun.graph.policy import Policy
from mindrun.robot.recording import About, Recorder, RecordingError

from mindlang.run.edge_flow import BLOCK_ROWS
from mindlang.view.messages import AskShares
from mindlang.view.session import command_shares
from mindlang.view.viewed import Viewed
from mindlang.view.viewed_recording import viewed_recording
from tests.calling import Call
from tests.sim.minds import compile_text
from tests.view.serving import served, unpacked

MIND = """
tick 1/20 s
master Roam
body Robot is disc
actuator left_wheel is wheel side left neutral 0.5
actuator right_wheel is wheel side right neutral 0.5
sensor sense is range_finder at 0 120 240 deg range 12
sensor pulse is sine period 2 s
memory mood is cell decay 0.9 start 0.3
skill Turn is rule
  reads pulse
  drives left_wheel at pulse
  drives right_wheel at 0.1
skill Roam is elman width 3
  reads sense
  reads mood
  influences Turn
  drives right_wheel at 0.8
  drives mood at 0.7
"""
TICKS, BEGUN_ANEW = 120, 70


def mind(text: str) -> Policy:
    """A mind with drawn weights."""
    graph = compile_text(text)
    drawn = {
        skill.name: skill.function.draw(len(skill.inputs), skill.outputs, 1, np.random.default_rng(2))[0]
        for skill in graph.skills
        if skill.function.learns
    }
    return Policy(graph, drawn)


@pytest.fixture(scope="module")
def day(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, Path, list[tuple[np.ndarray, np.ndarray]]]:
    """A recording, its bundle, and what the engine read and thought in each tick."""
    folder = tmp_path_factory.mktemp("day")
    rec, bundle = folder / "day.rec", folder / "ball.bundle"
    policy, rng, found = mind(MIND), np.random.default_rng(1), []
    graph, engine = policy.graph, Engine(policy)
    write_bundle(bundle, Bundle(policy, {}))
    with Recorder(rec, About.of(graph, digest(bundle), graph.master, ("sense",))) as recorder:
        for number in range(TICKS):
            tick = number % BEGUN_ANEW
            if tick == 0:
                engine.reset()
            readings = np.full(graph.width, np.nan, np.float32)
            readings[:3] = rng.random(3) if number % 10 else np.nan
            commands = engine.tick(readings)
            stopped = number % 10 == 0
            recorder.write(
                tick=tick, time=100 + number / 20, stopped=stopped, armed=1, faults=[2 * stopped], ages=[0.0],
                readings=engine.readings, influence=engine.influence, commands=commands, sent=commands,
            )  # fmt: skip
            found.append((engine.readings.copy(), commands))
    return rec, bundle, found


def whole(viewed: Viewed) -> Viewed:
    """All of its rows known."""
    while not viewed.over:
        viewed.grow()
    return viewed


def test_rows_are_what_the_robot_read_and_thought(day: tuple[Path, Path, list[tuple[np.ndarray, np.ndarray]]]) -> None:
    rec, bundle, found = day
    with served(viewed_recording(rec, bundle)) as view, view.viewer() as viewer:
        about = viewer.hear("about")
        assert (about["source"], about["of_ticks"], about["world"]) == ("recording", TICKS, None)
        told = viewer.run(TICKS + 1)
        assert (told["known"], told["over"]) == (TICKS, True)
        data = viewer.frame(say="rows", **{"from": 0, "to": 200})
        viewer.say(say="change", tick=3, what="reading", column=about["nodes"][0]["columns"][0], value=0.5)
        assert "recording" in viewer.hear("refused")["why"]
    _, _, ticks, doubles, singles = unpacked(data, about["doubles"], about["singles"])
    assert ticks.tolist() == [*range(TICKS + 1)]
    np.testing.assert_allclose(doubles[1:, 0], np.arange(TICKS) / 20, atol=1e-9)
    for group, place in (("readings", 0), ("commands", 1), ("sent", 1)):
        _, first, count = about["columns"][group]
        expected = np.array([row[place] for row in found], np.float32)
        assert singles[1:, first : first + count].tobytes() == expected.tobytes()


def test_who_asks_for_its_last_tick_hears_that_it_is_over(day: tuple[Path, Path, object]) -> None:
    viewed = viewed_recording(day[0], day[1])
    viewed.grow()
    with served(viewed) as view, view.viewer() as viewer:
        viewer.say(say="run", to=TICKS)
        while not (told := viewer.hear("ticks"))["over"]:
            assert told["known"] <= TICKS
        assert (told["known"], told["failed"]) == (TICKS, None)


def test_what_happened_is_said(day: tuple[Path, Path, list[tuple[np.ndarray, np.ndarray]]]) -> None:
    viewed = whole(viewed_recording(*day[:2]))
    names = [event["text"] for event in viewed.about["events"]]
    assert names == ["stopped", "began anew", "fault of sense"]
    expected = [(number + 1, event) for number in range(0, TICKS, 10) for event in (0, 2)]
    assert sorted(viewed.happened) == sorted([*expected, (BEGUN_ANEW + 1, 1)])


def test_flow_is_of_the_memory_that_the_robot_had(day: tuple[Path, Path, list[tuple[np.ndarray, np.ndarray]]]) -> None:
    """Wherever one jumps: a network that remembers is computed from where it was begun."""
    viewed = whole(viewed_recording(*day[:2]))
    everything = viewed.singles(np.arange(TICKS + 1))
    for tick in (TICKS, 3, BEGUN_ANEW + 1, BEGUN_ANEW, 1, 0):
        again = whole(viewed_recording(*day[:2])).singles(np.array([tick]))
        assert again.tobytes() == everything[tick : tick + 1].tobytes()
    flow = viewed.columns["flow"]
    texts = [viewed.about["nodes"][edge["to"]]["name"] for edge in viewed.about["edges"]]
    to_turn = everything[1:, flow.first + texts.index("Turn")]
    turn = viewed.group("influence", np.arange(1, TICKS + 1))[:, 1]
    assert to_turn.tobytes() == turn.tobytes()
    assert 0 < turn.max() <= 1


def test_what_a_network_that_remembers_has_sent_counts_as_kept(day: tuple[Path, Path, list[object]]) -> None:
    viewed = whole(viewed_recording(*day[:2]))
    before = viewed.kept_bytes
    viewed.singles(np.array([TICKS]))
    assert viewed.kept_bytes == before + 4 * 3 * BLOCK_ROWS
    viewed.singles(np.arange(TICKS))
    assert viewed.kept_bytes == before + 4 * 3 * BLOCK_ROWS


def test_why_is_of_the_memory_that_the_robot_had(day: tuple[Path, Path, list[tuple[np.ndarray, np.ndarray]]]) -> None:
    viewed = whole(viewed_recording(*day[:2]))
    for tick in (TICKS, 4, BEGUN_ANEW + 2):
        found = command_shares(viewed, AskShares(tick=tick, actuator=0))
        assert np.float32(found["command"]) == day[2][tick - 1][1][0]
        [to_turn] = [path for path in found["paths"] if len(path["path"]) == 3]
        assert np.float32(to_turn["influence"]) == viewed.group("influence", np.array([tick]))[0, 1]


def test_a_damaged_row_ends_it_with_a_sentence(day: tuple[Path, Path, object], tmp_path: Path) -> None:
    rec, bundle, _ = day
    data = bytearray(rec.read_bytes())
    data[-10] ^= 1
    (tmp_path / "day.rec").write_bytes(data)
    viewed = whole(viewed_recording(tmp_path / "day.rec", bundle))
    assert viewed.failed is not None
    assert "damaged at row" in viewed.failed


def test_another_bundle_is_refused(day: tuple[Path, Path, object], tmp_path: Path) -> None:
    write_bundle(tmp_path / "other.bundle", Bundle(mind(MIND.replace("0.8", "0.6")), {}))
    with pytest.raises(RecordingError, match="another bundle"):
        viewed_recording(day[0], tmp_path / "other.bundle")


def test_what_is_wrong_on_the_command_line(day: tuple[Path, Path, object], mindc: Call, tmp_path: Path) -> None:
    rec, bundle, _ = day
    said = mindc("view", rec)
    assert said.code == 2
    assert "with the bundle" in said.err
    assert mindc("view", rec, bundle, "--seed", 3).code == 2
    missing = mindc("view", tmp_path / "no.rec", bundle)
    assert (missing.code, missing.out) == (2, "")
    assert "no.rec" in missing.err
