"""The flaws of a graph: which promises it breaks that the types of `mindrun.graph.graph` cannot make."""

import re
from collections.abc import Container, Iterator, Sequence
from graphlib import CycleError, TopologicalSorter
from itertools import chain
from math import prod

from mindrun.graph.draws import MAX_VALUES, Draw, intervals_of
from mindrun.graph.graph import Graph, Lesson, Program, Skill, Task
from mindrun.graph.tasks import unfit_thing, varied_kind
from mindrun.kinds.functions.procedure import is_inside
from mindrun.kinds.registry import arguments, varied_quantity
from mindrun.kinds.sensors.sensor import directions
from mindrun.kinds.things.robot import MOST_ROBOTS
from mindrun.kinds.things.thing import MAX_OBSTACLES, MAX_THINGS, ROBOT
from mindrun.numbers.expression import CHOICES, OPERATORS, is_condition, is_valid_program, leaves
from mindrun.numbers.quantity import COORDINATE, NUMBER, SKILL, THING, UNSAID, fits

NAME = re.compile(r"[^\W\d_]\w*([+.]\w+)*")
MAX_SEED, SEED_DIGITS = 2**64 - 1, 20  # the greatest seed of a run, and how many digits it has
MIN_TICK_SECONDS, MAX_TICK_SECONDS = 1e-9, 1e9  # seconds of a tick


def graph_flaw(graph: Graph) -> str | None:
    """The first thing that is wrong with a graph, if anything is."""
    return next(_flaws(graph), None)


def _flaws(graph: Graph) -> Iterator[str]:
    """The flaws of a graph, in an order in which each check may build upon what was right before."""
    if not MIN_TICK_SECONDS <= graph.tick <= MAX_TICK_SECONDS:
        yield f"its tick cannot be {graph.tick:g} s"
    yield from _name_flaws(graph)
    yield from _sense_flaws(graph)
    width = graph.width
    for number, skill in enumerate(graph.skills):
        yield from (f"skill {skill.name} {what}" for what in _skill_flaws(graph, number, skill, width))
    yield from _likeness_flaws(graph)
    for task in graph.tasks:
        if not {thing.master or graph.master for thing in task.things} <= {skill.name for skill in graph.skills}:
            yield f"task {task.name} has a robot under what is no skill"
        if any(unfit_thing(task.things, sensor.kind.things) for sensor in graph.sensors):
            yield f"task {task.name} has things apart that a sensor is about"
        flaws = chain(_task_flaws(task, width, len(graph.actuators)), _variation_flaws(graph, task))
        yield from (f"task {task.name} {what}" for what in flaws)
    skills, tasks = {skill.name for skill in graph.skills}, {task.name: task.events for task in graph.tasks}
    for lesson in graph.lessons:
        yield from lesson_flaws(lesson)
        named = {lesson.skill, lesson.master, lesson.starts_from or lesson.skill}
        events = {None, *tasks.get(lesson.task, ())}
        if not (named <= skills and lesson.task in tasks and {need.event for need in lesson.all_needs} <= events):
            yield f"the lesson of {lesson.skill} names what is not there"


def _name_flaws(graph: Graph) -> Iterator[str]:
    """Names are those that a source can have, so that they can be told; no two of a kind are the same."""
    for noun in (graph.sensors + graph.memories, graph.actuators, graph.skills, graph.tasks):
        names: set[str] = set()
        for part in noun:
            if not NAME.fullmatch(part.name) or part.name in names:
                yield f"there cannot be a part called {part.name!r:.60}" + " twice" * (part.name in names)
            names.add(part.name)
    if graph.master not in {skill.name for skill in graph.skills}:
        yield f"its master {graph.master!r:.60} is not one of its skills"


def is_layout(seed: str) -> bool:
    """True if digits are the seed of a run."""
    return seed.isascii() and seed.isdigit() and len(seed) <= SEED_DIGITS and int(seed) <= MAX_SEED


def lesson_flaws(lesson: Lesson) -> Iterator[str]:
    """The flaws of a lesson by itself."""
    named = (lesson.curriculum, lesson.skill, lesson.task, lesson.master, lesson.starts_from or lesson.skill)
    for name in named:
        if not NAME.fullmatch(name):
            yield f"a lesson cannot name {name!r:.60}"
    if any((need.measure == "event") != bool(need.event) for need in lesson.all_needs):
        yield f"the lesson of {lesson.skill} needs what is not said"
    if lesson.hard and not (lesson.hard.seeds and all(map(is_layout, lesson.hard.seeds))):
        yield f"the lesson of {lesson.skill} has hard layouts that are none"
    if lesson.generations < 1:
        yield f"the lesson of {lesson.skill} has no generation"


