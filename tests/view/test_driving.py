"""Runs that a hand drives: what is said counts in the next tick, is recorded, and is the same when replayed."""

from pathlib import Path
from time import monotonic, sleep

import numpy as np
import pytest
from mindrun.engine.changes import ChangedEngine
from mindrun.graph.bundle import digest, write_bundle
from mindrun.robot.hand import HAND_SECONDS, hand_on
from mindrun.robot.recording import read
from mindrun.robot.replay import replay_recording
from mindrun.sim.commanded_lanes import CommandedWorld

from mindlang.compiler.compile import load
from mindlang.run.recording import bundle_without_robot, running_bundle
from mindlang.run.setup import set_up
from mindlang.view.driven_run import LOOK_SECONDS, DrivenRuns
from mindlang.view.messages import RefusedError, SayHand, message
from mindlang.view.viewed_recording import viewed_recording
from tests.robot.faults import Clock
from tests.view.serving import prepared, served

HELD = ("left_wheel", "Turn")
UNTAUGHT = """tick 1/20 s
master Go
body Rover is disc
actuator left is wheel side left neutral 0.5
actuator right is wheel side right neutral 0.5
sensor b is bearing of ball
skill Go is mlp
  reads b
  drives left
  drives right
task Go in plain
  contains ball is item size 1
  lasts 300 ticks
  rewards 10 on reach of ball
"""


class Driver:
    """A hand at runs of a task, by a clock that goes when somebody looks at it."""

    def __init__(self, path: Path, task: str, held: tuple[str, ...], record: Path) -> None:
        self.setup = prepared(path, task)
        clock = Clock()
        self.hand = hand_on(self.setup.ready.policy.graph, self.setup.master, held, clock)
        self.told: list[str] = []
        self.runs = DrivenRuns(self.setup, self.hand, {}, clock, clock.sleep, record, self.told.append)


@pytest.mark.parametrize(
    ("text", "is_one"),
    [
        ('{"say": "drive", "values": [0, 0.25, 1]}', True),
        ('{"say": "drive", "values": [1.01]}', False),
        ('{"say": "drive", "values": [-0.01]}', False),
        ('{"say": "drive", "values": [NaN]}', False),
        ('{"say": "drive", "values": []}', False),
        ('{"say": "layout", "seed": "18446744073709551615"}', True),
        ('{"say": "layout", "seed": "18446744073709551616"}', False),
    ],
)
def test_a_message_has_numbers_that_can_be_commanded(text: str, is_one: bool) -> None:
    if is_one:
        assert not isinstance(message(text), SayHand) or message(text) == SayHand((0, 0.25, 1))
    else:
        with pytest.raises(RefusedError):
            message(text)


@pytest.mark.parametrize("held", [("left_wheel", "right_wheel"), HELD, ("Turn",)])
def test_what_a_hand_says_counts_from_the_next_tick_on_and_replays_to_the_bit(
    path: Path, tmp_path: Path, held: tuple[str, ...]
) -> None:
    driver, said, rng = Driver(path, "Roam", held, tmp_path / "drive.rec"), [], np.random.default_rng(1)
    viewed = driver.runs.begun(5)
    viewed.grow()
    for _ in range(40):
        now = rng.random(len(held), np.float32).tolist()
        for name, value in zip(held, now, strict=True):
            driver.hand.say(name, value)
        before = viewed.known
        viewed.grow()
        said += [now] * (viewed.known - before)
    driver.runs.close()
    about, parts = read(tmp_path / "drive.rec")
    rows = np.concatenate(list(parts))
    assert about.by_hand == held
    assert driver.told == [f"{tmp_path / 'drive.rec'}: {len(rows)} ticks"]
    assert len(rows) == viewed.known > 30
    for place, name in enumerate(held):
        column = (
            rows["influence"][:, about.skills.index(name)]
            if name in about.skills
            else rows["sent"][:, about.actuators.index(name)]
        )
        assert column.tolist() == [each[place] for each in said]
    free = [place for place, name in enumerate(about.actuators) if name not in held]
    assert (rows["sent"][:, free] == rows["commands"][:, free]).all()
    # The mind beside the hand, and the world under it
    bundle = tmp_path / "roam.bundle"
    write_bundle(bundle, bundle_without_robot(driver.setup.ready, driver.setup.folder))
    assert about.bundle == digest(bundle)
    assert replay_recording(tmp_path / "drive.rec", bundle).differs is None
    world = CommandedWorld(driver.setup.ready.policy.graph, "Roam", 5, about.master)
    for row in rows:
        assert np.array_equal(world.readings()[:3], row["readings"][:3], equal_nan=True)
        world.step(row["sent"])
        assert world.pose == tuple(row["world"]["pose"])
    # A changed row is one that is found
    engine = ChangedEngine(driver.setup.ready.policy, driver.setup.folder, about.master)
    if "Turn" in held:
        assert engine.tick(rows["readings"][0]).tobytes() != rows["commands"][0].tobytes()


