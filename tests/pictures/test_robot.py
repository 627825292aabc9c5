"""What pictures show of a robot: points of the floor, switches, lamps, wheels, thrusters; and names beside things."""

from dataclasses import replace
from itertools import combinations
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from mindrun.kinds.scenes.scene import Arena

from mindlang.compiler.compile import load
from mindlang.pictures.canvas import Canvas, Region, Viewport, blank, text_width
from mindlang.pictures.picture import height_of, picture
from mindlang.pictures.scene import NAME_PIXELS, draw_names, draw_robot, free, steering_angle, to_world
from mindlang.pictures.theme import PAPER
from mindlang.run.outcome import run_data
from mindlang.run.recorded_run import RecordedRun, record_run
from mindlang.run.setup import NO_GENOME, set_up

CAR = """tick 1/30 s
master Drive
body Car is car size 4 2
actuator engine is motor neutral 0.5
actuator front is steering range 40 deg neutral 0.5 delay 2 ticks
actuator headlight is lamp neutral 0
sensor seen is floor of line at 1 -1 ahead 3
sensor bumped is bumper at 0 180 deg width 60 deg
skill Drive is rule
  reads seen
  reads bumped
  drives engine at 0.9
  drives front at 0.25
  drives headlight at LAMP
task Drive in arena size 60 20
  contains line is zone size 4 at 3 3
  contains box is obstacle size 2 at 20 0
  starts at 0 0 facing 0 deg
  lasts 4 ticks
"""
HOVER = """tick 1/30 s
master Drive
body Robot is holonomic size 2
actuator push is thruster at -1 0 facing 0 deg neutral 0.5
actuator left is thruster at 0 1 facing 90 deg neutral 0.5
actuator spin is thruster at 1 0 facing 90 deg neutral 0.5
skill Drive is rule
  drives push at 1
  drives left at 0.5
  drives spin at 0.25
task Drive in plain
  starts at 0 0 facing 0 deg
  lasts 1 ticks
"""


def recorded(folder: Path, text: str) -> RecordedRun:
    (folder / "car.mind").write_text(text)
    found = set_up(str(folder / "car.mind"), load(folder / "car.mind"), None, None)
    return record_run(found, found.rollout(), 3)


class Spy(Canvas):
    """What is drawn, by its colour: polygons, lines and discs."""

    def __init__(self) -> None:
        super().__init__(blank(400, 400, PAPER.floor), Viewport(-20.0, 20.0, 10.0))
        self.drawn: list[tuple[str, Any, np.ndarray]] = []

    def polygon(self, points: Any, colour: Any, *rest: Any, **how: Any) -> None:
        self.drawn.append(("polygon", colour, np.array(points)))

    def line(self, points: Any, colour: Any, *rest: Any, **how: Any) -> None:
        self.drawn.append(("line", colour, np.array(points)))

    def disc(self, x: float, y: float, radius: float, colour: Any, *rest: Any, **how: Any) -> None:
        self.drawn.append(("rim" if how.get("width") else "disc", colour, np.array([x, y])))

    def of(self, shape: str, colour: Any) -> list[np.ndarray]:
        return [points for each, had, points in self.drawn if (each, had) == (shape, colour)]


def robot(run: RecordedRun, tick: int) -> Spy:
    spy = Spy()
    draw_robot(spy, run, PAPER, tick)
    return spy


def test_points_of_the_floor_are_where_they_look_and_filled_over_what_they_look_for(tmp_path: Path) -> None:
    run = recorded(tmp_path, CAR.replace("LAMP", "0"))
    assert run.readings[-1, :2].tolist() == [1.0, 0.0]
    places = to_world([(3.0, 1.0), (3.0, -1.0)], run.body[-1])
    spy = robot(run, run.ticks)
    assert np.allclose(spy.of("rim", PAPER.ray), places)
    assert np.allclose(spy.of("disc", PAPER.ray), places[:1])


