"""The ball tracker on frames drawn as a camera spoils them: where the ball is, how far, and when there is none."""

from math import atan, degrees

import cv2
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mindrun.robot.camera import (
    DEGREES_PER_SECOND,
    Aim,
    BallCamera,
    SeenBall,
    blindness,
    distance,
    find_ball,
    focal_length,
    follow,
)

from tests.draws import cases
from tests.robot.drivers.frames import (
    HEIGHT,
    VIEW,
    WIDTH,
    ball,
    colour,
    column,
    disc,
    painted,
    room,
    taken,
)

REACHES = 90.0, 45.0  # of a neck
LOOK = BallCamera(view=VIEW)
WHITE = np.full(3, 255, np.float32)


def off(found: SeenBall | None, x: float) -> float:
    """By how many degrees the bearing is off that of a column."""
    assert found is not None
    return abs(found.bearing - degrees(atan(((WIDTH - 1) / 2 - x) / focal_length(WIDTH, VIEW))))


@given(st.floats(40, 280), st.floats(40, 200), st.floats(8, 60), st.integers(0, 1000), st.floats(0, 12))
@settings(max_examples=cases(40))
def test_a_ball_is_found_where_it_is(x: float, y: float, diameter: float, seed: int, noise: float) -> None:
    found = find_ball(taken(ball(room(), x, y, diameter), noise, seed), LOOK)
    assert off(found, x) < 0.35
    assert found.diameter == pytest.approx(diameter, abs=1 + 0.06 * diameter)


@given(st.integers(0, 1000), st.floats(0, 25), st.floats(0, 200))
@settings(max_examples=cases(20))
def test_no_ball_is_no_ball(seed: int, noise: float, brightness: float) -> None:
    assert find_ball(taken(room(brightness), noise, seed), LOOK) is None


@pytest.mark.parametrize(("angle", "left"), [(20.0, True), (-20.0, False)])
def test_to_the_left_is_positive(angle: float, left: bool) -> None:
    x = column(angle)
    assert (x < WIDTH / 2) == left
    assert find_ball(taken(ball(room(), x, 120, 20)), LOOK).bearing == pytest.approx(angle, abs=0.3)


def test_upwards_is_positive() -> None:
    assert find_ball(taken(ball(room(), 160, 60, 20)), LOOK).elevation > 5
    assert find_ball(taken(ball(room(), 160, 180, 20)), LOOK).elevation < -5


@pytest.mark.parametrize("hue", [0, 10, 60, 120, 200, 240, 350, 360])
def test_only_the_colour_that_is_looked_for_is_found(hue: float) -> None:
    frame = taken(ball(room(), 100, 100, 24, hue))
    assert off(find_ball(frame, BallCamera(hue=hue, view=VIEW)), 100) < 0.3
    assert find_ball(frame, BallCamera(hue=(hue + 90) % 360, view=VIEW)) is None


def test_of_two_balls_the_larger_is_taken_every_time() -> None:
    frame = ball(ball(room(), 80, 100, 20), 240, 120, 30)
    assert all(off(find_ball(taken(frame, seed=seed), LOOK), 240) < 0.3 for seed in range(20))


def test_a_ball_of_another_colour_is_not_confused_with_it() -> None:
    frame = ball(ball(room(), 80, 100, 16), 240, 120, 60, hue=0)
    assert off(find_ball(taken(frame), LOOK), 80) < 0.3


def test_an_overexposed_ball_keeps_its_colour_around_its_rim() -> None:
    frame = painted(ball(room(), 100, 100, 30), disc(100, 100, 20), WHITE)
    found = find_ball(taken(frame), LOOK)
    assert off(found, 100) < 0.3
    assert found.diameter == pytest.approx(30, abs=2)


def test_a_white_lamp_is_no_ball() -> None:
    lamp = painted(room(), disc(100, 100, 30), WHITE)
    assert find_ball(taken(lamp), LOOK) is None
    assert off(find_ball(taken(ball(lamp, 220, 100, 14)), LOOK), 220) < 0.3


def test_a_saturated_frame_is_blind() -> None:
    frame = taken(painted(np.full((HEIGHT, WIDTH, 3), 300.0, np.float32), disc(100, 100, 30), colour(120)))
    assert blindness(frame) == "all white"
    assert find_ball(frame, LOOK) is None


