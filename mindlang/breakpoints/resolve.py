"""A .break file → breakpoints of a run: its lines parsed by the compiler, names found, numbers converted."""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path

from mindrun.graph.graph import Receiver
from mindrun.graph.skill_sets import reachable
from mindrun.kinds.events.event import EventKind
from mindrun.kinds.registry import kinds
from mindrun.numbers.expression import Program, leaves
from mindrun.numbers.quantity import Quantity

from mindlang.breakpoints.breakpoint import (
    FAULT,
    OF,
    ROBOT_WORDS,
    STOPPED,
    Breakpoint,
    Happens,
    Holds,
    Reaches,
    RobotEvent,
    Transmission,
)
from mindlang.breakpoints.subject import BreakpointSubject
from mindlang.compiler import lower
from mindlang.compiler.compile import read_main
from mindlang.compiler.diagnostic import Diagnostic, Findings, did_you_mean, listed
from mindlang.compiler.expand import number_values, number_writer
from mindlang.compiler.parse import parse_stops
from mindlang.compiler.resolve.expressions import Visible, resolve_expressions
from mindlang.compiler.resolve.kinds import a_name
from mindlang.compiler.resolve.quantities import MAX_RUN_TICKS, TIMES, convert
from mindlang.compiler.resolve.tasks import event_in
from mindlang.compiler.source import Source, Span
from mindlang.compiler.syntax import Comparison, Expression, Phrase, Stop, Term, Transmits, When, rebuilt

WEIGHT = Quantity("how much a skill influences", {"": 1.0, "%": 0.01}, low=0, high=1)
WHICH_TICK = Quantity("the number of a tick", {"": 1.0}, low=1, high=MAX_RUN_TICKS, whole=True)
NO_NUMBERS = "Write the number itself: a bundle has no names of numbers."


@dataclass(frozen=True, slots=True)
class BreakpointFile:
    """A .break file that was read; where anything is wrong in it, the diagnostics say so."""

    breakpoints: tuple[Breakpoint, ...]
    diagnostics: tuple[Diagnostic, ...]


def load_breakpoints(path: Path | str, subject: BreakpointSubject | None) -> BreakpointFile:
    """ "-" is standard input."""
    source = read_main(path)
    return BreakpointFile((), (source,)) if isinstance(source, Diagnostic) else breakpoints_of(source, subject)


def breakpoints_of(source: Source, subject: BreakpointSubject | None) -> BreakpointFile:
    """The breakpoints of a text; none where nobody knows what they are about, and its lines are only read."""
    findings = Findings()
    lines = parse_stops(source, findings)
    if not lines and not findings.diagnostics:
        hint = "Write a line such as stop on collision."
        findings.error("empty-file", Span(source, 0, 0), "There is nothing in this file.", hint)
    found = tuple(_Resolver(subject, findings).breakpoints(lines)) if subject else ()
    in_order = sorted(findings.diagnostics, key=lambda each: each.span.start if each.span else -1)
    if subject and subject.is_recorded:
        in_order = [replace(each, hint=NO_NUMBERS) if each.code == "unknown-number" else each for each in in_order]
    return BreakpointFile(found, tuple(in_order))


