"""The lines that `mindrun calibrate` prints can stand in robot.yaml."""

import pytest
from mindrun.cli.calibrate import lines, reading_statistics
from mindrun.graph.wiring import SensorWire
from mindrun.kinds.sensors.compass import Compass
from mindrun.kinds.sensors.motion import Inertial
from mindrun.kinds.sensors.nearest import Distance
from mindrun.robot.sensing import Sample

from tests.robot.faults import Scripted


def samples(*values: float | None) -> list[Sample]:
    return [Sample((value,), float(number)) for number, value in enumerate(values)]


def wire() -> SensorWire:
    return SensorWire("sense", Scripted(1, []), 0.0, 2.0)


def test_a_range_that_was_seen_is_proposed_without_exponents() -> None:
    said = lines(wire(), samples(0.00002, *[0.5] * 20, 1.25), Inertial())
    assert said[2:5] == ["sense:", "  from: 0.00002", "  to: 1.25"]
    assert said[-1] == "# for the .mind file: noise 0.0% dead_zone 0.0% lost 0%"


def test_the_scale_of_training_stays() -> None:
    said = lines(wire(), samples(0.2, 0.4), Distance("ball"))
    assert not any("from:" in line for line in said)
    assert "# from and to are those of training (0 to 2), and no matter of what was seen" in said


def test_what_does_not_change_is_told() -> None:
    assert "# it has not changed: move what it measures" in lines(wire(), samples(1.0, 1.0), Inertial())


def test_noise_is_the_spread_at_rest_and_losses_are_counted() -> None:
    seen = reading_statistics([0.0, 1.0, *[0.5, 0.52] * 10, None, None])
    assert seen
    assert (seen.low, seen.high) == (0.0, 1.0)
    assert abs(seen.noise - 0.01) < 1e-9
    assert abs(seen.lost - 2 / 24) < 1e-9
    assert reading_statistics([None]) is None


@pytest.mark.parametrize("turned", [0.0, 90.0, 179.0, 180.0, -180.0])
def test_a_direction_trembles_as_much_wherever_it_points(turned: float) -> None:
    """A compass that faces away from north says 179 and −179 degrees in turn."""
    seen = samples(*((turned + off + 180) % 360 - 180 for off in [-1.0, 1.0] * 10))
    said = lines(SensorWire("sense", Scripted(1, []), 180.0, -180.0), seen, Compass())
    assert said[1].endswith("noise 1, lost 0%")
    assert said[-1] == "# for the .mind file: noise 0.6% dead_zone 0.8% lost 0%"
