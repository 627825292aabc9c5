"""`mindc run --video`: a film or a GIF with as many images as its speed says, which says how the run ended."""

from dataclasses import replace
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest
from mindrun.graph.graph import Sensor
from PIL import Image as Pillow

from mindlang.compiler.compile import load
from mindlang.pictures.canvas import Canvas, Region, text_width
from mindlang.pictures.film import Film
from mindlang.pictures.film_images import BELOW_SHARE, BESIDE_SHARE, FILM_HEIGHT, FILM_WIDTH, FilmLayout
from mindlang.pictures.panels import (
    MAX_TEXT_PIXELS,
    READING_PIXELS,
    Place,
    box_text_size,
    broken,
    cell_layout,
    fit_name,
    laid_out,
    sensors_read,
)
from mindlang.pictures.path import ending_words
from mindlang.pictures.scene import WALL_UNITS
from mindlang.pictures.theme import NIGHT
from mindlang.run.edge_flow import Link, edge_flows
from mindlang.run.outcome import run_data
from mindlang.run.recorded_run import record_run
from mindlang.run.setup import NO_GENOME, set_up
from tests.calling import RULES, Call


def test_a_film_has_its_frames(mindc: Call, rules: Path) -> None:
    path = rules.with_name("run.mp4")
    said = mindc("run", rules, "--task", "Chase", "--seed", 3, "--video", path, "--speed", 40)
    assert said.code == 0
    assert said.err.endswith(f"{path}: 4 s at 40 times the robot's speed\n")
    video = cv2.VideoCapture(str(path))
    frames = []
    while (read := video.read())[0]:
        frames.append(read[1])
    assert len(frames) == 16 + 90  # 1,200 ticks of 1/60 s at 40 times the speed, 30 frames a second, the last, the end
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
    assert layout.left <= panel.left <= panel.left + panel.width <= layout.width
    assert layout.top <= panel.low <= panel.low + panel.height <= layout.height
    assert panel.left >= world[0] or panel.low >= world[1]


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
    assert text_width("left_wheel  0.00", box_text_size(["left_wheel  0.00"], place)) <= 0.84 * place.width + 1
    assert box_text_size(["left"], place) == MAX_TEXT_PIXELS
    assert box_text_size(["left"], replace(place, height=30.0)) < MAX_TEXT_PIXELS


@pytest.mark.parametrize(
    ("name", "lines"),
    [
        ("Go", ["Go"]),
        ("GoToDropZone+Avoid", ["GoToDropZone", "+Avoid"]),
        ("go_to_drop_zone", ["go_to_", "drop_zone"]),
        ("CollectWithPower", ["Collect", "WithPower"]),
        ("wordsthatcannotbebroken", ["wordsthatcannotbebroken"]),
    ],
)
def test_a_name_that_is_too_wide_has_two_lines(name: str, lines: list[str]) -> None:
    assert broken(name, 80.0) == lines
    assert broken(name, 1000.0) == [name]


