"""A graph, a task and a master as tables."""

from collections.abc import Mapping, Sequence

import numpy as np

from mindrun.engine.engine import scene_of
from mindrun.graph.graph import Graph, Sensor, Task
from mindrun.graph.measured import promised_sensors, rows_of, used_sensors
from mindrun.graph.scopes import influence_scopes
from mindrun.graph.skill_sets import acting
from mindrun.graph.weights import genes
from mindrun.kinds.sensors.sensor import Physical
from mindrun.numbers.arithmetic import BOX_COLUMNS
from mindrun.numbers.arrays import Array, Singles
from mindrun.numbers.expression import placed
from mindrun.sim import task_rows
from mindrun.sim.codes import CODE, SENSOR, Row, Tables, records, span
from mindrun.sim.kind_lanes import read, unit_of
from mindrun.sim.mind_rows import Programs, actuator_rows, memory_rows, skill_rows
from mindrun.sim.numbering import NOWHERE, boxes_by_name, rows_by_name
from mindrun.sim.parameter_rows import Parameters

Sizes = Mapping[str, int]  # the room that a lane needs, by what it is for


def build(
    graph: Graph,
    weights: Mapping[str, Singles],
    task: Task,
    master: str,
    learners: Sequence[str],
    addresses: Mapping[str, int],
    library: Array,
) -> tuple[Tables, Sizes]:
    """The tables of a task under a master; `addresses` are those of the compiled procedures, by skill."""
    programs, parameters = Programs(task_rows.first_numbers(task)), Parameters(graph, task)
    reached = acting(graph, task, master)
    skills, most = skill_rows(graph, reached, weights, learners, addresses, programs)
    judging = task_rows.judging_rows(task, programs)
    contents = task_rows.content_rows(graph, task, master, parameters, programs)
    used, aside = used_sensors(graph, reached, task)
    exact = promised_sensors(graph, reached, used + aside)
    sensors, remembered = sensor_rows(graph, (used, aside, exact), task, programs, parameters)
    driven, delays = actuator_rows(graph, parameters)
    measures, changes = task_rows.measure_rows(task, parameters)
    events, patches, arrivals = task_rows.event_rows(task)
    walls = [wall for thing in task.things for wall in thing.kind.walls]
    tables = Tables(
        **sensors, **skills, **contents,
        world=task_rows.world_row(graph, task, parameters, len(sensors["ray_row"]), used + aside + exact),
        codes=np.array(programs.rows, CODE), actuators=driven, memories=memory_rows(graph),
        loose=task_rows.loose_rows(task, graph.tick, parameters), options=task_rows.option_rows(task),
        walls=np.array(walls, np.float64).reshape(-1, BOX_COLUMNS),
        measures=measures, events=events, **judging,
        makings=parameters.makings(), choices=np.array(parameters.choices, np.float64),
        measured=rows_of(graph, used + aside + exact), library=library,
        parameters=parameters.table(),  # last: all others add to them
    )  # fmt: skip
    return tables, {
        **remembered, **most, "readings": max(1, graph.width), "genome": genome_length(graph, learners),
        "skills": len(graph.skills), "scoped": (len(influence_scopes(graph).without) - 1) * len(graph.skills),
        "depth": programs.depth, "delays": delays, "changes": changes,
        "patches": patches, "arrivals": arrivals, "boxes": sum(each.kind.obstacles(task.scene) for each in task.things),
    }  # fmt: skip


def genome_length(graph: Graph, learners: Sequence[str]) -> int:
    """The number of weights of all learners together."""
    learning = {*learners}
    return sum(genes(skill) for skill in graph.skills if skill.name in learning)


def sensor_rows(
    graph: Graph, measured: Sequence[list[Sensor]], task: Task, programs: Programs, parameters: Parameters
) -> tuple[dict[str, Array], dict[str, int]]:
    """The tables of the sensors that are used, aside or exact, and how many numbers are remembered of what.

    What is aside draws its noise from a generator of its own, what is exact has none: neither changes anything else.
    """
    (used, aside, exact), scene, things, boxes = measured, scene_of(graph), rows_by_name(task), boxes_by_name(task)
    rows, before, rough, rings = list[Row](), 0, 0, 0
    rays, ray_row, passes, numbers = list[float](), list[int](), list[tuple[int, int]](), list[float]()
    for sensor in used + aside + exact:
        kind, roughness = sensor.kind, {} if sensor in exact else _roughness(sensor, parameters)
        about, solid = _all_of(kind.things, things), _all_of(kind.things, boxes)
        rows.append({
            "lane": unit_of(kind, read).place, "start": sensor.start, "width": sensor.width,
            **span("thing", about), "box": solid.start, "boxes": len(solid),
            "turns": not scene.directions.isdisjoint({sensor.name, kind.source}),
            "is_aside": sensor in aside, "every": 1,
            **programs.columns(placed(kind.formula, scene.starts), "code", "length"),
            "ray": len(rays), "number": len(numbers), "before": before, "held": rough, "ring": rings,
            **_numbers(graph, sensor), **roughness, **kind.row(scene),
        })  # fmt: skip
        rays += kind.rays
        ray_row += range(sensor.start, sensor.start + len(kind.rays))
        passes += [(about.start, about.stop)] * len(kind.rays)
        numbers += kind.numbers
        before += sensor.width * kind.remembered
        if roughness:
            rough += sensor.width
            rings += sensor.width * int(roughness["delay"])
    turn = np.array(rays, np.float64)
    tables = {
        "sensors": records(rows, SENSOR),
        "rays": np.array([np.cos(turn), np.sin(turn)], np.float32),
        "rims": np.array([graph.body.rim(angle) for angle in rays], np.float32),
        "ray_row": np.array(ray_row, np.int64),
        "passes": np.array(passes, np.int64).reshape(-1, 2).T.copy(),
        "numbers": np.array(numbers, np.float64),
    }
    return tables, {"before": before, "rough": rough, "rings": rings}


def _all_of(names: Sequence[str], rows: Mapping[str, range]) -> range:
    """The rows of all these names that there are, which stand side by side."""
    found = [rows[name] for name in names if name in rows]
    return range(min(each.start for each in found), max(each.stop for each in found)) if found else NOWHERE


def _numbers(graph: Graph, sensor: Sensor) -> Row:
    """The place of an order among the orders, and that of the servo of a sensor among the actuators; −1 without one."""
    orders = [each.name for each in graph.sensors if each.kind.is_order]
    servos = {actuator.name: number for number, actuator in enumerate(graph.actuators)}
    part = orders.index(sensor.name) if sensor.kind.is_order else 0
    return {"part": part, "servo": servos.get(sensor.kind.servo, -1)}


def _roughness(sensor: Sensor, parameters: Parameters) -> Row:
    """The columns of a sensor's imperfections; `blank` is read where a reading is lost, −1 for the one before."""
    kind, name = sensor.kind, sensor.name
    if not isinstance(kind, Physical):
        return {}
    varying = {
        "noise": parameters.row("sensor", name, "noise", kind.noise),
        "lost": parameters.row("sensor", name, "lost", kind.lost),
        "wait": parameters.row("sensor", name, "delay", kind.delay),
    }
    kind = parameters.greatest("sensor", name, kind)
    is_rough = kind.noise > 0 or kind.lost > 0 or kind.every > 1 or kind.delay > 0
    blank = -1.0 if kind.keeps_lost else kind.blank
    return {"is_rough": is_rough, "blank": blank, "every": max(1, kind.every), "delay": kind.delay, **varying}
