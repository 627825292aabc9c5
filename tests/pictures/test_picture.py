"""`mindc run --picture`: what its pixels show, and paths that cannot be written."""

import json
from dataclasses import replace
from itertools import pairwise
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest
from mindrun.graph.graph import Thing
from mindrun.kinds.things.thing import Item, Zone

from mindlang.compiler.compile import load
from mindlang.pictures.canvas import Canvas, Image, Viewport, blank
from mindlang.pictures.path import MARK_PIXELS, NOBODY, draw_former, strokes_of
from mindlang.pictures.path import Path as Path_
from mindlang.pictures.picture import (
    BOTTOM_PIXELS,
    LEGEND_LINES,
    MIN_TEXT_PIXELS,
    PICTURE_PIXELS,
    SIDE_PIXELS,
    TOP_PIXELS,
    legend_layout,
    picture,
    view_of,
)
from mindlang.pictures.scene import thing_colours
from mindlang.pictures.theme import NIGHT, PAPER, Theme, mixed
from mindlang.run.outcome import run_data
from mindlang.run.recorded_run import RecordedRun, record_run
from mindlang.run.setup import NO_GENOME, set_up
from tests.calling import RULES, Call


def told(file: Path, task: str, seed: int = 3) -> tuple[RecordedRun, Image]:
    """A story and its picture."""
    found = set_up(str(file), load(file), task, None)
    rollout = found.rollout()
    outcome = run_data(found.task, rollout.score(NO_GENOME, [seed]))
    story = record_run(found, rollout, seed)
    return story, picture(story, {"task": task, "master": found.master, "seed": seed} | outcome)


def pixel(story: RecordedRun, image: Image, x: float, y: float) -> np.ndarray:
    """The colour at a place of the world."""
    view = view_of(story, PICTURE_PIXELS - 2 * SIDE_PIXELS, PICTURE_PIXELS - TOP_PIXELS - BOTTOM_PIXELS)
    column, row = SIDE_PIXELS + (x - view.left) * view.scale, TOP_PIXELS + (view.top - y) * view.scale
    return image[round(row), round(column)].astype(int)


def near(found: np.ndarray, colour: tuple[int, int, int]) -> bool:
    return bool(np.abs(found - colour).max() < 40)


def test_the_robot_stands_where_the_run_ended(rules: Path) -> None:
    story, image = told(rules, "Chase")
    assert image.shape == (PICTURE_PIXELS, PICTURE_PIXELS, 3)
    x, y, angle = story.body[-1]
    assert near(pixel(story, image, x - 0.6 * np.cos(angle), y - 0.6 * np.sin(angle)), PAPER.robot)
    assert near(pixel(story, image, *story.things[-1, 0, :2]), PAPER.things["item"][0])


def test_obstacles_walls_and_the_start_are_there(rules: Path) -> None:
    story, image = told(rules, "Roam")
    assert len(story.boxes) == 9
    shown = [near(pixel(story, image, x, y), PAPER.rock) for x, y, *_ in story.boxes]
    assert sum(shown) >= 8  # the robot may stand against one
    assert near(pixel(story, image, 20.4, 7.0), PAPER.wall)


def test_things_of_a_kind_are_told_apart(rules: Path) -> None:
    """Each has a colour of its own, and its name stands below it."""
    names = ("ball", "cube", "here", "there")
    kinds = ("item size 2", "item size 2", "zone size 6", "zone size 6")
    more = "".join(f"  contains {name} is {kind}\n" for name, kind in zip(names[1:], kinds[1:], strict=True))
    rules.write_text(RULES.replace("  lasts 600 ticks\n", f"{more}  lasts 1 ticks\n"))
    story, image = told(rules, "Roam")
    assert [thing.name for thing in story.contents] == list(names)
    colours = thing_colours(story.contents, PAPER)
    assert len(set(colours)) == 4
    pixels = [pixel(story, image, x, y) for x, y, _ in story.things[-1]]
    for found, colour, kind in zip(pixels, colours, kinds, strict=True):
        assert near(found, colour if "item" in kind else mixed(PAPER.floor, colour, 0.22))
    for x, y, size in story.things[-1]:
        below = [pixel(story, image, x + aside / 10, y - size / 2 - 0.55) for aside in range(-10, 10)]
        assert any(near(found, PAPER.ink) for found in below)


def test_an_eye_that_sees_nothing_draws_no_ray_through_a_wall(rules: Path) -> None:
    """Only what it looks for ends a ray: whether something hides that, a reading of 1 does not say."""
    eye = "sensor camera is eye of ball at 0 deg range 30\n\nskill Chase"
    wall = "  contains fence is wall from 3 -20 to 3 20\n  contains ball is item size 0.8 at 10 0\n"
    task = f"  starts at 0 0 facing 0 deg\n  lasts 1 ticks\n{wall}"
    told_of = RULES.replace("skill Chase", eye, 1).replace("reads feeler", "reads feeler\n  reads camera")
    head, _, _ = told_of.partition("task Roam")
    for ball_at, is_seen in ((10, False), (-10, False), (1.8, True)):
        rules.write_text(f"{head}task Roam in arena size 40\n{task.replace('10 0', f'{ball_at} 0')}")
        story, image = told(rules, "Roam")
        assert bool(story.readings[0, 4] < 1) == is_seen
        assert near(pixel(story, image, 5.0, 0.0), PAPER.floor)


