"""The range finders of the lanes see what pymunk's segment queries see."""

import numpy as np
import pymunk
import pytest
from mindrun.graph.graph import Graph
from mindrun.graph.policy import Policy
from mindrun.kinds.sensors.rays import RangeFinder
from mindrun.sim.rollout import Rollout
from mindrun.sim.trace import trace

from tests.sim.minds import compile_text

ANGLES = "0 22.5 45 90 135 180 225 270 315 337.5"


@pytest.fixture(scope="module")
def watcher() -> Graph:
    """A mind that stands still and looks around, in a crowded arena."""
    return compile_text(f"""
tick 1/60 s
master Watch
body Robot is disc
actuator left_wheel is wheel side left neutral 0.5
sensor proximity is range_finder at {ANGLES} deg range 12 dead_zone 0
skill Watch is rule
  reads proximity
  drives left_wheel at 0.5
task Watch in arena size 60
  contains rock is obstacle grid 10 size 2 to 6 jitter 1
  lasts 1 ticks
  rewards 0 per tick
""")


def test_rays_are_segment_queries(watcher: Graph) -> None:
    rollout = Rollout(Policy(watcher, {}), "Watch", "Watch")
    finder = watcher.sensors[0].kind
    assert isinstance(finder, RangeFinder)
    seen = []
    for seed in range(300):
        run = trace(rollout, seed)
        readings = next(run.moments).readings
        expected = segment_queries(run.boxes[:, :3], 30.0, run.begin, np.array(finder.at), finder.range)
        assert readings == pytest.approx(expected, abs=1e-4)
        seen.extend(expected)
    assert 0.2 < np.mean(np.array(seen) < 1) < 0.95  # some meet something, some do not


def segment_queries(boxes: np.ndarray, half: float, pose: np.ndarray, angles: np.ndarray, reach: float) -> list[float]:
    """What pymunk says about the same world: the distance from the rim to the first thing, as a share of the range."""
    space = pymunk.Space()
    walls = [(-half - 2, -half, -half - 2, half + 2), (half, half + 2, -half - 2, half + 2)]
    walls += [(c, d, a, b) for a, b, c, d in walls]
    sides = [(x - h, x + h, y - h, y + h) for x, y, h in boxes] + walls
    for left, right, low, high in sides:
        space.add(pymunk.Poly(space.static_body, [(left, low), (right, low), (right, high), (left, high)]))
    x, y, angle = pose
    found = []
    for turn in angles + angle:
        end = x + (reach + 1) * np.cos(turn), y + (reach + 1) * np.sin(turn)
        hit = space.segment_query_first((x, y), end, 0.0, pymunk.ShapeFilter())
        found.append(min(1.0, (hit.alpha * (reach + 1) - 1) / reach) if hit else 1.0)
    return found