def test_a_film_that_fails_leaves_the_old_one(mindc: Call, rules: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = rules.with_name("run.mp4")
    path.write_bytes(b"old")
    monkeypatch.setattr("mindlang.pictures.film._images_in", lambda path: 3)
    said = mindc("run", rules, "--task", "Roam", "--seed", 3, "--video", path, "--speed", 100)
    assert said.code == 2
    assert said.err.endswith(f"{path} cannot be written: it is not whole: is the disk full?\n")
    assert path.read_bytes() == b"old"
    assert len(list(rules.parent.iterdir())) == 2


def filmed(rules: Path, task: str, speed: float, suffix: str = ".mp4") -> Film:
    """The film of a run of seed 3."""
    setup = set_up(str(rules), load(rules), task, None)
    rollout = setup.rollout()
    outcome = run_data(setup.task, rollout.score(NO_GENOME, [3]))
    return Film(
        record_run(setup, rollout, 3), {"task": task, "master": setup.master, "seed": 3} | outcome, speed, suffix
    )


def words(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """A list to which every text is added that is drawn from now on."""
    said: list[str] = []

    def text(canvas: Canvas, x: float, y: float, text: str, *rest: Any, **how: Any) -> None:
        said.append(text)

    monkeypatch.setattr(Canvas, "text", text)
    return said


@pytest.mark.parametrize("hall", ["arena size 40", "arena size 60 6"])
def test_the_last_images_say_how_the_run_ended(rules: Path, monkeypatch: pytest.MonkeyPatch, hall: str) -> None:
    """In a world that is too low for a banner it stands beside the name of the task."""
    count = "grid 10 size 2 to 3" if hall.endswith("40") else "count 1 size 1"
    text = RULES.replace("arena size 40", hall).replace("grid 10 size 2 to 3", count)
    rules.write_text(text.replace("at 0.2", "at 0"))
    film = filmed(rules, "Roam", 10.0)
    assert film.run.ticks < film.run.task.ticks
    said = words(monkeypatch)
    before = film[film.moving - 1]
    assert "ended by collision" not in said
    after = film[film.moving]
    assert "ended by collision" in said
    assert np.abs(before.astype(int) - after).max() > 50
    assert film[len(film) - 1] is after
    assert len(film) - film.moving == 3 * film.format.fps


@pytest.mark.parametrize(
    ("outcome", "told"),
    [
        ({"ended_by": None}, "lasted its time"),
        ({"ended_by": "collision"}, "ended by collision"),
        ({"ended_by": "reach of ball", "succeeded": True}, "success: reach of ball"),
        ({"ended_by": "collision", "succeeded": False}, "ended by collision"),
        ({"ended_by": None, "succeeded": True}, "lasted its time, a success"),
    ],
)
def test_the_words_of_an_end(outcome: dict[str, Any], told: str) -> None:
    assert ending_words(outcome) == told


def test_a_gif_holds_the_run_and_its_end(mindc: Call, rules: Path) -> None:
    rules.write_text(RULES.replace("lasts 1200 ticks", "lasts 60 ticks"))
    path = rules.with_name("run.GIF")
    said = mindc("run", rules, "--task", "Chase", "--seed", 3, "--video", path)
    assert said.code == 0
    assert said.err.endswith(f"{path}: 4 s at 1 times the robot's speed\n")
    image = Pillow.open(path)
    assert image.size == (FILM_WIDTH * 3 // 4, FILM_HEIGHT * 3 // 4)
    seconds = 0.0
    for number in range(image.n_frames):  # images that are the same are one that lasts longer
        image.seek(number)
        seconds += image.info["duration"] / 1000
    assert seconds == pytest.approx(1.1 + 3, abs=0.15)
    assert image.info["duration"] == 3000
    assert path.stat().st_size < 5_000_000
    assert sorted(file.suffix for file in rules.parent.iterdir()) == [".GIF", ".mind"]


def test_a_gif_that_would_be_too_large_is_refused(mindc: Call, rules: Path) -> None:
    """And at the speed that the hint says it is not."""
    path = rules.with_name("run.gif")
    said = mindc("run", rules, "--task", "Chase", "--seed", 3, "--video", path, "--speed", 0.1)
    assert said.code == 2
    message, hint = said.err.splitlines()[-2:]
    assert message == f"{path} would have 2,030 images, and a .gif of more than 600 is too large"
    assert hint == "  --speed 0.4 or faster, or a film: run.mp4"
    assert not path.exists()
    assert len(filmed(rules, "Chase", 0.4, ".gif")) <= 600


def test_a_film_shows_the_sensors_that_are_read(rules: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    more = "sensor blind is bearing of ball\n\nskill Chase"
    rules.write_text(RULES.replace("skill Chase", more, 1))
    film = filmed(rules, "Roam", 10.0)
    assert [sensor.name for sensor in sensors_read(film.run)] == ["ball_bearing", "feeler"]
    said = words(monkeypatch)
    film[0]
    assert {"ball_bearing", "feeler", f"{film.run.readings[0, 0]:.2f}"} <= set(said)
    assert "blind" not in said


@pytest.mark.parametrize("ratio", [0.01, 1 / 3, 1.0, 4 / 3, 3.0, 100.0])
@pytest.mark.parametrize("count", [0, 1, 7, 20, 100, 1000])
def test_as_many_readings_as_fit(rules: Path, ratio: float, count: int) -> None:
    """Every one within its room, none over another, and those that are left out are counted."""
    layout = FilmLayout.of(ratio)
    hierarchy, room = layout.divided(count)
    sensor = load(rules).graph.sensors[0]  # type: ignore[union-attr]
    sensors = [Sensor(f"s{number}", sensor.kind, number, 1) for number in range(count)]
    shown, cells, left_out = cell_layout(sensors, room)
    assert len(shown) + left_out == count
    assert len(cells) == len(shown) + (left_out > 0)
    assert hierarchy.width >= (1 - BESIDE_SHARE) * layout.panel.width - 1
    assert hierarchy.height >= (1 - BELOW_SHARE) * layout.panel.height - 1
    for cell in cells:
        assert room.left <= cell.left < cell.left + cell.width <= room.left + room.width
        assert room.low <= cell.low - cell.height / 2 < cell.low + cell.height / 2 <= room.low + room.height
    assert len({(cell.left, cell.low) for cell in cells}) == len(cells)
    if count:
        assert shown
    if count == 1000:
        assert left_out


def test_a_long_name_of_a_sensor_is_cut() -> None:
    assert fit_name("eye", 80.0) == ("eye", READING_PIXELS)
    text, size = fit_name("a_name_that_nobody_should_give_to_a_sensor", 80.0)
    assert text.startswith("a_name_")
    assert text.endswith("..")
    assert text_width(text, size) <= 80.0


def test_what_flows_adds_up_to_the_influence(rules: Path) -> None:
    found = set_up(str(rules), load(rules), "Roam", None)
    story = record_run(found, found.rollout(), 3)
    flows = edge_flows(found.ready.policy, {}, found.master, story)
    for tick in (1, story.ticks // 2, story.ticks):
        received = np.zeros(len(story.graph.skills))
        for link, transmitted in zip(flows.links, flows.flow_at(range(tick - 1, tick)).transmitted[0], strict=True):
            if link.target[0] == "skill":
                received[link.target[1]] += transmitted
        received[[skill.name for skill in story.graph.skills].index(found.master)] += 1
        assert received == pytest.approx(story.influence[tick - 1], abs=1e-6)


def test_a_link_that_passes_a_row_goes_between_its_boxes() -> None:
    links = [Link(0, ("skill", 1)), Link(0, ("skill", 2)), Link(1, ("skill", 3)), Link(2, ("actuator", 0))]
    links += [Link(3, ("actuator", 0)), Link(0, ("actuator", 1))]
    boxes, stops = laid_out(links, [0, 1, 2, 3], Region(0.0, 0.0, 400.0, 400.0))
    assert [len(each) for each in stops] == [2, 2, 2, 3, 2, 4]
    heights = {sink: place.y for sink, place in boxes.items()}
    assert heights["skill", 0] < heights["skill", 1] == heights["skill", 2] < heights["skill", 3]
    assert heights["actuator", 0] == heights["actuator", 1] == max(heights.values())
    for stop in stops[3][1:-1] + stops[5][1:-1]:
        for box in boxes.values():
            assert abs(stop.x - box.x) > box.width / 2 or abs(stop.y - box.y) > 1