def test_the_way_of_a_ball_that_was_pushed_is_drawn(rules: Path) -> None:
    """From where it lay, which is drawn as well, to where it has rolled."""
    head, _, _ = RULES.partition("task Roam")
    push = "  starts at -5 0 facing 0 deg\n  contains ball is ball size 2 at 0 0\n  lasts 200 ticks\n"
    straight = head.replace("at 3 * ball_bearing - 0.7", "at 1").replace("at 2.3 - 3 * ball_bearing", "at 1")
    rules.write_text(straight.replace("influences Turn at 0.2", "influences Turn at 0").partition("task Chase")[0])
    rules.write_text(f"{rules.read_text()}task Roam in arena size 40\n{push}")
    story, _ = told(rules, "Roam")
    [way] = story.stretches(0)
    assert way[0, 0] == 0.0
    assert way[-1, 0] > 2.0
    drawn: list[np.ndarray] = []
    discs: list[tuple[float, float]] = []

    class Spy(Canvas):
        """Lines and discs as they are asked for."""

        def line(self, points: Any, *rest: Any, **how: Any) -> None:
            drawn.append(np.array(points))

        def disc(self, x: float, y: float, *rest: Any, **how: Any) -> None:
            discs.append((x, y))

    draw_former(Spy(blank(100, 100, PAPER.page), Viewport(0.0, 0.0, 1.0)), story)
    assert any(np.array_equal(each, way) for each in drawn)
    assert set(discs) == {(0.0, 0.0)}


