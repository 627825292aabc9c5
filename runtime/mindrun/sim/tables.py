"""A graph, a task and a master as plain tables: one row per sensor, skill, reward, so that no program compiles."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from math import inf, nan, pi
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from mindrun import actuators, events, measures, sensors, world
from mindrun.functions import Mlp, Procedure, Rule
from mindrun.functions.mlp import layers
from mindrun.graph import Actuator, Graph, Program, Reward, Sensor, Skill, Task, Thing
from mindrun.weights import genes, reachable, weights_of

Array = NDArray[Any]
Floats = NDArray[np.float32]

# Codes of the kinds, as the lanes know them.
RANGE, BEARING, CONTACT, HELD, INSIDE, INERTIAL, BATTERY, DERIVATIVE, SINE = range(9)
WHEEL_LEFT, WHEEL_RIGHT, GRIPPER, SERVO = range(4)
MLP, RULE, PROCEDURE = range(3)
ITEM, ZONE, POWER = range(3)
PROGRESS, ADVANCE, RETREAT, FORWARD, CHANGE = range(5)
REACH, DELIVERY, VISIT, COLLISION, EXHAUSTION = range(5)
NUMBER, READING, EACH, MEASURE, ADD, SUBTRACT, MULTIPLY, DIVIDE, NEGATE = range(9)
LESS, LESS_EQUAL, GREATER, GREATER_EQUAL = range(4)

OPERATIONS = {name: code for code, name in enumerate(("number", "reading", "each", "measure", *"+-*/", "negate"))}
COMPARES = {"<": LESS, "<=": LESS_EQUAL, ">": GREATER, ">=": GREATER_EQUAL}
INERTIAL_TICKS = 20


def _row(**columns: str) -> np.dtype[Any]:
    return np.dtype(list(columns.items()), align=True)


SENSOR = _row(
    kind="i8", start="i8", width="i8", thing="i8", source="i8", ray="i8", before="i8", turns="i8",
    range="f8", dead_zone="f4", gain="f4", period="f8",
)  # fmt: skip
SKILL = _row(
    kind="i8", index="i8", input="i8", inputs="i8", outputs="i8", hidden="i8", width="i8", weights="i8", own="i8",
    edge="i8", edges="i8", address="u8",
)  # fmt: skip
EDGE = _row(to_skill="i8", target="i8", output="i8", code="i8", length="i8")
CODE = _row(op="i8", arg="i8", value="f8")
ACTUATOR = _row(kind="i8", thrust="f8", neutral="f4", reach="f8", delay="i8", ring="i8")
MEMORY = _row(row="i8", decay="f4", rest="f4", start="f4")
THING = _row(kind="i8", first="f8", last="f8", by="f8", low="f8", high="f8", hold="f8", moves="i8")
OBSTACLE = _row(first="f8", last="f8", grid="f8", jitter="f8", lines="i8", count="i8", low="f8", high="f8")
MEASURES = _row(kind="i8", thing="i8", beyond="f8", over="i8", ring="i8")
EVENT = _row(kind="i8", thing="i8", columns="i8", patch="f8", board="i8", ends="i8", counts="i8")
REWARD = _row(
    code="i8", length="i8", on="i8", each="i8", eachs="i8", compare="i8", left="i8", lefts="i8", right="i8", rights="i8"
)
WORLD = _row(
    dt="f8", linear="f8", angular="f8", mass="f8", moment="f8", mass_inv="f8", moment_inv="f8", radius="f8",
    half="f8", ticks="i8", start="f8", drain="f8", charge="f8", inertial="i8", rays="i8", range="f8", master="i8",
    claw="f8", battery="i8",
)  # fmt: skip


class Tables(NamedTuple):
    """What the lanes run: everything about the program and its task that is the same in every lane."""

    world: Array
    sensors: Array
    rays: Array  # [2, rays] float32: cosine and sine of each ray's angle
    ray_row: Array  # the row of readings that each ray writes
    skills: Array
    inputs: Array  # rows of readings, skill after skill
    edges: Array
    codes: Array
    weights: Array  # float32, of the skills that do not learn
    actuators: Array
    memories: Array
    things: Array
    obstacles: Array
    measures: Array
    events: Array
    rewards: Array
    library: Array  # addresses of Chipmunk's functions


@dataclass(frozen=True, slots=True)
class Sizes:
    """How much room a lane needs."""

    readings: int
    skills: int
    before: int
    inputs: int
    width: int
    genome: int
    delays: int
    changes: int
    patches: int
    boxes: int
    depth: int


@dataclass(slots=True)
class _Codes:
    rows: list[tuple[int, int, float]] = field(default_factory=list)
    depth: int = 1

    def add(self, program: Program) -> tuple[int, int]:
        """Where the program begins, and how long it is."""
        first, depth = len(self.rows), 0
        for name, value in program:
            op = OPERATIONS[name]
            depth += 1 if op <= MEASURE else 0 if op == NEGATE else -1
            self.depth = max(self.depth, depth)
            number = float(value) if op == NUMBER else 0.0
            self.rows.append((op, 0 if op == NUMBER else int(value), number))
        return first, len(self.rows) - first


def build(
    graph: Graph,
    weights: Mapping[str, Floats],
    task: Task,
    master: str,
    learner: str | None,
    addresses: Mapping[str, int],
    library: Array,
) -> tuple[Tables, Sizes]:
    """The tables of a task under a master; `addresses` are those of the compiled procedures, by skill."""
    codes = _Codes()
    reached = reachable(graph, master)
    skills, inputs, edges, shared = _skills(graph, reached, weights, learner, addresses, codes)
    rewards = [_reward(reward, codes) for reward in task.rewards]
    used = _used_sensors(graph, reached, task)
    sensor_rows, rays, ray_row, before = _sensors(graph, used, task)
    measure_rows, changes = _measures(task)
    event_rows, patches = _events(task)
    actuator_rows, delays = _actuators(graph)
    tables = Tables(
        world=_world(graph, task, len(ray_row), used, [s.name for s in graph.skills].index(master)),
        sensors=np.array(sensor_rows, SENSOR),
        rays=rays,
        ray_row=ray_row,
        skills=np.array(skills, SKILL),
        inputs=np.array(inputs, np.int64),
        edges=np.array(edges, EDGE),
        codes=np.array(codes.rows, CODE),
        weights=np.concatenate([np.zeros(0, np.float32), *shared]).astype(np.float32),
        actuators=np.array(actuator_rows, ACTUATOR),
        memories=np.array([_memory(m.start, m.kind) for m in graph.memories], MEMORY),
        things=np.array(_things(graph, task), THING),
        obstacles=np.array(_obstacles(task), OBSTACLE),
        measures=np.array(measure_rows, MEASURES),
        events=np.array(event_rows, EVENT),
        rewards=np.array(rewards, REWARD),
        library=library,
    )
    sizes = Sizes(
        readings=max(1, graph.width),
        skills=len(graph.skills),
        before=before,
        inputs=max([1, *(len(s.inputs) for s in reached)]),
        width=max([1, *(row[6] for row in skills), *(row[4] for row in skills)]),
        genome=genome_length(graph, learner),
        delays=delays,
        changes=changes,
        patches=patches,
        boxes=box_count(task),
        depth=codes.depth,
    )
    return tables, sizes


def genome_length(graph: Graph, learner: str | None) -> int:
    """How many weights the learner has."""
    return next((genes(skill) for skill in graph.skills if skill.name == learner), 0)


def things_of(task: Task) -> list[Thing]:
    """What the task contains but its obstacles."""
    return [thing for thing in task.things if not isinstance(thing.kind, world.Obstacle)]


def obstacles_of(task: Task) -> list[world.Obstacle]:
    """The obstacles of a task."""
    return [thing.kind for thing in task.things if isinstance(thing.kind, world.Obstacle)]


def box_count(task: Task) -> int:
    """How many square obstacles the task's world has."""
    return sum(_lines(task, o) ** 2 if o.grid else o.count for o in obstacles_of(task))


