"""`mindc run --video`: a film that OpenCV can read, with as many frames as its speed says."""

from pathlib import Path

import cv2
import numpy as np
import pytest

from mindlang.compiler.compile import load
from mindlang.pictures.canvas import text_width
from mindlang.pictures.film_layout import FILM_HEIGHT, FILM_WIDTH, FilmLayout
from mindlang.pictures.hierarchy_panel import MAX_TEXT_PIXELS, fitting
from mindlang.pictures.influence_flow import Flow, Link
from mindlang.pictures.layout import Layout, Place
from mindlang.pictures.scene import WALL_UNITS
from mindlang.pictures.theme import NIGHT
from mindlang.run.recorded_run import record_run
from mindlang.run.setup import set_up
from tests.calling import RULES, Call


def test_a_film_has_its_frames(mindc: Call, rules: Path) -> None:
    path = rules.with_name("run.mp4")
    said = mindc("run", rules, "--task", "Chase", "--seed", 3, "--video", path, "--speed", 10)
    assert said.code == 0
    assert said.err.endswith(f"{path}: 2 s at 10 times the robot's speed\n")
    video = cv2.VideoCapture(str(path))
    frames = []
    while (read := video.read())[0]:
        frames.append(read[1])
    assert len(frames) == 61  # 1,200 ticks of 1/60 s at 10 times the speed, 30 frames a second, and the last
    assert frames[0].shape == (FILM_HEIGHT, FILM_WIDTH, 3)
    assert np.abs(frames[0].astype(int) - frames[-1]).max() > 50
    assert sorted(file.suffix for file in rules.parent.iterdir()) == [".mind", ".mp4"]


@pytest.mark.parametrize(
    ("ratio", "world", "size"),
    [
        (1.0, (720, 720), (1280, 720)),
        (4 / 3, (720, 540), (1280, 540)),
        (3.0, (1280, 426), (1280, 752)),
        (1 / 3, (240, 720), (1280, 720)),
        (0.01, (240, 720), (1280, 720)),
        (100.0, (1280, 12), (1280, 338)),
    ],
)
def test_the_world_of_a_film_has_the_proportions_of_its_arena(
    ratio: float, world: tuple[int, int], size: tuple[int, int]
) -> None:
    layout = FilmLayout.of(ratio)
    assert (layout.world, (layout.width, layout.height)) == (world, size)
    panel = layout.panel
    assert layout.left <= panel.x <= panel.x + panel.width <= layout.width
    assert layout.top <= panel.y <= panel.y + panel.height <= layout.height
    assert panel.x >= world[0] or panel.y >= world[1]


def test_a_film_of_a_long_arena_has_no_blank_beside_its_world(mindc: Call, rules: Path) -> None:
    rules.write_text(RULES.replace("arena size 40", "arena size 60 20").replace("grid 10 ", "count 2 "))
    path = rules.with_name("run.mp4")
    assert mindc("run", rules, "--task", "Roam", "--seed", 3, "--video", path, "--speed", 20).code == 0
    _, frame = cv2.VideoCapture(str(path)).read()
    wide, high = FilmLayout.of((60 + 4 * WALL_UNITS) / (20 + 4 * WALL_UNITS)).world
    for row, column in ((high // 2, 20), (high // 2, wide - 20), (20, wide // 2), (high - 20, wide // 2)):
        assert np.abs(frame[row, column].astype(int) - NIGHT.wall).max() < 40


def test_a_speed_is_a_number(mindc: Call, rules: Path) -> None:
    said = mindc("run", rules, "--video", rules.with_name("run.mp4"), "--speed", "nan")
    assert (said.code, said.out) == (2, "")
    assert "'nan' is not a number from 0.01 to 1000." in said.err


def test_a_name_and_its_number_fit_into_a_box() -> None:
    place = Place(0.0, 0.0, 100.0, 50.0)
    assert text_width("left_wheel  0.00", fitting("left_wheel  0.00", place)) <= 0.84 * place.width + 1
    assert fitting("left", place) == MAX_TEXT_PIXELS


def test_a_film_that_fails_leaves_the_old_one(mindc: Call, rules: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = rules.with_name("run.mp4")
    path.write_bytes(b"old")
    monkeypatch.setattr("mindlang.pictures.film._frames_in", lambda path: 3)
    said = mindc("run", rules, "--task", "Roam", "--seed", 3, "--video", path, "--speed", 20)
    assert said.code == 2
    assert said.err.endswith(f"{path} cannot be written whole: is the disk full?\n")
    assert path.read_bytes() == b"old"
    assert len(list(rules.parent.iterdir())) == 2


def test_what_flows_adds_up_to_the_influence(rules: Path) -> None:
    found = set_up(str(rules), load(rules), "Roam", None)
    story = record_run(found, found.rollout(), 3)
    flow = Flow(story)
    for tick in (1, story.ticks // 2, story.ticks):
        received = np.zeros(len(story.graph.skills))
        for link, carried in zip(flow.links, flow.at(tick), strict=True):
            if link.target[0] == "skill":
                received[link.target[1]] += carried.transmitted
        received[[skill.name for skill in story.graph.skills].index(found.master)] += 1
        assert received == pytest.approx(story.influence[tick - 1], abs=1e-6)


def test_a_link_that_passes_a_row_goes_between_its_boxes() -> None:
    links = [Link(0, ("skill", 1)), Link(0, ("skill", 2)), Link(1, ("skill", 3)), Link(2, ("actuator", 0))]
    links += [Link(3, ("actuator", 0)), Link(0, ("actuator", 1))]
    layout = Layout.of(links, [0, 1, 2, 3], Place(0.0, 0.0, 400.0, 400.0))
    assert [len(stops) for stops in layout.stops] == [2, 2, 2, 3, 2, 4]
    heights = {sink: place.y for sink, place in layout.boxes.items()}
    assert heights["skill", 0] < heights["skill", 1] == heights["skill", 2] < heights["skill", 3]
    assert heights["actuator", 0] == heights["actuator", 1] == max(heights.values())
    for stop in layout.stops[3][1:-1] + layout.stops[5][1:-1]:
        for box in layout.boxes.values():
            assert abs(stop.x - box.x) > box.width / 2 or abs(stop.y - box.y) > 1