def test_many_things_of_one_name_have_it_once(rules: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """In the legend always, in the world where they are many."""
    said: list[str] = []

    def text(canvas: Canvas, x: float, y: float, text: str, *rest: Any, **how: Any) -> None:
        said.append(text)

    monkeypatch.setattr(Canvas, "text", text)
    for count, times in ((3, 1 + 3), (20, 1 + 1)):
        said.clear()
        more = f"  contains cube is item size 1 count {count}\n  lasts 1 ticks\n"
        rules.write_text(RULES.replace("  lasts 600 ticks\n", more))
        told(rules, "Roam")
        assert said.count("cube") == times


@pytest.mark.parametrize("theme", [PAPER, NIGHT], ids=["paper", "night"])
def test_a_thing_that_is_called_by_its_colour_has_it(theme: Theme) -> None:
    names = {"red": Item(), "big_blue_bin": Zone(), "reddish": Item(), "blue": Item()}
    red, bin_, reddish, blue = thing_colours([Thing(name, kind) for name, kind in names.items()], theme)
    assert (red, blue, bin_) == (theme.named["red"], theme.named["blue"], theme.named["blue"])
    assert reddish == theme.things["item"][0]


def test_a_walker_stands_where_it_has_come_to_at_the_end_of_its_way(rules: Path) -> None:
    """However fast it is, its way is one line and no row of places where it has been before."""
    more = "  contains cat is walker size 2 speed 120 along 15 15 to 15 -15\n  lasts 10 ticks\n"
    rules.write_text(RULES.replace("  lasts 600 ticks\n", more))
    story, image = told(rules, "Roam")
    cat = [thing.name for thing in story.contents].index("cat")
    assert story.things[-1, cat].tolist() == pytest.approx([15, 15 - 10 * 120 * story.graph.tick, 2])
    assert len(story.former(cat)) == 0
    (stretch,) = story.stretches(cat)
    assert len(stretch) == 11
    colour = PAPER.things["walker"][0]
    assert near(pixel(story, image, *story.things[-1, cat, :2]), colour)
    beside = [pixel(story, image, 15 + aside / 20, 13) for aside in range(-10, 11)]
    assert any(near(found, mixed(PAPER.floor, colour, 0.5)) for found in beside)


def test_ticks_in_which_nobody_has_influence_are_nobodys(rules: Path) -> None:
    """And no path of ten skills looks like another one."""
    run, _ = told(rules, "Roam")
    movers = [*run.movers.values()]
    silent = run.influence.copy()
    silent[: run.ticks // 2, movers] = 0.0
    path = Path_.of(replace(run, influence=silent), PAPER)
    assert path.shares[NOBODY] == pytest.approx(0.5, abs=0.01)
    assert sum(path.shares.values()) == pytest.approx(1.0)
    assert len({*strokes_of(PAPER, 10)}) == 10


def test_more_things_than_colours_begin_again() -> None:
    colours = thing_colours([Thing(f"thing_{i}", Item()) for i in range(9)], PAPER)
    assert colours[8] == colours[4] == colours[0] == PAPER.things["item"][0]


def test_a_collision_that_ends_the_run_lies_over_the_robot(rules: Path) -> None:
    rules.write_text(RULES.replace("influences Turn at 0.2", "influences Turn at 0"))
    story, image = told(rules, "Roam")
    assert list(story.collisions) == [story.ticks]
    assert near(pixel(story, image, *story.body[-1, :2]), PAPER.crash)


@pytest.mark.parametrize(("task", "said"), [("Roam", "ended by collision"), ("Chase", "lasted its time")])
def test_the_end_is_marked_and_said(rules: Path, monkeypatch: pytest.MonkeyPatch, task: str, said: str) -> None:
    """Two rings around the robot, the words at them, and the mark in the legend."""
    rules.write_text(RULES.replace("influences Turn at 0.2", "influences Turn at 0"))
    story, image = told(rules, task)
    x, y, angle = story.body[-1]
    view = view_of(story, PICTURE_PIXELS - 2 * SIDE_PIXELS, PICTURE_PIXELS - TOP_PIXELS - BOTTOM_PIXELS)
    far = story.graph.body.radius + MARK_PIXELS / view.scale
    behind = [angle + np.pi + turn for turn in (-0.4, 0.0, 0.4)]
    ring = [pixel(story, image, x + far * np.cos(at), y + far * np.sin(at)) for at in behind]
    assert any(np.abs(found - PAPER.ink).max() < 80 for found in ring)
    texts: list[str] = []
    monkeypatch.setattr(Canvas, "text", lambda canvas, x, y, text, *rest, **how: texts.append(text))
    told(rules, task)
    assert said in texts
    assert "end" in texts


@pytest.mark.parametrize("names", [["a"], ["a", "bb", "ccc"] * 4, ["a_name_that_is_long"] * 20])
def test_a_legend_stays_within_its_lines(names: list[str]) -> None:
    canvas = Canvas.of_page(blank(400, 100, PAPER.page))
    size, places = legend_layout(canvas, names, 400.0)
    assert len(places) == len(names)
    assert size == MIN_TEXT_PIXELS or max(line for _, line in places) < LEGEND_LINES
    assert all(after > before for before, after in pairwise((line, along) for along, line in places))


def test_what_is_told_is_what_is_scored(rules: Path) -> None:
    found = set_up(str(rules), load(rules), "Chase", None)
    rollout = found.rollout()
    story, scores = record_run(found, rollout, 3), rollout.score(NO_GENOME, [3])
    assert story.ticks == scores.ticks[0, 0]
    assert story.counts[-1].sum() == scores.counts[0, 0] > 0
    assert np.array_equal(story.lines[-1], scores.by_line[0, 0])
    assert len(story.placements(0)) == story.counts[-1, 0] + 1


def test_the_picture_is_a_png_and_the_result_is_printed(mindc: Call, rules: Path) -> None:
    path = rules.with_name("path.png")
    said = mindc("run", rules, "--task", "Roam", "--seed", 3, "--picture", path, "--json")
    assert json.loads(said.out)["seed"] == 3
    assert said.err.endswith(f"{path}: the path of the robot\n")
    assert path.read_bytes()[:8] == b"\x89PNG\r\n\x1a\n"
    image = cv2.imread(str(path))
    assert image is not None
    assert image.shape == (PICTURE_PIXELS, PICTURE_PIXELS, 3)


@pytest.mark.parametrize(
    ("option", "name", "message"),
    [
        ("--picture", "no/path.png", "cannot be written: there is no folder"),
        ("--picture", "path.jpg", "must end in .png"),
        ("--picture", "folder.png", "cannot be written: it is a folder"),
        ("--video", "no/run.mp4", "cannot be written: there is no folder"),
        ("--video", "run.avi", "must end in .mp4 or .gif"),
    ],
)
def test_a_path_that_cannot_be_written_is_refused_first(
    mindc: Call, rules: Path, option: str, name: str, message: str
) -> None:
    (rules.parent / "folder.png").mkdir()
    before = sorted(rules.parent.iterdir())
    said = mindc("run", rules, option, rules.parent / name)
    assert (said.code, said.out) == (2, "")
    assert message in said.err
    assert len(said.err.splitlines()) == 1
    assert sorted(rules.parent.iterdir()) == before


def test_a_picture_that_fails_leaves_the_old_one(mindc: Call, rules: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = rules.with_name("path.png")
    path.write_bytes(b"old")

    def full(*_: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("os.fsync", full)
    said = mindc("run", rules, "--task", "Roam", "--seed", 3, "--picture", path)
    assert said.code == 2
    assert said.err.endswith(f"{path} cannot be written: No space left on device\n")
    assert "with Roam in charge" in said.out
    assert path.read_bytes() == b"old"