@dataclass(frozen=True, slots=True)
class _Resolver:
    """Resolves the lines of a .break file against their subject, and notes what is wrong with them."""

    subject: BreakpointSubject
    findings: Findings

    def breakpoints(self, lines: list[Stop]) -> Iterator[Breakpoint]:
        names = self.subject.names
        self.findings.numbers = names.numbers.keys()
        for line in map(number_writer(names, number_values(names, Findings()), self.subject.graph.tick), lines):
            before = len(self.findings.diagnostics)
            cause = self._cause(line)
            if cause and len(self.findings.diagnostics) == before:
                yield Breakpoint(line.span.line, " ".join(line.span.text.split()), cause)

    def _cause(self, line: Stop) -> Holds | Happens | Reaches | None:
        if line.when:
            return self._holds(line.when)
        if line.event:
            times = convert(line.times, TIMES, self.findings) if line.times else 0
            event = self._event(line.event)
            return None if event is None or times is None else Happens(event, int(times))
        last = self.subject.task.ticks if self.subject.task else MAX_RUN_TICKS
        tick = convert(line.tick.amount, replace(WHICH_TICK, high=last), self.findings) if line.tick else None
        return None if tick is None else Reaches(int(tick))

    def _event(self, written: Phrase) -> EventKind | RobotEvent | None:
        """The event of a line, of a robot or of the world; None after reporting that there can be none."""
        word = written.kind.text
        if word in ROBOT_WORDS:
            return self._robot_event(written)
        near = did_you_mean(word, ROBOT_WORDS)
        is_of_robot = self.subject.sensors is not None and (near or self.subject.task is None)
        if is_of_robot and word not in kinds("event"):
            hint = near or "What happens to a robot is stopped, fault, and fault of SENSOR."
            self.findings.error("unknown-kind", written.kind.span, f"There is no kind of event called {word}.", hint)
            return None
        return self._world_event(written)

    def _robot_event(self, written: Phrase) -> RobotEvent | None:
        word, said, sensors = written.kind.text, written.arguments, self.subject.sensors
        if sensors is None:
            hint = "It is for the recording of one: mindc view day.rec NAME.bundle --break FILE."
            message = f"{word} is what happens to a robot, not in the simulator."
            self.findings.error("impossible-event", written.span, message, hint)
        elif written.within:
            message = f"{word} of a robot comes after no other event."
            self.findings.error("within", written.within.span, message, "Leave it out.")
        elif not said:
            return RobotEvent(word)
        elif word == STOPPED:
            message = f"{word} takes no arguments."
            self.findings.error("unknown-argument", written.span, message, f"Write stop on {word}.")
        elif len(said) > 1 or said[0].key.text != OF:
            hint = f"Write stop on {FAULT} of SENSOR."
            self.findings.error("unknown-argument", written.span, f"{word} takes of and the name of a sensor.", hint)
        elif name := a_name(said[0], "Here stands the name of a sensor.", self.findings):
            if name.text in sensors:
                return RobotEvent(word, name.text)
            wired = f"Wired are {listed(sensors, 'and')}." if sensors else "No sensor of this robot is wired."
            hint = self.findings.suggest(name.text, sensors) or wired
            message = f"The robot has no wired sensor called {name.text}."
            self.findings.error("unknown-sensor", name.span, message, hint)
        return None

    def _world_event(self, written: Phrase) -> EventKind | None:
        """An event that the task notices, or could without becoming another world."""
        task, world = self.subject.task, self.subject.world
        if task is None or world is None:
            hint = "Write a condition, as stop when holding > 0.5, or what it does record: stopped, fault of SENSOR."
            message = "A robot does not record what happens in the world around it."
            self.findings.error("impossible-event", written.span, message, hint)
            return None
        event: EventKind | None = event_in(written, world, self.findings)
        if event is None or event in task.events:
            return event
        if not self.subject.is_recorded and all(of in task.events or not of.outcome for of in event.single):
            return event
        message = f"No line of task {task.name} speaks of this event, so nobody looks for it."
        hint = f"Add the line counts {' '.join(written.span.text.split())} to the task."
        if self.subject.is_recorded:
            message = f"Task {task.name} did not notice this event."
            hint = "Write a condition instead; only events of which a line of the task speaks are recorded."
        self.findings.error("unnoticed-event", written.span, message, hint)
        return None

    def _holds(self, when: When) -> Holds:
        places = replace(self.subject.places, measures={})
        widths = {name: width for name, (_, width) in places.readings.items()}
        visible = Visible(
            widths,
            commands=frozenset(places.actuators),
            draws=self.subject.draws,
            made_of="numbers, readings, memories and the commands of actuators",
            where="What a run stops at",
        )

        before = len(self.findings.diagnostics)
        compared: When = rebuilt(when, lambda node: self._transmits(node) if isinstance(node, Transmits) else node)
        found = resolve_expressions(compared, visible, self.findings)
        if len(self.findings.diagnostics) > before:
            return Holds((), (), ())
        program = lower.program_of(found, places)
        asked = leaves(program, "reading")
        for name in self.subject.unmeasured:
            if places.readings[name][0] in asked:
                hint = f"Name a sensor that a skill below {self.subject.master} or a reward reads, or that is wired."
                message = f"Nobody measures {name} in this run."
                self.findings.error("unmeasured-reading", when.span, message, hint)
        transmissions = tuple(places.measures)
        return Holds(program, transmissions, tuple(_named(program, transmissions, self.subject)))

    def _transmits(self, written: Transmits) -> Comparison:
        """`SKILL influences NAME above AMOUNT`, the weight on the left."""
        level = convert(written.amount, WEIGHT, self.findings)
        skill = self.subject.names.find(written.skill, ("skill",), self.findings)
        is_skill = written.to.text.rpartition(".")[2][:1].isupper()
        nouns: tuple[Receiver, ...] = ("skill",) if is_skill else ("actuator", "memory")
        to = self.subject.names.find(written.to, nouns, self.findings)
        found = self._transmission(written, to) if skill and to else None
        left = Expression((Term("measure", found, written.span),), written.span)
        right = Expression((Term("number", float(level or 0), written.amount.span),), written.amount.span)
        return Comparison(left, "<" if written.level == "below" else ">", right, written.span)

    def _transmission(self, written: Transmits, to: Receiver) -> Transmission | None:
        """The transmission of a skill of the run to a target over its own edges; None after reporting an error."""
        graph, skill, target = self.subject.graph, written.skill.text, written.to.text
        targets = {"skill": len(graph.skills), "actuator": len(graph.actuators), "memory": len(graph.memories)}
        index = next(place for place in range(targets[to]) if graph.named(to, place) == target)
        running = {each.name for each in reachable(graph, self.subject.master)}
        senders = [
            each.name
            for each in graph.skills
            if each.name in running and any((edge.to, edge.target) == (to, index) for edge in each.edges)
        ]
        if skill in senders:
            return Transmission(graph.skill_numbers[skill], to, index)
        if skill not in running:
            hint = f"{self.subject.master} is in charge of the run, and influences it by no path."
            self.findings.error("skill-not-in-run", written.skill.span, f"{skill} takes no part in this run.", hint)
            return None
        sends = "influences" if to == "skill" else "drives"
        hint = f"What {sends} {target} is {listed(senders, 'and')}." if senders else f"Nothing {sends} {target} here."
        self.findings.error("no-edge", written.to.span, f"{skill} sends nothing to {target} itself.", hint)
        return None


def _named(
    program: Program, transmissions: tuple[Transmission, ...], subject: BreakpointSubject
) -> Iterator[tuple[str, tuple[str, int]]]:
    """The operands of a condition, each once: its text, and its word and operand in the program; numbers are none."""
    words = {("reading", start): name for name, (start, _) in subject.places.readings.items()}
    words |= {("command", place): name for name, place in subject.places.actuators.items()}
    words |= {("drawn", place): draw.name for draw, place in subject.places.draws.items()}
    for number, each in enumerate(transmissions):
        skill, target = subject.graph.skills[each.skill].name, subject.graph.named(each.to, each.target)
        words["measure", number] = f"{skill} influences {target}"
    for word, operand in dict.fromkeys(program):
        if (word, operand) in words:
            yield words[word, int(operand)], (word, int(operand))
