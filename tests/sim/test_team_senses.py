"""Robots that see each other: what range finders and lights read is what pymunk's own segments meet."""

import numpy as np
import pymunk
import pytest
from mindrun.graph.policy import Policy
from mindrun.numbers.trigonometry import cosine, sine
from mindrun.sim.rollout import Rollout

from tests.sim.minds import DRIFTER, compile_text

RAYS = range(0, 360, 24)
TICKS, RANGE = 400, 12.0
SENSES = f"""
sensor eyes is range_finder at {" ".join(map(str, RAYS))} deg range {RANGE} dead_zone 0
sensor lamp_light is light of lamp range 10
sensor bumps is bumper at 0 deg width 360 deg
skill Look is rule
  reads eyes
  reads lamp_light
  reads bumps
  influences Drift at 1
"""
TASK = """
task Watch in plain
  contains object is item size 1
  contains lamp is zone size 1 at 0 0
  contains mate is robot count 2 away 3 to 5{}
  contains scout is robot at -3 4 under Look
  starts at 3 3
  lasts 400 ticks
  counts collision with scout
"""


def shape(body: str, pose: np.ndarray, space: pymunk.Space) -> pymunk.Shape:
    of = pymunk.Body(body_type=pymunk.Body.KINEMATIC)
    of.position, of.angle = tuple(map(float, pose[:2])), float(pose[2])
    made = pymunk.Circle(of, 1.0) if body == "disc size 2" else pymunk.Poly.create_box(of, (3.0, 1.6))
    space.add(of, made)
    return made


@pytest.mark.parametrize("body", ["disc size 2", "box size 3 1.6"])
@pytest.mark.parametrize("under", ["", " under Look"])
def test_they_are_seen_as_they_stand(body: str, under: str) -> None:
    """The first robot, too, where it is none of a name."""
    task = TASK.format(under)
    graph = compile_text(
        DRIFTER.replace("master Drift", "master Look").replace("is disc", f"is {body}") + SENSES + task
    )
    rollout = Rollout(Policy(graph, {}), "Watch", "Look")
    tile, jobs = rollout.tile(1), rollout.jobs(np.zeros((1, 0), np.float32), np.array([5], np.uint64))
    start = {sensor.name: sensor.start for sensor in graph.sensors}
    rollout.fill(tile, jobs)
    world, mind, seen, shaded, bumped = tile.state.world, tile.state.mind, 0, 0, 0
    for _ in range(TICKS - 1):
        poses = world.body[:3, :4].T.copy()
        rollout.advance(tile, jobs, 1)
        space = pymunk.Space()
        shapes = [shape(body, pose, space) for pose in poses]
        space.step(1e-9)
        for lane, (x, y, angle) in enumerate(poses):
            space.remove(shapes[lane])
            for ray, degrees in enumerate(RAYS):
                c, s = cosine(angle + np.deg2rad(degrees)), sine(angle + np.deg2rad(degrees))
                rim, end = graph.body.rim(np.deg2rad(degrees)), 20.0
                hit = space.segment_query_first((x, y), (x + end * c, y + end * s), 0, pymunk.ShapeFilter())
                expected = 1.0 if hit is None else min(1.0, max(0.0, (hit.alpha * end - rim) / RANGE))
                assert mind.readings[start["eyes"] + ray, lane] == pytest.approx(expected, abs=1e-4)
                seen += expected < 1.0
            dark = space.segment_query_first((x, y), (0.0, 0.0), 0, pymunk.ShapeFilter()) is not None
            assert (mind.readings[start["lamp_light"], lane] == 0.0) == dark
            shaded += dark
            bumped += mind.readings[start["bumps"], lane] == 1.0 and bool(space.shape_query(shapes[lane]))
            space.add(shapes[lane])
    assert min(seen, shaded) > 100
    assert bumped > 0