def _lines(task: Task, obstacle: world.Obstacle) -> int:
    gridded = obstacle.grid and isinstance(task.scene, world.Arena)
    return world.grid_lines(task.scene.size, obstacle.grid) if gridded else 0


def _skills(
    graph: Graph,
    reached: Sequence[Skill],
    weights: Mapping[str, Floats],
    learner: str | None,
    addresses: Mapping[str, int],
    codes: _Codes,
) -> tuple[list[Any], list[int], list[Any], list[Floats]]:
    rows: list[Any] = []
    inputs: list[int] = []
    edges: list[Any] = []
    shared: list[Floats] = []
    for skill in reached:
        kind, hidden, width = _function(skill)
        place = sum(len(part) for part in shared)
        rows.append((
            kind, graph.skills.index(skill), len(inputs), len(skill.inputs), skill.outputs, hidden, width, place,
            skill.name == learner, len(edges), len(skill.edges), addresses.get(skill.name, 0),
        ))  # fmt: skip
        inputs.extend(skill.inputs)
        for edge in skill.edges:
            target = edge.target + (len(graph.actuators) if edge.to == "memory" else 0)
            output = -1 if edge.output is None else edge.output
            edges.append((edge.to == "skill", target, output, *codes.add(edge.value)))
        if kind == MLP and skill.name != learner:
            shared.append(weights_of(skill, weights))
    return rows, inputs, edges, shared