def test_a_black_frame_is_blind() -> None:
    frame = np.random.default_rng(1).integers(0, 6, (HEIGHT, WIDTH, 3)).astype(np.uint8)
    assert blindness(frame) == "black"
    assert find_ball(frame, LOOK) is None


def test_a_luminous_ball_is_seen_in_the_dark() -> None:
    frame = taken(ball(room(3.0), 100, 100, 24), 3.0)
    assert blindness(frame) == ""
    assert off(find_ball(frame, LOOK), 100) < 0.3


def test_a_ball_that_does_not_shine_is_none() -> None:
    dull = painted(room(), disc(100, 100, 24), colour(120, brightness=0.35))
    assert find_ball(taken(dull), LOOK) is None


@pytest.mark.parametrize("angle", [0, 30, 90])
@pytest.mark.parametrize("length", [9, 19])
def test_a_moving_ball_is_in_the_middle_of_its_streak(length: int, angle: float) -> None:
    kernel = np.zeros((length, length), np.float32)
    kernel[length // 2] = 1
    turned = cv2.warpAffine(kernel, cv2.getRotationMatrix2D((length // 2, length // 2), angle, 1), (length, length))
    frame = cv2.filter2D(ball(room(), 150, 110, 24), -1, turned / turned.sum())
    found = find_ball(taken(frame), BallCamera(view=VIEW, brightness=0.4))
    assert off(found, 150) < 0.6
    assert found.diameter == pytest.approx(24, abs=7)


@pytest.mark.parametrize("size", [(30, 30), (60, 20), (90, 12), (8, 120)])
def test_what_is_not_round_is_no_ball(size: tuple[int, int]) -> None:
    cover = np.zeros((HEIGHT, WIDTH, 1), np.float32)
    cover[80 : 80 + size[1], 100 : 100 + size[0]] = 1
    assert find_ball(taken(painted(room(), cover, colour(120))), LOOK) is None


def test_a_ball_that_is_partly_out_of_the_frame_is_seen() -> None:
    found = find_ball(taken(ball(room(), 4, 100, 40)), LOOK)
    assert found.bearing > 25


def test_size_is_distance() -> None:
    near, far = (
        distance(find_ball(taken(ball(room(), 160, 120, pixels)), LOOK).diameter, 0.1, WIDTH, VIEW)
        for pixels in (40, 20)
    )
    assert near == pytest.approx(0.1 * focal_length(WIDTH, VIEW) / 40, rel=0.04)
    assert far == pytest.approx(2 * near, rel=0.06)


def followed(angle: float, seconds: float) -> Aim:
    """Where a camera points that has followed a ball for a while, thirty times a second."""
    aim = Aim()
    for _ in range(round(30 * seconds)):
        aim = follow(aim, SeenBall(angle - aim.pan, -aim.tilt, 20), 1 / 30, *REACHES)
    return aim


@pytest.mark.parametrize(("angle", "pan"), [(50.0, 50.0), (-50.0, -50.0), (120.0, 90.0), (0.0, 0.0)])
def test_the_camera_turns_to_the_ball_as_far_as_it_can(angle: float, pan: float) -> None:
    assert followed(angle, 3).pan == pytest.approx(pan, abs=0.5)


def test_it_turns_no_faster_than_it_may() -> None:
    assert followed(90, 0.2).pan == pytest.approx(0.2 * DEGREES_PER_SECOND, abs=0.1)


def test_a_lost_ball_is_waited_for_and_then_given_up() -> None:
    aim = Aim(pan=60.0, tilt=20.0)
    for _ in range(29):
        aim = follow(aim, None, 1 / 30, *REACHES)
    assert (aim.pan, aim.tilt) == (60.0, 20.0)
    for _ in range(90):
        aim = follow(aim, None, 1 / 30, *REACHES)
    assert (aim.pan, aim.tilt) == pytest.approx((0, 0), abs=0.5)
    assert follow(aim, SeenBall(10, 0, 20), 1 / 30, *REACHES).alone == 0


def test_a_camera_that_is_fixed_stays() -> None:
    assert follow(Aim(), SeenBall(30, 20, 20), 1 / 30, 0.0, 0.0) == Aim()
