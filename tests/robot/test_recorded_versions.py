"""Recordings of every version that was ever written are read and computed again for ever.

`recordings/` has one that each of them wrote, and the bundle that was running.
"""

from pathlib import Path

import numpy as np
import pytest
from mindrun.robot.recording import read
from mindrun.robot.replay import replay_recording

from mindlang.view.viewed import Viewed
from mindlang.view.viewed_recording import viewed_recording

FOLDER = Path(__file__).parent / "recordings"
BUNDLE = FOLDER / "ball.bundle"
WITHOUT_WORLD, TICKS, BEGUN_ANEW = ("version1.rec", "version2.rec"), 24, 15


def whole(name: str) -> Viewed:
    """It as it is seen, with all of its rows."""
    viewed = viewed_recording(FOLDER / name, BUNDLE)
    while not viewed.over:
        viewed.grow()
    assert viewed.failed is None
    return viewed


@pytest.mark.parametrize(("name", "ticks"), [*((name, TICKS) for name in WITHOUT_WORLD), ("version3.rec", 40)])
def test_each_is_computed_again_to_the_bit(name: str, ticks: int) -> None:
    found = replay_recording(FOLDER / name, BUNDLE)
    assert (found.ticks, found.differs) == (ticks, None)


def test_both_without_a_world_say_the_same() -> None:
    first, second = (read(FOLDER / name) for name in WITHOUT_WORLD)
    assert first[0] == second[0]
    assert first[0].world is None
    assert first[0].lacks_readings
    rows = np.concatenate([*first[1]])
    assert rows.tobytes() == np.concatenate([*second[1]]).tobytes()
    np.testing.assert_array_equal(rows["tick"], np.arange(TICKS) % BEGUN_ANEW)
    np.testing.assert_allclose(rows["time"], 100 + np.arange(TICKS) / 20)
    assert rows["stopped"].nonzero()[0].tolist() == rows["faults"][:, 0].nonzero()[0].tolist() == [10]
    assert (rows["sent"][10] == 0.5).all()


@pytest.mark.parametrize("name", WITHOUT_WORLD)
def test_what_they_lack_is_computed_where_it_is_seen(name: str) -> None:
    viewed = whole(name)
    readings = viewed.group("readings", np.arange(1, TICKS + 1))
    assert readings[0, 4] == readings[BEGUN_ANEW, 4] == np.float32(0.3)  # the memory as it begins
    sine = 0.5 + np.sin(2 * np.pi * (np.arange(TICKS) % BEGUN_ANEW) / 40) / 2
    np.testing.assert_allclose(readings[:, 3], sine, atol=1e-6)
    assert viewed.about["world"] is None


def test_the_third_has_its_world() -> None:
    about, parts = read(FOLDER / "version3.rec")
    assert about.world
    assert (about.world.task, about.world.seed, about.world.things) == ("Roam", 3, 1)
    rows = np.concatenate([*parts])
    assert rows["world"]["ended"].tolist() == [-3] * 39 + [-1]
    assert len(set(rows["world"]["pose"][:, 0].tolist())) > 30
    viewed = whole("version3.rec")
    ticks = np.arange(1, 41)
    assert viewed.group("robot", ticks).tobytes() == rows["world"]["pose"].tobytes()
    assert len(viewed.about["world"]["boxes"]) == len(about.world.boxes) == 9