def test_a_world_stands_still_where_the_hand_has_let_go(path: Path, tmp_path: Path) -> None:
    driver = Driver(path, "Chase", ("left_wheel", "right_wheel"), tmp_path / "drive.rec")
    viewed = driver.runs.begun(1)
    for _ in range(10):
        viewed.grow()
    assert viewed.known == 0
    assert not (tmp_path / "drive.rec").exists()
    for name in driver.hand.names:
        driver.hand.say(name, 0.7)
    for _ in range(int(3 * HAND_SECONDS / LOOK_SECONDS)):
        viewed.grow()
    driven, ticks = viewed.known, int(HAND_SECONDS * 60)
    assert ticks - 2 <= driven <= ticks + 2
    driver.hand.say("left_wheel", 0.7)  # but nothing of the other
    viewed.grow()
    assert viewed.known == driven
    again = driver.runs.begun(2)  # what the run before has is complete, and not written over
    for name in driver.hand.names:
        driver.hand.say(name, 0.7)
    again.grow()
    again.grow()
    viewed.grow()
    assert viewed.known == driven
    driver.runs.close()
    about, parts = read(tmp_path / "drive-2.rec")
    assert about.world
    assert (about.world.seed, len(np.concatenate(list(parts)))) == (2, again.known)


def test_the_first_page_drives_and_asks_for_another_layout(path: Path, tmp_path: Path) -> None:
    setup = prepared(path, "Chase")
    hand = hand_on(setup.ready.policy.graph, setup.master, ("left_wheel", "right_wheel"))
    runs = DrivenRuns(setup, hand, {}, monotonic, sleep)
    with served(runs.begun(3)) as view, view.viewer() as first, view.viewer() as second:
        about = first.hear("about")
        assert (about["seed"], about["source"], second.hear("about")["drive"]) == ("3", "driven", [])
        assert [(each["name"], each["neutral"], each["role"]) for each in about["drive"]] == [
            ("left_wheel", 0.5, "left"),
            ("right_wheel", 0.5, "right"),
        ]
        second.say(say="drive", values=[1, 1])
        assert "somebody else" in second.hear("refused")["why"]
        first.say(say="drive", values=[1])
        assert "that is not 1" in first.hear("refused")["why"]
        first.say(say="drive", values=[1, 0.5])
        while not first.hear("ticks")["known"]:
            pass
        first.say(say="layout", seed="8")
        assert first.hear("about")["seed"] == "8"


def test_a_skill_that_was_not_taught_can_be_shown(tmp_path: Path) -> None:
    path = tmp_path / "go.mind"
    path.write_text(UNTAUGHT, encoding="utf-8")
    setup = set_up(str(path), load(path), "Go", None, untaught=True)
    clock = Clock()
    hand = hand_on(setup.ready.policy.graph, "Go", ("left", "right"), clock)
    runs = DrivenRuns(setup, hand, {}, clock, clock.sleep, tmp_path / "go.rec")
    viewed = runs.begun(1)
    for name in hand.names:
        hand.say(name, 1.0)
    for _ in range(5):
        viewed.grow()
    runs.close()
    about, parts = read(tmp_path / "go.rec")
    rows = np.concatenate(list(parts))
    assert (rows["commands"] == 0).all()
    assert (rows["sent"] == 1.0).all()
    seen = viewed_recording(tmp_path / "go.rec", path)  # with the source alone
    while not seen.over:
        seen.grow()
    assert seen.known == len(rows)
    assert not running_bundle(path, about).policy.weights["Go"].any()