def _function(skill: Skill) -> tuple[int, int, int]:
    match skill.function:
        case Mlp(hidden=hidden) as mlp:
            shape = layers(len(skill.inputs), skill.outputs, mlp)
            return MLP, hidden if shape else 0, shape[0][1] if hidden and shape else 0
        case Procedure():
            return PROCEDURE, 0, 0
        case Rule():
            return RULE, 0, 0


def _used_sensors(graph: Graph, reached: Sequence[Skill], task: Task) -> list[Sensor]:
    """The sensors that a reached skill or a reward reads, and what those derive from; sources first."""
    rows = {row for skill in reached for row in skill.inputs}
    for reward in task.rewards:
        programs = [reward.amount] + ([reward.when.left, reward.when.right] if reward.when else [])
        rows |= {int(value) for program in programs for name, value in program if name == "reading"}
        rows |= set(range(reward.each[0], sum(reward.each))) if reward.each else set()
    by_name = {sensor.name: sensor for sensor in graph.sensors}
    ordered: dict[str, Sensor] = {}
    for sensor in graph.sensors:
        if rows.intersection(range(sensor.start, sensor.start + sensor.width)):
            chain = [sensor]
            while isinstance(chain[-1].kind, sensors.Derivative) and chain[-1].kind.of in by_name:
                chain.append(by_name[chain[-1].kind.of])
            for link in reversed(chain):
                ordered.setdefault(link.name, link)
    return list(ordered.values())


def _sensors(graph: Graph, used: Sequence[Sensor], task: Task) -> tuple[list[Any], Array, Array, int]:
    things = {thing.name: i for i, thing in enumerate(things_of(task))}
    starts = {m.name: m.start for m in graph.memories} | {s.name: s.start for s in graph.sensors}
    circular = {s.name for s in graph.sensors if isinstance(s.kind, sensors.Bearing)}
    rows: list[Any] = []
    angles: list[float] = []
    ray_row: list[int] = []
    before = 0
    for sensor in used:
        code, thing, source, reach, dead_zone, gain, period = _sensor(sensor, graph, things, starts)
        turns = isinstance(sensor.kind, sensors.Derivative) and sensor.kind.of in circular
        rows.append((
            code, sensor.start, sensor.width, thing, source, len(angles), before, turns, reach, dead_zone, gain, period
        ))  # fmt: skip
        if isinstance(sensor.kind, sensors.RangeFinder):
            angles.extend(sensor.kind.at)
            ray_row.extend(range(sensor.start, sensor.start + sensor.width))
        before += sensor.width if code == DERIVATIVE else 0
    turn = np.array(angles, np.float64)
    return rows, np.array([np.cos(turn), np.sin(turn)], np.float32), np.array(ray_row, np.int64), before


