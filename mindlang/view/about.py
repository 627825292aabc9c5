"""Plain data of a run for a page: its hierarchy and its world, which do not change, and the events that can happen."""

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

from mindrun.engine.engine import scene_of
from mindrun.graph.graph import Graph, Skill, Task
from mindrun.graph.named_readings import named_places, reading_names, servo_reading
from mindrun.graph.policy import Policy
from mindrun.graph.recording_header import About
from mindrun.graph.tasks import robots_in, things_of
from mindrun.kinds.registry import names
from mindrun.robot.hand import hand_on
from mindrun.sim.numbering import opened_boxes, robot_numbers

from mindlang.pictures.scene import half_sides, thing_colours
from mindlang.pictures.theme import NIGHT, PAPER, code
from mindlang.run import outcome
from mindlang.run.promises import VERDICTS
from mindlang.view.messages import shown
from mindlang.view.rows import Columns
from mindlang.weights.links import links_of

Texts = Mapping[tuple[str, str], str]  # what a line says, by the names of its skill and of whom it is for
Data = dict[str, Any]
TOUCH, COLLISION = "touch", "collision"  # kinds of events
PROMISE_COLUMNS = 1 + len(VERDICTS)  # of each promise: the verdict in a tick, and how often each came so far


class PlacedNode(NamedTuple):
    """A node of the hierarchy, and where its values are: the `places` in a group of columns."""

    name: str
    kind: object
    group: str
    places: Sequence[int]


def about_data(
    of: About, policy: Policy, task: Task | None, skills: Sequence[Skill], columns: Columns, texts: Texts
) -> Data:
    """The constant data of rows with these columns; `skills` are those below the master, parents first."""
    graph = policy.graph
    rewards = [reward.text for reward in task.rewards] if task else []
    has_robot, held = not (task and task.scene.environment), hand_on(graph, of.master, of.by_hand).held
    return {
        "master": shown(of.master),
        "tick": of.tick,
        "task": shown(task.name) if task else None,
        "seed": str(of.world.seed) if task and of.world else None,
        "robot": of.world.robot if of.world else 0,
        "robots": robots_in(task) if task else 1,
        "rewards": [shown(text) for text in rewards],
        "ends": [shown(text) for text in outcome.ends(task)] if task else [],
        "world": _world(graph, task, of, columns) if task and of.world and has_robot else None,
        "by_hand": [{"name": name, "neutral": each.neutral, "role": each.role} for name, each in held.items()],
        "curves": _curves(graph, skills, columns, rewards, has_robot),
        **_hierarchy(graph, of, skills, columns, texts),
        "links": [_links(policy, skill) for skill in skills if skill.function.grows],
    }


def _links(policy: Policy, skill: Skill) -> Data:
    """The network of a skill that grew: `nodes` with what they are, and `links` from one to another, with a weight."""
    links = links_of(policy.graph, skill, policy.weights[skill.like or skill.name])
    numbers = {name: number for number, name in enumerate(links)}
    return {
        "skill": shown(skill.name),
        "nodes": [{"name": shown(name), "role": role} for name, role in links.nodes(data="role")],
        "links": [[numbers[source], numbers[to], weight] for source, to, weight in links.edges(data="weight")],
    }


def _nodes(graph: Graph, skills: Sequence[Skill], by_hand: Sequence[str]) -> dict[tuple[str, int], PlacedNode]:
    """The nodes by noun and place there: sensors, memories, the skills that are reached, actuators.

    An actuator that is `by_hand` has the command that it was sent, and every other that of the mind.
    """
    found: dict[tuple[str, int], PlacedNode] = {}
    at = named_places(graph)
    for place, sensor in enumerate(graph.sensors):
        found["sensor", place] = PlacedNode(sensor.name, sensor.kind, "readings", at[sensor.name])
    for place, cell in enumerate(graph.memories):
        found["memory", place] = PlacedNode(cell.name, cell.kind, "readings", at[cell.name])
    for place, skill in enumerate(graph.skills):
        if skill in skills:
            found["skill", place] = PlacedNode(skill.name, skill.function, "influence", [place])
    for place, actuator in enumerate(graph.actuators):
        found["actuator", place] = PlacedNode(
            actuator.name, actuator.kind, _acting_group(actuator.name, by_hand), [place]
        )
    return found


