"""The camera as a sensor: bearings read as in training, a neck follows, and a camera that stops is a fault."""

from collections.abc import Callable, Iterator
from pathlib import Path
from threading import active_count
from time import monotonic, sleep

import cv2
import numpy as np
import pytest
from mindrun.driver import DeviceError
from mindrun.graph.wiring import SensorWire, reading
from mindrun.numbers.arrays import Frame
from mindrun.robot import camera as watched
from mindrun.robot import driver_support, i2c
from mindrun.robot.camera import Aim, focal_length
from mindrun.robot.drivers import ball_tracker
from mindrun.robot.drivers.ball_tracker import BallTracker

from tests.robot.drivers.fakes import FakeBus, FakePca9685
from tests.robot.drivers.frames import HEIGHT, VIEW, WIDTH, FakeCamera, ball, column, room, taken

ENDS = 300.0  # seconds, in which all ends that does not hang, however busy the machine

Draw = Callable[[int], Frame | None]
Install = Callable[[Draw], FakeCamera]


@pytest.fixture
def camera(monkeypatch: pytest.MonkeyPatch) -> Iterator[Install]:
    """Puts a camera there that draws its frames."""
    monkeypatch.setattr(ball_tracker, "cameras", driver_support.SharedParts())

    def install(draw: Draw) -> FakeCamera:
        made = FakeCamera(draw)
        monkeypatch.setattr(watched, "open_camera", lambda path, width, height: made)
        return made

    yield install
    ball_tracker.cameras.close()


def at(angle: float, diameter: float = 24.0, up: float = 0.0) -> Draw:
    """Frames with a ball at an angle."""
    x, y = column(angle), (HEIGHT - 1) / 2 - up
    frame = ball(room(), x, y, diameter)
    return lambda count: taken(frame, seed=count)


@pytest.mark.parametrize(("angle", "share"), [(0.0, 0.5), (20.0, 0.5 - 20 / 360), (-20.0, 0.5 + 20 / 360)])
def test_a_bearing_reads_as_in_training(camera: Install, angle: float, share: float) -> None:
    camera(at(angle))
    driver = BallTracker()
    (found,) = driver.open().read()
    assert found == pytest.approx(angle, abs=0.4)
    assert reading(SensorWire("ball_bearing", driver, *driver.usual), found) == pytest.approx(share, abs=0.002)


def test_without_a_ball_there_is_none_and_never_the_last_angle(camera: Install) -> None:
    seen, empty = at(20.0), room()
    made = camera(lambda count: seen(count) if count < 10 else taken(empty, seed=count))
    device = BallTracker().open()
    found = [device.read()[0] for _ in range(20)]
    assert made.count > 10
    assert None not in found[:2]
    assert found[-8:] == [None] * 8


def test_one_camera_measures_several_things(camera: Install) -> None:
    made = camera(at(10.0, diameter=40, up=50.0))
    drivers = [BallTracker(measure) for measure in ("bearing", "elevation", "distance")]
    devices = [driver.open() for driver in drivers]
    bearing, elevation, metres = (device.read()[0] for device in devices)
    assert bearing == pytest.approx(10, abs=0.4)
    assert elevation == pytest.approx(10.1, abs=0.6)
    assert metres == pytest.approx(0.1 * focal_length(WIDTH, VIEW) / 40, rel=0.05)
    assert [driver.unit for driver in drivers] == ["deg", "deg", "m"]
    for device in devices:
        assert not made.released
        device.close()
        device.close()
    assert made.released == 1


def black(count: int) -> Frame:
    """A lens that is covered."""
    return taken(np.zeros((HEIGHT, WIDTH, 3), np.float32), 2.0, count)


def white(count: int) -> Frame:
    """A camera that looks into the sun."""
    return taken(np.full((HEIGHT, WIDTH, 3), 300, np.float32), 2.0, count)


