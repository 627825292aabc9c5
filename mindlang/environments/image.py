"""The world of one robot as an image."""

import numpy as np
from mindrun.arithmetic import ANGLE, BOX_COLUMNS, SIZE, THING_ROWS
from mindrun.robot.recording_header import GOES_ON
from mindrun.sim.ticks import turned

from mindlang.environments.agent import Agent
from mindlang.pictures.canvas import Canvas, Image, Viewport, blank
from mindlang.pictures.film_images import half_window
from mindlang.pictures.names import draw_names
from mindlang.pictures.robot import draw_robot
from mindlang.pictures.scene import draw_floor, draw_items, draw_zones
from mindlang.pictures.theme import NIGHT
from mindlang.run.recorded_run import RecordedRun

IMAGE_PIXELS = 480  # of the longer side
SHOWN_TICK = 1  # of a run that has one


def image_of(agent: Agent, lane: int) -> Image:
    """What the robot of a lane is in, [height, width, 3] as red, green, blue."""
    run = _as_run(agent, lane)
    half = np.array(half_window(run))
    width, height = (max(1, round(IMAGE_PIXELS * side / half.max())) for side in half.tolist())
    middle = run.body[SHOWN_TICK, :2] * (not run.task.scene.is_bounded)
    image = blank(width, height, NIGHT.page if run.task.scene.is_bounded else NIGHT.floor)
    canvas = Canvas(image, Viewport.around(middle - half, middle + half, width, height))
    draw_floor(canvas, run, NIGHT)
    draw_zones(canvas, run, NIGHT, SHOWN_TICK)
    draw_items(canvas, run, NIGHT, SHOWN_TICK)
    draw_robot(canvas, run, NIGHT, SHOWN_TICK)
    draw_names(canvas, run, NIGHT, SHOWN_TICK)
    return np.ascontiguousarray(image[:, :, ::-1])


def _as_run(agent: Agent, lane: int) -> RecordedRun:
    """The present of a lane as a run of one tick, in which nothing has moved."""
    lanes, here = agent.lanes, slice(lane, lane + 1)
    world, mind, graph = lanes.state.world, lanes.state.mind, agent.setup.ready.policy.graph
    things = len(lanes.rollout.tables.things)
    places = world.things[: THING_ROWS * things, lane].reshape(-1, THING_ROWS)[:, : SIZE + 1]
    turns = turned(lanes.rollout, world.loose[:, here].T, world.direction[:, here].T)
    return RecordedRun(
        setup=agent.setup,
        boxes=world.boxes[lane].reshape(-1, BOX_COLUMNS),
        body=np.repeat(world.body[: ANGLE + 1, here].T, 2, axis=0),
        things=np.repeat(places[None], 2, axis=0),
        turned=np.repeat(turns, 2, axis=0),
        held=np.repeat(world.held[here], 2),
        readings=mind.readings[: graph.width, here].T,
        influence=mind.influence[:, here].T,
        commands=mind.commands[: len(graph.actuators), here].T,
        lines=lanes.lines[here],
        touching=(lanes.state.contact.touching[here] & 1).astype(np.bool_),
        battery=world.battery[here],
        events=lanes.counts[here],
        ended=GOES_ON,
    )