def _sensor(
    sensor: Sensor, graph: Graph, things: Mapping[str, int], starts: Mapping[str, int]
) -> tuple[int, int, int, float, float, float, float]:
    """(code, thing or −1, source row, range, dead zone, gain, period in ticks)."""
    match sensor.kind:
        case sensors.RangeFinder(range=reach, dead_zone=zone):
            return RANGE, -1, 0, reach, zone, 0.0, 1.0
        case sensors.Bearing(of=of, range=reach, dead_zone=zone):
            return BEARING, things.get(of, -1), 0, reach or inf, zone, 0.0, 1.0
        case sensors.Contact(of=of):
            return CONTACT, things.get(of, -1), 0, 0.0, 0.0, 0.0, 1.0
        case sensors.Held(of=of):
            return HELD, things.get(of, -1), 0, 0.0, 0.0, 0.0, 1.0
        case sensors.Inside(of=of):
            return INSIDE, things.get(of, -1), 0, 0.0, 0.0, 0.0, 1.0
        case sensors.Inertial(range=reach, dead_zone=zone):
            return INERTIAL, -1, 0, 0.0, zone, 1.0 / (INERTIAL_TICKS * graph.tick * reach), 1.0
        case sensors.Battery():
            return BATTERY, -1, 0, 0.0, 0.0, 0.0, 1.0
        case sensors.Derivative(of=of, range=spread, dead_zone=zone):
            return DERIVATIVE, -1, starts[of], 0.0, zone, 0.5 / (graph.tick * spread), 1.0
        case sensors.Sine(period=period):
            return SINE, -1, 0, 0.0, 0.0, 0.0, period / graph.tick


def _actuators(graph: Graph) -> tuple[list[Any], int]:
    rows: list[Any] = []
    ring = 0
    for actuator in graph.actuators:
        code, thrust, reach = _actuator(actuator)
        delay = actuator.kind.delay
        rows.append((code, thrust, actuator.kind.neutral, reach, delay, ring))
        ring += delay
    return rows, ring


def _actuator(actuator: Actuator) -> tuple[int, float, float]:
    match actuator.kind:
        case actuators.Wheel(side=side, thrust=thrust):
            return WHEEL_LEFT if side == "left" else WHEEL_RIGHT, thrust, 0.0
        case actuators.Gripper(reach=reach):
            return GRIPPER, 0.0, reach
        case actuators.Servo():
            return SERVO, 0.0, 0.0


def _memory(start: int, cell: Any) -> tuple[int, float, float, float]:
    return start, cell.decay, 1.0 - cell.decay, cell.start


def _things(graph: Graph, task: Task) -> list[Any]:
    moving = {e.of for e in task.events if isinstance(e, events.Reach | events.Delivery)}
    rows = []
    for thing in things_of(task):
        kind = thing.kind
        code = {world.Item: ITEM, world.Zone: ZONE, world.Power: POWER}[type(kind)]
        size, away = kind.size, kind.away
        low, high = (away.first, away.last) if away.first >= 0 else _default_away(task)
        hold = graph.body.size / 2 + max(size.first, size.last) / 2
        by = nan if size.by is None else size.by
        if size.first == size.last:
            by = 0.0
        rows.append((code, size.first, size.last, by, low, high, hold, thing.name in moving))
    return rows


