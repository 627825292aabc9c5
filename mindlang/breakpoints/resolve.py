"""Lines of a .break file → breakpoints of a run: names found, numbers converted, mistakes reported."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from functools import cached_property

from mindrun.expression import Program
from mindrun.graph import Graph, Receiver, Task
from mindrun.quantity import Quantity
from mindrun.weights import reachable

from mindlang.breakpoints.breakpoint import Breakpoint, Happens, Holds, Reaches, Transmission
from mindlang.breakpoints.syntax import Line, Moment, Transmits
from mindlang.compiler import lower, model, syntax
from mindlang.compiler.diagnostic import Findings, listed
from mindlang.compiler.expand import numbers
from mindlang.compiler.expand.amounts import writer
from mindlang.compiler.names import things_of
from mindlang.compiler.resolve import expressions
from mindlang.compiler.resolve.kinds import Scope
from mindlang.compiler.resolve.quantities import convert
from mindlang.compiler.resolve.tasks import MAX_RUN_TICKS, TIMES, World, event_in

WEIGHT = Quantity("how much a skill influences", {"": 1.0, "%": 0.01}, low=0, high=1)
WHICH_TICK = Quantity("the number of a tick", {"": 1.0}, low=1, high=MAX_RUN_TICKS, whole=True)


@dataclass(frozen=True)
class Subject:
    """The run that breakpoints are about: a mind and its graph, who is in charge, and the task.

    None is the task where a robot recorded what it read and thought.
    """

    mind: model.Mind
    graph: Graph
    master: str
    task: Task | None

    @cached_property
    def places(self) -> lower.Places:
        """Where the readings and the commands stand in a row."""
        readings = {each.name: (each.start, each.width) for each in self.graph.sensors}
        readings |= {each.name: (each.start, 1) for each in self.graph.memories}
        return lower.Places(readings, {each.name: place for place, each in enumerate(self.graph.actuators)})

    @cached_property
    def world(self) -> World | None:
        """What the task says of its world."""
        if self.task is None:
            return None
        name = self.task.name
        task = next(task for task in self.mind.tasks if task.name == name)
        things = things_of(replace(task.declaration, facts=task.facts))
        scope = Scope(self.mind.names, things, f"task {name}", root=self.mind.files[0].source.folder)
        battery = any(sensor.kind.battery for sensor in self.mind.sensors)
        return World(task.scene, task.things, scope, battery, self.task.can_succeed)


def resolve(lines: Iterable[Line], subject: Subject, findings: Findings) -> tuple[Breakpoint, ...]:
    """The breakpoints of the lines; what is wrong with the others is reported."""
    mind = subject.mind
    findings.numbers = mind.names.numbers.keys()
    written_out = writer(numbers(mind.names, Findings()), mind.tick)
    return tuple(_breakpoints(map(written_out, lines), subject, findings))


def _breakpoints(lines: Iterable[Line], subject: Subject, findings: Findings) -> Iterator[Breakpoint]:
    for line in lines:
        before = len(findings.diagnostics)
        cause = _cause(line, subject, findings)
        if cause and len(findings.diagnostics) == before:
            yield Breakpoint(line.span.line, " ".join(line.span.text.split()), cause)


def _cause(line: Line, subject: Subject, findings: Findings) -> Holds | Happens | Reaches | None:
    match line:
        case Moment(tick):
            last = subject.task.ticks if subject.task else MAX_RUN_TICKS
            number = convert(tick, replace(WHICH_TICK, high=last), findings)
            return None if number is None else Reaches(int(number))
        case syntax.Ends(times, event, None):
            return _happens(times, event, subject, findings) if event else None
    return _holds(line.when, subject, findings) if line.when else None


def _happens(
    times: syntax.Amount | None, written: syntax.Phrase, subject: Subject, findings: Findings
) -> Happens | None:
    """An event that the run's task notices, or could without becoming another world."""
    if subject.task is None or subject.world is None:
        hint = "Events are noticed by the simulator; write a condition, such as stop when holding > 0.5."
        findings.error("impossible-event", written.span, "What a robot has recorded has no events.", hint)
        return None
    count = convert(times, TIMES, findings) if times else 0
    event = event_in(written, subject.world, findings)
    if event and event.outcome and event not in subject.task.events:
        message = f"No line of task {subject.task.name} speaks of this event, so nobody looks for it."
        hint = f"Add the line counts {' '.join(written.span.text.split())} to the task."
        findings.error("unnoticed-event", written.span, message, hint)
        return None
    return None if event is None or count is None else Happens(event, int(count))