def _sense_flaws(graph: Graph) -> Iterator[str]:
    """Readings lie side by side, and each sensor has as many as its kind."""
    start, skills = 0, {skill.name for skill in graph.skills}
    widths = {memory.name: memory.kind.width for memory in graph.memories} | {
        sensor.name: sensor.width for sensor in graph.sensors
    }
    kinds = {sensor.name: sensor.kind for sensor in graph.sensors}
    around = directions(kinds)
    servos = {"", *(actuator.name for actuator in graph.actuators if actuator.kind.carries)}
    for sensor in graph.sensors:
        shape = sensor.kind.shape
        width = widths.get(sensor.kind.source) if shape is None else prod(shape)
        if sensor.width != width or sensor.start != start or sensor.width < 1:
            yield f"sensor {sensor.name} has not the readings of its kind"
        elif not {*filter(None, [sensor.kind.named(SKILL)])} <= skills:
            yield f"sensor {sensor.name} is about a skill that is not there"
        elif (
            not set(sensor.kind.sources) <= widths.keys()
            or sensor.kind.flaw(widths, around)
            or sensor.kind.misfit(kinds)
        ):
            yield f"sensor {sensor.name} cannot be computed"
        if sensor.kind.servo not in servos:
            yield f"sensor {sensor.name} is on {sensor.kind.servo!r:.60}, which is no servo"
        start += sensor.width
    try:
        TopologicalSorter({sensor.name: sensor.kind.sources for sensor in graph.sensors}).prepare()
    except CycleError as error:
        yield f"sensor {error.args[1][0]} is the derivative of itself"
    for memory in graph.memories:
        if memory.start != start:
            yield "the readings of its memories do not follow those of its sensors"
        if not {*memory.kind.sources} <= kinds.keys() or memory.kind.flaw(kinds):
            yield f"memory {memory.name} cannot be reckoned"
        start = memory.place.stop


def _skill_flaws(graph: Graph, number: int, skill: Skill, width: int) -> Iterator[str]:
    """A skill reads what there is, and influences only skills after it: parents come first."""
    targets = {
        "skill": range(number + 1, len(graph.skills)),
        "actuator": range(len(graph.actuators)),
        "memory": range(len(graph.memories)),
    }
    if not all(0 <= index < width for index in skill.inputs):
        yield "reads what is not there"
    if not all(edge.target in targets.get(edge.to, ()) for edge in skill.edges):
        yield "sends to what is not there"
    outputs = [edge.output for edge in skill.edges if edge.output is not None]
    if outputs != list(range(len(outputs))) or (outputs and not skill.function.has_outputs):
        yield "has outputs that are not its function's"
    readings = set(skill.inputs)
    if not all(_computes(program, readings) for edge in skill.edges for program in edge.programs):
        yield "has an expression that cannot be computed"
    if not all(is_condition(edge.gate.when) for edge in skill.edges if edge.gate):
        yield "has a condition that cannot be computed"
    if not all(0 <= edge.cuts <= 1 and (edge.to == "skill" or edge.cuts == 0) for edge in skill.edges):
        yield "cuts what cannot be cut"
    if any(edge.over and (edge.to != "skill" or edge.over != tuple(sorted({*edge.over}))) for edge in skill.edges):
        yield "has influence over what cannot be so"
    if not all(to != "skill" and sink in targets.get(to, ()) for edge in skill.edges for to, sink in edge.over):
        yield "has influence over what is not there"
    if skill.chooses and all(edge.to != "skill" for edge in skill.edges):
        yield "has nothing to choose"
    if not all(is_condition(each.when) and _computes(each.when, range(width)) for each in skill.promises):
        yield "promises what cannot be computed"
    if skill.files and (skill.function.calls is None or not all(map(is_inside, skill.files))):
        yield "uses files that cannot be its"
    if skill.files != tuple(sorted({*skill.files})):
        yield "uses a file twice"