@pytest.mark.parametrize("pressed", [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]])
def test_a_switch_is_lit_where_it_is_pressed(tmp_path: Path, pressed: list[float]) -> None:
    run = recorded(tmp_path, CAR.replace("LAMP", "0"))
    run.readings[-1, 2:4] = pressed
    spy = robot(run, run.ticks)
    lit, dark = spy.of("line", PAPER.crash), spy.of("line", PAPER.faint)
    assert (len(lit), len(dark)) == (sum(pressed), 2 - sum(pressed))
    for line, ahead in zip(lit, [2.0 * (1 - 2 * pressed.index(1.0))] if lit else [], strict=True):
        assert np.allclose(line[4], to_world([(ahead, 0.0)], run.body[-1])[0])  # the middle of a side of the car


@pytest.mark.parametrize(("command", "is_lit"), [(0.0, False), (0.5, False), (0.6, True), (1.0, True)])
def test_a_headlight_throws_a_beam_above_a_half(tmp_path: Path, command: float, is_lit: bool) -> None:
    run = recorded(tmp_path, CAR.replace("LAMP", str(command)))
    beams = robot(run, run.ticks).of("polygon", PAPER.lamp)
    assert len(beams) == is_lit
    ahead, _ = to_world([(5.0, 0.0)], run.body[-1])[0]
    assert all(beam[:, 0].max() > ahead for beam in beams)


def test_the_front_wheels_of_a_car_are_turned_as_late_as_their_steering(tmp_path: Path) -> None:
    run = recorded(tmp_path, CAR.replace("LAMP", "0"))
    angles = [np.degrees(steering_angle(run, tick)) for tick in range(run.ticks + 1)]
    assert angles == pytest.approx([0, 0, 0, 20, 20])  # 0.25 is half of the way to the left
    _, *wheels = robot(run, run.ticks).of("polygon", PAPER.robot)
    turned = [np.degrees(np.arctan2(*(wheel[1] - wheel[0])[::-1]) - run.body[-1, 2]) for wheel in wheels]
    assert turned == pytest.approx([0, 0, 20, 20])


def test_thrusters_throw_away_from_where_they_push(tmp_path: Path) -> None:
    run = recorded(tmp_path, HOVER)
    thrown = [to_world(way, run.body[-1]) for way in ([(-1, 0), (-2.6, 0)], [(0, 1), (0, 1)], [(1, 0), (1, 0.8)])]
    assert np.allclose(robot(run, 1).of("line", PAPER.lamp), thrown)


def test_names_of_things_that_are_close_do_not_overlap(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    things = "".join(f"  contains thing_{i} is item size 0.3 at {3 + i * 0.4} {2 + i % 2 * 0.3}\n" for i in range(6))
    run = recorded(tmp_path, CAR.replace("LAMP", "0") + things)
    said: list[Region] = []

    def text(canvas: Canvas, x: float, y: float, text: str, *rest: Any, **how: Any) -> None:
        said.append(Region(x, y, text_width(text, NAME_PIXELS) / 10, NAME_PIXELS / 10))

    monkeypatch.setattr(Canvas, "text", text)
    draw_names(Spy(), run, PAPER, run.ticks)
    assert len(said) == 7
    assert not any(one.overlaps(other) for one, other in combinations(said, 2))


def test_a_name_that_finds_no_place_stands_at_its_first() -> None:
    label, all_of_it = Region(0.0, 0.0, 1.0, 1.0), Region(-9.0, -9.0, 18.0, 18.0)
    assert free([label, label._replace(low=3.0)], [all_of_it], all_of_it) == label
    assert free([label, label._replace(low=3.0)], [label], all_of_it).low == 3.0
    assert free([label, label._replace(low=3.0)], [], label._replace(low=3.0)).low == 3.0


def test_the_picture_of_a_long_arena_is_lower(tmp_path: Path) -> None:
    run = recorded(tmp_path, CAR.replace("LAMP", "1"))
    rollout = run.setup.rollout()
    found = run_data(run.task, rollout.score(NO_GENOME, [3]))
    image = picture(run, {"task": "Drive", "master": "Drive", "seed": 3} | found)
    assert image.shape == (height_of(run), 1000, 3)
    assert height_of(run) < 520
    assert height_of(replace(run, setup=replace(run.setup, task=replace(run.task, scene=Arena(20.0))))) == 1000
