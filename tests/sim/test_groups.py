"""A sensor about things of several names reads what sensors about each of them do, together."""

import numpy as np
from mindrun.graph.policy import Policy
from mindrun.sim.rollout import Rollout
from mindrun.sim.trace import trace

from tests.sim.minds import compile_text

KINDS = {
    "way": "bearing of {}", "far": "distance of {} range 60", "glow": "light of {}",
    "seen": "eye of {} at -40 0 40 deg",
    "under": "floor of {} at -1 1 ahead 1",
}  # fmt: skip
TOGETHER = {"far": np.minimum, "glow": np.maximum, "seen": np.minimum, "under": np.maximum}
TEXT = """
tick 1/20 s
master Go
body Rover is disc size 2
actuator left_wheel is wheel side left neutral 0.5
actuator right_wheel is wheel side right neutral 0.5
sensor slow is sine period 7 s
skill Go is rule
  reads slow
  drives left_wheel at 0.5 + slow / 2
  drives right_wheel at 0.8
task Go in arena size 30
  contains home is zone
  contains gem is item size 2 count 3 reached moves
  contains coin is item size 2 count 2 reached vanishes
  contains bin is item size 2 reached moves
  lasts 100 s
  rewards 1 * gem_or_coin_way per tick
"""


def test_a_sensor_of_several_names_reads_what_those_of_each_do_together() -> None:
    groups = [("gem",), ("gem", "coin"), ("coin",), ("coin", "bin"), ("bin",), ("bin", "gem", "coin")]
    kinds = [(name, kind, group) for name, kind in KINDS.items() for group in groups]
    sensors = {f"{'_or_'.join(group)}_{name}": kind.format(" or ".join(group)) for name, kind, group in kinds}
    read = [f"sensor {name} is {kind}" for name, kind in sensors.items()]
    extra = [f"  rewards 1 * p per tick for each p in {name}" for name in sensors]
    graph = compile_text("\n".join([TEXT.rstrip(), *extra, *read]))
    moments = [*trace(Rollout(Policy(graph, {}), "Go", "Go"), 3).moments]
    rows = np.array([moment.readings for moment in moments])
    found = {sensor.name: rows[:, sensor.start : sensor.start + sensor.width] for sensor in graph.sensors}
    for group in groups:
        own = {kind: [found[f"{name}_{kind}"] for name in group] for kind in KINDS}
        for kind, together in TOGETHER.items():
            np.testing.assert_array_equal(found[f"{'_or_'.join(group)}_{kind}"], together.reduce(own[kind]))
        nearest = np.argmin(own["far"], axis=0)
        is_clear = np.sort(own["far"], axis=0)[0] < 1
        expected = np.take_along_axis(np.array(own["way"]), nearest[None], axis=0)[0]
        np.testing.assert_array_equal(found[f"{'_or_'.join(group)}_way"][is_clear], expected[is_clear])
    assert len({*found["gem_or_coin_way"].ravel()}) > 100