def _likeness_flaws(graph: Graph) -> Iterator[str]:
    """A skill that is like another has a function of its shape, and that other one owns its weights."""
    owners = {skill.name: skill for skill in graph.skills if not skill.like}
    for skill in (skill for skill in graph.skills if skill.like):
        owner = owners.get(skill.like)
        if owner is None or not owner.function.learns:
            yield f"skill {skill.name} is like {skill.like!r:.60}, which owns no weights"
        elif _shape(skill) != _shape(owner) or skill.frozen:
            yield f"skill {skill.name} has not the shape of {owner.name}, which it is like"


def _shape(skill: Skill) -> object:
    """Function, number of inputs, and outputs, which weights have to fit; over what it sends, and that it chooses."""
    return skill.function, skill.chooses, len(skill.inputs), [(edge.output, edge.over) for edge in skill.edges]


def _task_flaws(task: Task, width: int, actuators: int) -> Iterator[str]:
    """A task names its own things, measures and events, and readings that exist."""
    if task.ticks < 1:
        yield "does not last"
    things = [thing.name for thing in task.things]
    if len(set(things)) < len(things) or not all(map(NAME.fullmatch, things)):
        yield "contains what has no name of its own"
    if any(thing.kind.size == UNSAID for thing in task.things):
        yield "contains what has no size"
    about = (*task.events, *task.measures, *(thing.kind for thing in task.things))
    said = (getattr(part, each.field) for part in about for each in arguments(type(part)) if each.type == THING)
    named = {name for name in said if isinstance(name, str)}  # and no region
    if not named - {"", ROBOT} <= {thing.name for thing in task.things if not thing.kind.is_obstacle}:
        yield "names a thing that is not there"
    yield from _world_flaws(task)
    yield from _draw_flaws(task)
    happens = {*(end.event for end in task.ends), *task.counts, *(reward.on for reward in task.rewards)}
    happens |= {tally.event for tally in task.tallies}
    if not happens <= {None, *range(len(task.events))}:
        yield "names an event that is not there"
    others = [event.within.of for event in task.events if event.within]
    if any(other.within or other.is_of_success or other not in task.events for other in others):
        yield "has an event that comes after one that is not there"
    known = range(width), len(task.measures), actuators, len(task.draws)
    yield from _tally_flaws(task, known)
    yield from _reward_flaws(task, width, known)
    in_the_way = {"", *(thing.name for thing in task.things if thing.kind.is_obstacle)}
    for end in task.ends:
        if end.opens not in in_the_way or (end.opens and end.succeeds):
            yield "opens what cannot be opened"
        if (end.event is None) == (end.when is None) or end.times < 1:
            yield "has an end that never comes"
        if end.when is not None and not (
            is_condition(end.when) and _computes(end.when, *known, tallies=len(task.tallies))
        ):
            yield "has an end that cannot be computed"
        if end.event is not None and task.events[end.event].is_of_success:
            yield "ends on its own success"


def _reward_flaws(task: Task, width: int, known: tuple[range, int, int, int]) -> Iterator[str]:
    """A reward can be computed, and only what is paid in each tick is so for each reading."""
    for reward in task.rewards:
        is_each, tallies = reward.each is not None, len(task.tallies)
        if not all(_computes(program, *known, is_each, tallies) for program in reward.programs) or (
            reward.last and is_each
        ):
            yield "has a reward that cannot be computed"
        if reward.when is not None and not is_condition(reward.when):
            yield "has a condition that cannot be computed"
        if reward.each and not (reward.each[0] >= 0 and 0 < reward.each[1] <= width - reward.each[0]):
            yield "rewards readings that are not there"


def _tally_flaws(task: Task, known: tuple[range, int, int, int]) -> Iterator[str]:
    """A tally is about tallies before it, and about no success."""
    for number, tally in enumerate(task.tallies):
        is_sound = all(_computes(program, *known, tallies=number) for program in tally.programs)
        is_sound = is_sound and (tally.when is None or is_condition(tally.when))
        if not is_sound or (tally.event is not None and task.events[tally.event].is_of_success):
            yield "has a tally that cannot be computed"