def _holds(when: syntax.When, subject: Subject, findings: Findings) -> Holds:
    widths = {name: width for name, (_, width) in subject.places.readings.items()}
    visible = expressions.Visible(
        widths,
        commands=frozenset(subject.places.actuators),
        made_of="numbers, readings, memories and the commands of actuators",
        where="What a run stops at",
    )

    def compared(each: syntax.Comparison | Transmits) -> model.Comparison:
        if isinstance(each, Transmits):
            return _transmits(each, subject, findings)
        left, right = (expressions.resolve(side, visible, findings) for side in (each.left, each.right))
        return model.Comparison(left, each.compare, right)

    before = len(findings.diagnostics)
    found = model.When(tuple(tuple(map(compared, all_)) for all_ in when.alternatives), when.span)
    if len(findings.diagnostics) > before:
        return Holds((), (), ())
    places = replace(subject.places, measures={})
    program = lower.condition(found, places)
    transmissions = tuple(places.measures)
    return Holds(program, transmissions, tuple(_named(program, transmissions, subject)))


def _transmits(written: Transmits, subject: Subject, findings: Findings) -> model.Comparison:
    """`SKILL influences NAME above AMOUNT`, the weight on the left."""
    names = subject.mind.names
    level = convert(written.amount, WEIGHT, findings)
    skill = names.find(written.skill, ("skill",), findings)
    is_skill = written.to.text.rpartition(".")[2][:1].isupper()
    nouns: tuple[Receiver, ...] = ("skill",) if is_skill else ("actuator", "memory")
    to = names.find(written.to, nouns, findings)
    terms: tuple[model.Term, ...] = ()
    if skill and to and (found := _transmission(written, to, subject, findings)):
        terms = (model.Measured(found, written.span),)
    right = model.Expression((model.Number(float(level or 0), written.amount.span),), written.amount.span)
    return model.Comparison(model.Expression(terms, written.span), "<" if written.level == "below" else ">", right)


def _transmission(written: Transmits, to: Receiver, subject: Subject, findings: Findings) -> Transmission | None:
    skills = [skill.name for skill in subject.graph.skills]
    targets = {
        "skill": skills,
        "actuator": [actuator.name for actuator in subject.graph.actuators],
        "memory": [memory.name for memory in subject.graph.memories],
    }
    skill, target = written.skill.text, written.to.text
    found = Transmission(skills.index(skill), to, targets[to].index(target))
    reached = [each.name for each in reachable(subject.graph, subject.master)]
    senders = [
        each.name
        for each in subject.graph.skills
        if each.name in reached and any((edge.to, edge.target) == (found.to, found.target) for edge in each.edges)
    ]
    if skill in senders:
        return found
    if skill not in reached:
        hint = f"{subject.master} is in charge of the run, and influences it by no path."
        findings.error("skill-not-in-run", written.skill.span, f"{skill} takes no part in this run.", hint)
        return None
    sends = "influences" if to == "skill" else "drives"
    hint = f"What {sends} {target} is {listed(senders, 'and')}." if senders else f"Nothing {sends} {target} here."
    findings.error("no-edge", written.to.span, f"{skill} sends nothing to {target} itself.", hint)
    return None


def _named(
    program: Program, transmissions: tuple[Transmission, ...], subject: Subject
) -> Iterator[tuple[str, tuple[str, int]]]:
    """What a condition is about, each as it is written and with its word and operand in the program, once."""
    words = {("reading", start): name for name, (start, _) in subject.places.readings.items()}
    words |= {("command", place): name for name, place in subject.places.actuators.items()}
    for number, each in enumerate(transmissions):
        skill, target = subject.graph.skills[each.skill].name, subject.graph.named(each.to, each.target)
        words["measure", number] = f"{skill} influences {target}"
    for word, operand in dict.fromkeys(program):
        if (word, int(operand)) in words and word != "number":
            yield words[word, int(operand)], (word, int(operand))