def _acting_group(actuator: str, by_hand: Sequence[str]) -> str:
    return "sent" if actuator in by_hand else "commands"


def _hierarchy(graph: Graph, of: About, skills: Sequence[Skill], columns: Columns, texts: Texts) -> Data:
    """`nodes`, `edges` and `reads`."""
    nodes = _nodes(graph, skills, of.by_hand)
    numbers = {node: number for number, node in enumerate(nodes)}
    places = [("sensor", number, each.place) for number, each in enumerate(graph.sensors)]
    places += [("memory", number, each.place) for number, each in enumerate(graph.memories)]
    read_from = {row: numbers[noun, number] for noun, number, at in places for row in range(at.start, at.stop)}
    own = {skill.name: numbers["skill", graph.skill_numbers[skill.name]] for skill in skills}
    promises = _promises(skills, columns)
    return {
        "nodes": [
            {
                "name": shown(node.name),
                "kind": noun,
                "says": names().get(type(node.kind), ""),
                "columns": [columns[node.group].column(place) for place in node.places],
                "master": noun == "skill" and node.name == of.master,
                "chooses": noun == "skill" and graph.skills[place].chooses,
                "promises": promises.get(node.name, []) if noun == "skill" else [],
            }
            for (noun, place), node in nodes.items()
        ],
        "edges": [
            {
                "from": own[skill.name],
                "to": numbers[edge.to, edge.target],
                "over": [numbers[sink] for sink in edge.over],
                "text": shown(texts.get((skill.name, graph.named(edge.to, edge.target)), "").strip()),
            }
            for skill in skills
            for edge in skill.edges
        ],
        "reads": [
            [source, own[skill.name]]
            for skill in skills
            for source in dict.fromkeys(read_from[reading] for reading in skill.inputs)
        ],
    }


def _promises(skills: Sequence[Skill], columns: Columns) -> dict[str, list[Data]]:
    promises = [(skill.name, promise) for skill in skills for promise in skill.promises]
    found: dict[str, list[Data]] = {}
    for number, (skill, promise) in enumerate(promises):
        places = range(number * PROMISE_COLUMNS, (number + 1) * PROMISE_COLUMNS)
        of = [columns["promises"].column(place) for place in places]
        found.setdefault(skill, []).append({"text": shown(promise.text), "columns": of})
    return found


def order_data(graph: Graph) -> list[Data]:
    """The orders that the mind takes: the name of each, its node, and of what it is one."""
    kinds: dict[int, Any] = {node: each.kind for node, each in enumerate(graph.sensors) if each.kind.is_order}
    return [
        {"name": graph.sensors[node].name, "node": node, "choices": kind.choices}
        | {"low": kind.order.first, "high": kind.order.last}
        for node, kind in kinds.items()
    ]


def _curves(
    graph: Graph, skills: Sequence[Skill], columns: Columns, rewards: Sequence[str], has_robot: bool
) -> list[Data]:
    """Every column that can be drawn over time, by name; in `circular` ones (directions) no line leads from 1 to 0."""
    reached, scene = {skill.name for skill in skills}, scene_of(graph)
    circular = {scene.starts[name] for name in scene.directions}
    named: list[tuple[str, str, list[tuple[int, str]]]] = [
        ("reading", "readings", [*enumerate(reading_names(graph))]),
        ("influence", "influence", [(i, s.name) for i, s in enumerate(graph.skills) if s.name in reached]),
        ("command", "commands", [*enumerate(actuator.name for actuator in graph.actuators)]),
        ("command", "sent", [*enumerate(f"{actuator.name}, sent" for actuator in graph.actuators)]),
        ("reward", "rewards", [*enumerate(rewards)]),
        ("world", "robot", [*enumerate(("x", "y", "angle"))]),
        ("world", "battery", [(0, "battery")]),
    ]
    return [
        {"name": shown(name), "group": group, "column": columns[of].column(place)}
        | {"circular": of == "readings" and place in circular}
        for group, of, each in named
        if of in columns and (has_robot or group != "world")
        for place, name in each
    ]