def _draw_flaws(task: Task) -> Iterator[str]:
    """What is drawn has a name of its own and numbers; a thing is there when these say so, and where they say."""
    names = [draw.name for draw in task.draws]
    if len({*names}) < len(names) or not all(map(NAME.fullmatch, names)):
        yield "draws what has no name of its own"
    for draw in task.draws:
        is_one = not draw.is_range or (len(draw.values) == 2 and draw.values[0] <= draw.values[1])
        if not (is_one and 0 < len(draw.values) <= MAX_VALUES and fits(NUMBER, draw.values)):
            yield f"draws {draw.name} from nothing"
    for thing in task.things:
        if thing.when and not (is_condition(thing.when) and _computes(thing.when, (), draws=len(task.draws))):
            yield "has a thing of which nobody knows whether it is there"
        along = getattr(thing.kind, "along", ())
        coordinates = sum(map(len, along or thing.kind.at))
        is_single = (bool(along) or thing.kind.copies <= 1) and len(thing.by) == coordinates
        if thing.by and not (is_single and all(_is_coordinate(program, task.draws) for program in thing.by)):
            yield "has a thing of which nobody knows where it is"
        drawn = thing.many > 0 and next(iter(task.draws[thing.many - 1 :]), None)
        if thing.many and not (drawn and drawn.is_count and max(drawn.values) <= thing.kind.copies):
            yield "has a thing of which nobody knows how many there are"


def _is_coordinate(program: Program, draws: Sequence[Draw]) -> bool:
    """True if a program is a coordinate whatever is drawn."""
    if not _computes(program, (), draws=len(draws)):
        return False
    return all(fits(COORDINATE, found) for _, found in intervals_of(program, draws))


def _world_flaws(task: Task) -> Iterator[str]:
    """A world has no more than it can look at, and only one with walls has patches."""
    if sum(thing.kind.copies for thing in task.things if not thing.kind.is_obstacle) > MAX_THINGS:
        yield f"contains more than {MAX_THINGS} things"
    if sum(thing.kind.copies for thing in task.things if thing.kind.is_robot) >= MOST_ROBOTS:
        yield f"contains more than {MOST_ROBOTS} robots"
    if any((thing.when or thing.many) if thing.kind.is_robot else thing.master for thing in task.things):
        yield "has robots that are not always there, or a master of something else"
    if sum(thing.kind.obstacles(task.scene) for thing in task.things) > MAX_OBSTACLES:
        yield f"contains more than {MAX_OBSTACLES} obstacles"
    zones = {thing.name for thing in task.things if thing.kind.is_area and not thing.kind.within}
    for kind in (thing.kind for thing in task.things if thing.kind.within):
        if kind.within not in zones and not (len(kind.within) == 2 and fits(COORDINATE, kind.within)):
            yield "has a thing within what is not there"
    if any(kind.or_ and kind.mistake(None) for kind in (thing.kind for thing in task.things)):
        yield "has a thing that cannot be at one of its places"
    if not task.scene.is_bounded and any(event.needs_walls for event in task.events):
        yield "has patches without an arena"


def _variation_flaws(graph: Graph, task: Task) -> Iterator[str]:
    """An argument varies that can, within its bounds, and once; an actuator fails, and once."""
    for each in task.varies:
        kind = varied_kind(graph, task, each)
        quantity = varied_quantity(kind, each.argument) if kind else None
        if quantity is None or not quantity.low <= each.low <= each.high <= quantity.high:
            yield f"varies {each.argument!r:.60} of {each.of!r:.60}, which it cannot"
    if len({(each.noun, each.of, each.argument) for each in task.varies}) < len(task.varies):
        yield "varies something twice"
    failing = [each.actuator for each in task.fails]
    if len({*failing}) < len(failing) or not {*failing} <= {actuator.name for actuator in graph.actuators}:
        yield "has failures of what is no actuator, or twice"


def _computes(
    program: Program,
    readings: Container[int],
    measures: int = 0,
    commands: int = 0,
    draws: int = 0,
    each: bool = False,
    tallies: int = 0,
) -> bool:
    """True if a program has a value, and uses only these readings, measures, commands and, in a loop, the reading."""
    known = {"reading": readings, "measure": range(measures), "command": range(commands), "drawn": range(draws)}
    known["tally"] = range(tallies)
    words = {*OPERATORS, "negate", "number", *known} - {*CHOICES} | ({"each"} if each else set())
    return (
        is_valid_program(program)
        and {word for word, _ in program} <= words
        and all(isinstance(operand, int) for word, operand in program if word != "number")
        and all(index in places for leaf, places in known.items() for index in leaves(program, leaf))
    )