@pytest.mark.parametrize(
    ("broken", "said"),
    [
        (lambda count: None, "no frame for"),
        (black, "frames are black"),
        (white, "frames are all white"),
        (lambda count: at(0.0)(7), "the same frame"),
        (lambda count: 1 / 0, "the camera failed"),
    ],
)
def test_a_camera_that_sees_nothing_is_a_fault_in_time(
    camera: Install, broken: Draw, said: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    good, after = at(0.0), [10**9]
    made = camera(lambda count: good(count) if count < after[0] else broken(count))
    device = BallTracker().open()
    device.read()
    after[0], begin = made.count, monotonic()
    with monkeypatch.context() as context:
        if said == "no frame for":
            context.setattr(ball_tracker, "MAX_FRAME_AGE_SECONDS", 0.2)
        with pytest.raises(DeviceError, match=said):
            read_for(ENDS, device)
    assert monotonic() - begin < ENDS
    after[0] = 10**9
    sleep(0.05)
    device.number = device.tracking.sighting.number
    assert device.read()[0] == pytest.approx(0, abs=0.4)


def read_for(seconds: float, device: ball_tracker.BallTrackerDevice) -> None:
    """Read again and again."""
    begin = monotonic()
    while monotonic() - begin < seconds:
        device.read()


def test_a_camera_that_hangs_does_not_hold_up_closing(camera: Install) -> None:
    threads = active_count()
    made = camera(at(0.0))
    device = BallTracker().open()
    made.stopped.set()
    begin = monotonic()
    device.close()
    assert monotonic() - begin < ENDS
    assert made.released == 1
    assert active_count() == threads


def test_a_camera_that_never_starts_is_told(camera: Install, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(ball_tracker, "FIRST_FRAME_SECONDS", 0.1)
    made = camera(lambda count: None)
    with pytest.raises(DeviceError, match=r"no frame for 0\.1 s"):
        BallTracker().open()
    assert made.released == 1


def test_the_neck_follows_and_the_bearing_stays(camera: Install, monkeypatch: pytest.MonkeyPatch) -> None:
    card = FakePca9685()
    bus = FakeBus({0x40: card})
    monkeypatch.setattr(i2c, "open_bus", lambda number: bus)
    monkeypatch.setattr(ball_tracker, "CENTRING_SECONDS", 0.05)
    driver = BallTracker(pan=0, tilt=1, travel=180.0, tilt_travel=-90.0)

    def draw(count: int) -> Frame:
        turned = (card.pulse(0) - 1500) / 1000 * 180
        seen = 50.0 - turned
        frame = ball(room(), column(seen), 119.5, 24) if abs(seen) < 29 else room()
        return taken(frame, seed=count)

    camera(draw)
    device = driver.open()
    assert device.read() == (None,)
    card.write(bytes([0x06, 0, 0, 0x63, 0x01]))  # somebody turns the camera to where the ball is in sight
    device.tracking.aim = Aim(pan=(card.pulse(0) - 1500) / 1000 * 180)
    sleep(0.6)
    assert device.read()[0] == pytest.approx(50, abs=2)
    assert (card.pulse(0) - 1500) / 1000 * 180 == pytest.approx(50, abs=2)
    assert card.pulse(1) == pytest.approx(1500, abs=40)
    bus.failing = 1.0
    with pytest.raises(DeviceError, match="servo card"):
        read_for(ENDS, device)


def test_a_neck_that_is_not_there_is_told_and_lets_the_camera_go(
    camera: Install, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(i2c, "open_bus", lambda number: FakeBus({}))
    made = camera(at(0.0))
    with pytest.raises(DeviceError, match="servo card"):
        BallTracker(pan=0).open()
    assert made.released == 1
    with pytest.raises(DeviceError, match="channel 3 has no travel"):
        BallTracker(tilt=3, tilt_travel=0.0).open()


def test_a_camera_that_is_not_there_is_told(tmp_path: Path) -> None:
    with pytest.raises(DeviceError, match="cannot be opened") as caught:
        BallTracker(camera=str(tmp_path / "nothing.avi")).open()
    assert "/dev/video" in caught.value.hint


def values(device: ball_tracker.BallTrackerDevice) -> Iterator[float | None]:
    """What is read, until it fails."""
    while True:
        yield device.read()[0]


@pytest.fixture
def film(tmp_path: Path) -> Path:
    """A recorded film of a second: a ball goes from left to right, and is gone in the last third."""
    path = tmp_path / "ball.avi"
    writer = cv2.VideoWriter(str(path), cv2.VideoWriter_fourcc(*"MJPG"), 30.0, (WIDTH, HEIGHT))
    assert writer.isOpened()
    for count in range(30):
        frame = ball(room(), column(20 - 2 * count), 120, 24) if count < 20 else room()
        writer.write(taken(frame, seed=count))
    writer.release()
    return path


def test_a_recorded_film_is_a_camera(film: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(ball_tracker, "MAX_FRAME_AGE_SECONDS", 2.0)
    begin = monotonic()
    device, found = BallTracker(camera=str(film)).open(), []
    with pytest.raises(DeviceError, match="no frame"):
        found.extend(values(device))  # what came before the end stays
    assert 0.8 < monotonic() - begin < ENDS
    angles = [angle for angle in found if angle is not None]
    assert len(angles) > 10
    assert angles == sorted(angles, reverse=True)
    assert all(abs((angle - 20) / 2 - round((angle - 20) / 2)) < 0.2 for angle in angles)
    assert found[-5:] == [None] * 5
    device.close()