def _obstacles(task: Task) -> list[Any]:
    rows = []
    for obstacle in obstacles_of(task):
        away, size = obstacle.away, obstacle.size
        low, high = (0.0, inf) if isinstance(task.scene, world.Arena) else (10.0, 40.0)
        low, high = (away.first, away.last) if away.first >= 0 else (low, high)
        lines = _lines(task, obstacle)
        count = 0 if obstacle.grid else obstacle.count
        rows.append((size.first, size.last, obstacle.grid, obstacle.jitter, lines, count, low, high))
    return rows


def _default_away(task: Task) -> tuple[float, float]:
    return (10.0, inf) if isinstance(task.scene, world.Arena) else (10.0, 40.0)


def _measures(task: Task) -> tuple[list[Any], int]:
    names = [thing.name for thing in things_of(task)]
    rows: list[Any] = []
    ring = 0
    for measure in task.measures:
        match measure:
            case measures.Progress(toward=thing):
                rows.append((PROGRESS, names.index(thing), 0.0, 0, 0))
            case measures.Advance(toward=thing):
                rows.append((ADVANCE, names.index(thing), 0.0, 0, 0))
            case measures.Retreat(from_=thing):
                rows.append((RETREAT, names.index(thing), 0.0, 0, 0))
            case measures.Forward():
                rows.append((FORWARD, -1, 0.0, 0, 0))
            case measures.Change(beyond=beyond, over=over):
                rows.append((CHANGE, -1, beyond, max(1, over), ring))
                ring += max(1, over)
    return rows, ring


def _events(task: Task) -> tuple[list[Any], int]:
    names = [thing.name for thing in things_of(task)]
    rows: list[Any] = []
    board = 0
    for i, event in enumerate(task.events):
        kind, thing, columns, patch = COLLISION, -1, 0, 1.0
        match event:
            case events.Reach(of=of):
                kind, thing = REACH, names.index(of)
            case events.Delivery(of=of):
                kind, thing = DELIVERY, names.index(of)
            case events.Visit(size=size):
                assert isinstance(task.scene, world.Arena)
                kind, patch, columns = VISIT, size, int(np.ceil(task.scene.size / size))
            case events.Collision():
                kind = COLLISION
            case events.Exhaustion():
                kind = EXHAUSTION
        rows.append((kind, thing, columns, patch, board, i in task.ends, task.counts.count(i)))
        board += columns * columns
    return rows, board


def _reward(reward: Reward, codes: _Codes) -> tuple[int, ...]:
    first, length = codes.add(reward.amount)
    each, eachs = reward.each or (0, 0)
    left, right, compare = (0, 0), (0, 0), -1
    if reward.when:
        left, right = codes.add(reward.when.left), codes.add(reward.when.right)
        compare = COMPARES[reward.when.compare]
    return first, length, -1 if reward.on is None else reward.on, each, eachs, compare, *left, *right


def _world(graph: Graph, task: Task, rays: int, used: Sequence[Sensor], master: int) -> Array:
    body, dt = graph.body, graph.tick
    radius = body.size / 2
    mass = body.density * pi * radius**2
    moment = mass * radius**2 / 2
    battery = next((s.kind for s in graph.sensors if isinstance(s.kind, sensors.Battery)), sensors.Battery())
    half = task.scene.size / 2 if isinstance(task.scene, world.Arena) else inf
    reach = max([0.0, *(s.kind.range for s in used if isinstance(s.kind, sensors.RangeFinder))])
    drained = any(isinstance(event, events.Exhaustion) for event in task.events)
    powered = drained or any(isinstance(s.kind, sensors.Battery) for s in used)
    inertial = any(isinstance(s.kind, sensors.Inertial) for s in used)
    claw = next((a.kind.reach for a in graph.actuators if isinstance(a.kind, actuators.Gripper)), 1.5)
    row = (
        dt, 1.0 / (1.0 + dt * body.linear_damping), 1.0 / (1.0 + dt * body.angular_damping), mass, moment,
        1.0 / mass, 1.0 / moment, radius, half, task.ticks, battery.start, battery.drain, battery.charge, inertial,
        rays, reach, master, claw, powered,
    )  # fmt: skip
    return np.array([row], WORLD)
