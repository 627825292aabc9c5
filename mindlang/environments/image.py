"""The world of one robot as an image."""

import numpy as np

from mindlang.environments.episodes import Agent
from mindlang.pictures.canvas import Image
from mindlang.pictures.film_images import empty_window, half_window, window
from mindlang.pictures.labels import draw_names
from mindlang.pictures.robot import draw_robot
from mindlang.pictures.scene import draw_items, draw_zones
from mindlang.pictures.theme import NIGHT
from mindlang.run.recorded_run import RecordedRun

IMAGE_PIXELS = 480  # of the longer side
SHOWN_TICK = 1  # of a run that has one


def image_of(agent: Agent, lane: int) -> Image:
    """What the robot of a lane is in, [height, width, 3] as red, green, blue."""
    run = _as_run(agent, lane)
    half = half_window(run)
    size = [max(1, round(IMAGE_PIXELS * side / max(half))) for side in half]
    canvas = empty_window(run, window(run, SHOWN_TICK, *size), *size)
    for draw in (draw_zones, draw_items, draw_robot, draw_names):
        draw(canvas, run, NIGHT, SHOWN_TICK)
    return np.ascontiguousarray(canvas.image[:, :, ::-1])


def _as_run(agent: Agent, lane: int) -> RecordedRun:
    """The present of a lane as a run of one tick, in which nothing has moved."""
    lanes, here = agent.lanes, slice(lane, lane + 1)
    world, mind, graph = lanes.world_columns(lane), lanes.state.mind, agent.setup.ready.policy.graph
    return RecordedRun(
        setup=agent.setup,
        boxes=lanes.boxes(lane),
        body=np.repeat([world["pose"]], 2, axis=0),
        things=np.repeat([world["things"][:, :-1]], 2, axis=0),
        turned=np.repeat([world["things"][:, -1]], 2, axis=0),
        held=np.repeat([world["held"]], 2),
        readings=mind.readings[: graph.width, here].T,
        influence=mind.influence[:, here].T,
        commands=mind.commands[: len(graph.actuators), here].T,
        lines=world["rewards"][None],
        touching=np.array([world["touching"]], np.bool_),
        battery=np.array([world["battery"]]),
        events=world["events"][None],
        ended=world["ended"],
    )
