"""Lines of a .break file → breakpoints of a run: names found, numbers converted, mistakes reported."""

from collections.abc import Iterable, Iterator
from dataclasses import replace

from mindrun.graph.graph import Receiver
from mindrun.graph.skill_sets import reachable
from mindrun.kinds.events.event import EventKind
from mindrun.kinds.registry import kinds
from mindrun.numbers.expression import Program, leaves
from mindrun.numbers.quantity import Quantity

from mindlang.breakpoints.breakpoint import Breakpoint, Happens, Holds, Reaches, Transmission
from mindlang.breakpoints.robot_events import WORDS, RobotEvent, robot_event
from mindlang.breakpoints.subject import Subject
from mindlang.breakpoints.syntax import Line, Moment, Transmits
from mindlang.compiler import lower, model, syntax
from mindlang.compiler.diagnostic import Findings, did_you_mean, listed
from mindlang.compiler.expand import numbers
from mindlang.compiler.expand.amounts import writer
from mindlang.compiler.resolve import expressions
from mindlang.compiler.resolve.quantities import convert
from mindlang.compiler.resolve.tasks import MAX_RUN_TICKS, TIMES, event_in

WEIGHT = Quantity("how much a skill influences", {"": 1.0, "%": 0.01}, low=0, high=1)
NO_NUMBERS = "Write the number itself: a bundle has no names of numbers."
WHICH_TICK = Quantity("the number of a tick", {"": 1.0}, low=1, high=MAX_RUN_TICKS, whole=True)


def resolve(lines: Iterable[Line], subject: Subject, findings: Findings) -> tuple[Breakpoint, ...]:
    """The breakpoints of the lines; what is wrong with the others is reported."""
    findings.numbers = subject.names.numbers.keys()
    written_out = writer(numbers(subject.names, Findings()), subject.graph.tick)
    found = tuple(_breakpoints(map(written_out, lines), subject, findings))
    if subject.is_recorded:
        findings.diagnostics = [
            replace(each, hint=NO_NUMBERS) if each.code == "unknown-number" else each for each in findings.diagnostics
        ]
    return found


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
    """An event that somebody notices in what is stopped."""
    count = convert(times, TIMES, findings) if times else 0
    event = _event(written, subject, findings)
    return None if event is None or count is None else Happens(event, int(count))


def _event(written: syntax.Phrase, subject: Subject, findings: Findings) -> EventKind | RobotEvent | None:
    word = written.kind.text
    if word in WORDS:
        return robot_event(written, subject.sensors, findings)
    near = did_you_mean(word, WORDS)
    if subject.sensors is not None and word not in kinds("event") and (near or subject.task is None):
        hint = near or "What happens to a robot is stopped, fault, and fault of SENSOR."
        findings.error("unknown-kind", written.kind.span, f"There is no kind of event called {word}.", hint)
        return None
    return _world_event(written, subject, findings)


def _world_event(written: syntax.Phrase, subject: Subject, findings: Findings) -> EventKind | None:
    """An event that the task notices, or could without becoming another world."""
    if subject.task is None or subject.world is None:
        hint = "Write a condition, such as stop when holding > 0.5, or what it does record: stopped, fault of SENSOR."
        message = "A robot does not record what happens in the world around it."
        findings.error("impossible-event", written.span, message, hint)
        return None
    event: EventKind | None = event_in(written, subject.world, findings)
    if event and subject.is_recorded and event not in subject.task.events:
        hint = "Write a condition instead; only events of which a line of the task speaks are recorded."
        findings.error("unnoticed-event", written.span, f"Task {subject.task.name} did not notice this event.", hint)
        return None
    if event and event.outcome and event not in subject.task.events:
        message = f"No line of task {subject.task.name} speaks of this event, so nobody looks for it."
        hint = f"Add the line counts {' '.join(written.span.text.split())} to the task."
        findings.error("unnoticed-event", written.span, message, hint)
        return None
    return event


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
    asked = leaves(program, "reading")
    for name in subject.unmeasured:
        if subject.places.readings[name][0] in asked:
            hint = f"Name a sensor that a skill below {subject.master} or a reward reads, or that is wired."
            findings.error("unmeasured-reading", when.span, f"Nobody measures {name} in this run.", hint)
    transmissions = tuple(places.measures)
    return Holds(program, transmissions, tuple(_named(program, transmissions, subject)))


def _transmits(written: Transmits, subject: Subject, findings: Findings) -> model.Comparison:
    """`SKILL influences NAME above AMOUNT`, the weight on the left."""
    names = subject.names
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
        if (word, operand) in words:
            yield words[word, int(operand)], (word, int(operand))
