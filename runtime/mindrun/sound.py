"""Whether a graph holds together: the promises that the types of `mindrun.graph` cannot make."""

from collections.abc import Iterator

from mindrun.expression import OPERATORS, is_sound, leaves
from mindrun.functions import Rule
from mindrun.graph import Graph, Program, Skill, Task
from mindrun.sensors import Derivative, RangeFinder


def flaw(graph: Graph) -> str | None:
    """The first thing that is wrong with a graph, if anything is."""
    return next(_flaws(graph), None)


def _flaws(graph: Graph) -> Iterator[str]:
    if graph.tick <= 0:
        yield "its tick is not above zero"
    for noun in (graph.sensors + graph.memories, graph.actuators, graph.skills, graph.tasks):
        names = [part.name for part in noun]
        if len(set(names)) < len(names) or not all(map(str.strip, names)):
            yield f"names are missing or doubled among {', '.join(names)}"
    yield from _sense_flaws(graph)
    skills = {skill.name for skill in graph.skills}
    if graph.master not in skills:
        yield f"its master {graph.master} is not one of its skills"
    for number, skill in enumerate(graph.skills):
        yield from (f"skill {skill.name} {what}" for what in _skill_flaws(graph, number, skill))
    for task in graph.tasks:
        yield from (f"task {task.name} {what}" for what in _task_flaws(graph, task))
    tasks = {task.name for task in graph.tasks}
    for lesson in graph.lessons:
        if not ({lesson.skill, lesson.master} <= skills and lesson.task in tasks):
            yield f"the lesson of {lesson.skill} names what is not there"


def _sense_flaws(graph: Graph) -> Iterator[str]:
    """Readings lie side by side, and each sensor has as many as its kind."""
    start = 0
    widths = {memory.name: 1 for memory in graph.memories} | {sensor.name: sensor.width for sensor in graph.sensors}
    for sensor in graph.sensors:
        match sensor.kind:
            case RangeFinder(at=angles):
                width: int | None = len(angles)
            case Derivative(of=of):
                width = widths.get(of)
            case _:
                width = 1
        if sensor.width != width or sensor.start != start or sensor.width < 1:
            yield f"sensor {sensor.name} has not the readings of its kind"
        start += sensor.width
    yield from (f"sensor {name} is the derivative of itself" for name in _circular(graph))
    if [memory.start for memory in graph.memories] != list(range(start, start + len(graph.memories))):
        yield "the readings of its memories do not follow those of its sensors"


def _circular(graph: Graph) -> Iterator[str]:
    """The sensors whose chain of derivatives never ends."""
    sources = {sensor.name: sensor.kind.of for sensor in graph.sensors if isinstance(sensor.kind, Derivative)}
    for name in sources:
        source = name
        for _ in sources:
            source = sources.get(source, "")
        if source in sources:
            yield name


def _skill_flaws(graph: Graph, number: int, skill: Skill) -> Iterator[str]:
    """A skill reads what there is, and influences only skills after it: parents come first."""
    targets = {
        "skill": range(number + 1, len(graph.skills)),
        "actuator": range(len(graph.actuators)),
        "memory": range(len(graph.memories)),
    }
    if not all(0 <= index < graph.width for index in skill.inputs):
        yield "reads what is not there"
    if not all(edge.target in targets.get(edge.to, ()) for edge in skill.edges):
        yield "sends to what is not there"
    outputs = [edge.output for edge in skill.edges if edge.output is not None]
    if outputs != list(range(len(outputs))) or (outputs and isinstance(skill.function, Rule)):
        yield "has outputs that are not its function's"
    if not all(_computes(edge.value, set(skill.inputs)) for edge in skill.edges if edge.output is None):
        yield "has an expression that cannot be computed"


def _task_flaws(graph: Graph, task: Task) -> Iterator[str]:
    """A task names its own measures and events, and readings that exist."""
    events, readings = range(len(task.events)), set(range(graph.width))
    named = [*task.ends, *task.counts, *(reward.on for reward in task.rewards if reward.on is not None)]
    if not all(event in events for event in named):
        yield "names an event that is not there"
    for reward in task.rewards:
        programs = [reward.amount, *((reward.when.left, reward.when.right) if reward.when else ())]
        if not all(_computes(program, readings, len(task.measures), reward.each is not None) for program in programs):
            yield "has a reward that cannot be computed"
        if reward.when and reward.when.compare not in ("<", "<=", ">", ">="):
            yield "has a condition that cannot be computed"
        if reward.each and not (reward.each[0] >= 0 and 0 < reward.each[1] <= graph.width - reward.each[0]):
            yield "rewards readings that are not there"


def _computes(program: Program, readings: set[int], measures: int = 0, each: bool = False) -> bool:
    """Whether a program has a value, and uses only these readings, measures and, in a loop, the reading at hand."""
    words = {*OPERATORS, "negate", "number", "reading", "measure"} | ({"each"} if each else set())
    return (
        is_sound(program)
        and {word for word, _ in program} <= words
        and all(isinstance(operand, int) for word, operand in program if word != "number")
        and leaves(program, "reading") <= readings
        and leaves(program, "measure") <= set(range(measures))
    )