def _world(graph: Graph, task: Task, of: About, columns: Columns) -> Data:
    """The arena, what stands in it, its things with their colours, and the robot; lengths in units, angles in rad."""
    contents = things_of(task)
    colours = zip(thing_colours(contents, PAPER), thing_colours(contents, NIGHT), strict=True)
    assert of.world
    body, opened, world = graph.body, opened_boxes(task), of.world
    robots = robot_numbers(task)
    standing = [(number, box) for number, box in enumerate(world.boxes) if box]
    return {
        "arena": [*half_sides(task.scene)] if task.scene.is_bounded else None,
        "boxes": [[*box] for _, box in standing],
        "doors": [place for place, (number, _) in enumerate(standing) if number in opened],
        "things": [
            {
                "name": shown(thing.name),
                "kind": names()[type(thing.kind)],
                "shape": "area" if thing.kind.is_area else "disc" if thing.kind.is_round else "square",
                "light": code(light),
                "dark": code(dark),
                "robot": robots.get(row),
            }
            for row, (thing, (light, dark)) in enumerate(zip(contents, colours, strict=True))
        ],
        "robot": {
            "radius": body.radius,
            "outline": [[*corner] for corner in body.outline],
            "front": body.front,
            "side": body.side,
            "axles": body.axle_distance,
            **_sensing(graph, columns),
            **_acting(graph, columns, of.by_hand),
        },
    }


def _sensing(graph: Graph, columns: Columns) -> Data:
    """Rays, points of the floor, switches on the rim, and directions of things, each with the column it reads."""
    found: dict[str, list[Data]] = {"rays": [], "spots": [], "switches": [], "bearings": []}
    for sensor in graph.sensors:
        kind, name = sensor.kind, shown(sensor.name)
        read = [columns["readings"].column(sensor.start + number) for number in range(sensor.width)]
        told = servo_reading(graph, kind)
        if kind.servo and told is None:
            continue  # nobody knows where it looks
        turned = None if told is None else columns["readings"].column(told)
        for angle, column in zip(kind.rays, read, strict=False):
            ray = {"angle": angle, "rim": graph.body.rim(angle), "reach": kind.reach, "column": column}
            ray["turned"] = turned
            found["rays"].append({**ray, "name": name, "sees": bool(kind.thing)})
        found["spots"] += [{"x": x, "y": y, "column": at} for (x, y), at in zip(kind.spots, read, strict=False)]
        for angle, column in zip(kind.directions if kind.sector else (), read, strict=False):
            found["switches"].append({"angle": angle, "width": kind.sector, "column": column})
        if kind.circular and kind.thing:
            found["bearings"].append({"name": name, "column": read[0], "turned": turned})
    return found


def _acting(graph: Graph, columns: Columns, by_hand: Sequence[str]) -> Data:
    """The claw, the wheels that turn, lamps and thrusters, each with the column of its command."""
    found: Data = {"claw": None, "steering": None, "lamps": [], "jets": []}
    for number, actuator in enumerate(graph.actuators):
        kind, column = actuator.kind, columns[_acting_group(actuator.name, by_hand)].column(number)
        if kind.is_light:
            found["lamps"].append(column)
        if (push := kind.push(graph.body)) is not None:
            found["jets"].append({"at": [*push[0]], "way": [*push[1]], "column": column})
        if kind.can_hold:
            found["claw"] = column
        if kind.drive == "steering":
            found["steering"] = {"column": column, "turn": kind.row(graph.body)["turn"]}
    return found


def world_event_data(task: Task) -> list[dict[str, str]]:
    """The texts and kinds of a task's events; touching is one, unless an event says it or there is nothing to touch."""
    kinds = [names()[type(event)] for event in task.events]
    found = [{"text": shown(text), "kind": kind} for text, kind in zip(outcome.events(task), kinds, strict=True)]
    is_said = COLLISION in kinds or task.scene.environment
    return found if is_said else [*found, {"text": TOUCH, "kind": TOUCH}]


def robot_event_data(of: About) -> list[dict[str, str]]:
    return [
        {"text": "stopped", "kind": "stopped"},
        {"text": "began anew", "kind": "begin"},
        *({"text": shown(f"fault of {name}"), "kind": "fault"} for name in of.sensors),
    ]
