"""The facts of the world that a lesson of a mind teaches in: all that a result of the lesson depends on.

What a lesson cannot notice is none of them: parts that no skill below its master and no reward uses, what is only
counted, names of curricula, how many generations there are, and the weights of skills that are not below the learner,
since those may be taught again when it has learnt.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from hashlib import sha256
from pathlib import Path
from typing import Any

from mindrun.errors import ProcedureError
from mindrun.graph.codec import encode
from mindrun.graph.graph import Edge, Graph, HardLayouts, Lesson, Program, Reward, Skill, Start, Tally, Task
from mindrun.graph.skill_sets import acting, genes
from mindrun.graph.tasks import physics
from mindrun.kinds.environment import module_beside
from mindrun.kinds.functions.procedure import module_source, used_file
from mindrun.kinds.registry import arguments, brought_by, kinds, later_fields, names, phrase
from mindrun.numbers.expression import TRUTHS, fold, leaves
from mindrun.numbers.quantity import EXPRESSION, FARTHEST_UNITS, UNSAID, Quantity, Reference

from mindlang.compiler.hierarchy import with_descendants
from mindlang.compiler.model import source_graph
from mindlang.lock.training_world import LessonKey, TrainingWorld

LOOSEST_FIRST = (("otherwise",), ("when",), ("or",), ("and",), TRUTHS[:4], ("+", "-"), ("*", "/"))
PRECEDENCE = {word: place for place, words in enumerate(LOOSEST_FIRST) for word in words}
HASH_DIGITS = 16
NEGATION_PRECEDENCE, EXTREME_PRECEDENCE, ATOM_PRECEDENCE = 7, 8, 9

UNSAID_VALUES: tuple[Any, ...] = (
    [],
    "",
    None,
    FARTHEST_UNITS,
    {"by": None, "first": UNSAID.first, "last": UNSAID.last},
)

Leaf = Callable[[str, float], str]
ExpressionPart = tuple[str, int]  # of an expression: its text, and how tightly it binds


@dataclass(frozen=True)
class Worlds:
    """The training worlds of a mind; `folder` is where its procedures stand, None where they do not count."""

    graph: Graph
    folder: Path | None

    def of(self, lesson: Lesson) -> TrainingWorld:
        """The world that a lesson teaches in now."""
        where = {"task": lesson.task, "master": lesson.master, "with_subskills": lesson.with_subskills}
        origin = {"starts_from": lesson.starts_from} if lesson.starts_from else {}
        learner = encode(lesson.learner)
        del learner["keeps"]  # it decides about what was learnt, and changes none of it
        hard = {"hard": hard_words(lesson.hard)} if lesson.hard else {}
        how = {"from_scratch": lesson.from_scratch, **origin, **hard, "learner": learner}
        return self.of_gone(LessonKey(lesson.task, lesson.master, lesson.with_subskills), {**where, **how})

    def of_gone(self, lesson: LessonKey, said: Mapping[str, Any]) -> TrainingWorld:
        """The world of a lesson that stands in no curriculum any more; how it was learnt is `said`."""
        place = lesson.task, lesson.master
        if place not in self._known:
            self._known[place] = dict(self._facts_of_lesson(*place))
        return TrainingWorld({**self._known[place], "lesson": said})

    @cached_property
    def _known(self) -> dict[tuple[str, str], Mapping[str, Any]]:
        """All facts but the lesson's own, by task and master."""
        return {}

    def _facts_of_lesson(self, name: str, master: str) -> Iterator[tuple[str, Any]]:
        task = next(task for task in self.graph.tasks if task.name == name)
        skills = acting(self.graph, task, master)
        yield "tick", self.graph.tick
        yield "body", encode(self.graph.body)
        yield "task", {"scene": encode(task.scene), "ticks": task.ticks, **self._ends(task)}
        if path := module_beside(task.scene.environment, self.folder):
            yield "environment", {"text": sha256(path.read_bytes()).hexdigest()}
        if not task.scene.environment:
            yield "physics", physics()
        if task.start != Start():
            yield "start", {"at": encode(task.start.at), "facing": task.start.facing}
        varying = [
            f"varies {each.argument} of {each.of or each.noun} {number(each.low)} to {number(each.high)}"
            for each in task.varies  # the body is called body
        ]
        varying += self._drawn(task)
        varying += [f"fails {each.actuator} {number(each.rate)} per tick" for each in task.fails]
        if varying:
            yield "varying", sorted(varying)
        yield "rewards", sorted([*self._reward(task, reward)] for reward in task.rewards)
        yield from ((f"thing {thing.name}", encode(thing.kind)) for thing in task.things)
        yield from ((f"skill {skill.name}", self._skill(skill)) for skill in skills)
        yield from self._parts(skills, task)

    def _parts(self, skills: Sequence[Skill], task: Task) -> Iterator[tuple[str, Any]]:
        """The sensors and memories that skills and rewards read, and the actuators that move."""
        read = {self._names[index] for skill in skills for index in skill.inputs}
        read |= {self._names[index] for program in task.programs for index in leaves(program, "reading")}
        read |= {self._names[reward.each[0]] for reward in task.rewards if reward.each}
        driven = {self.graph.named(edge.to, edge.target) for skill in skills for edge in skill.edges}
        happening = {*(end.event for end in task.ends), *(reward.on for reward in task.rewards)}
        events = (each for event in happening if event is not None for each in task.events[event].single)
        if any(event.is_of_battery for event in events):
            read |= {*[sensor.name for sensor in self.graph.sensors if sensor.kind.battery][:1]}
        sources = (
            with_descendants(source_graph(self.graph.sensors), read & {each.name for each in self.graph.sensors}) | read
        )
        kept = (memory for memory in self.graph.memories if memory.name in sources | driven)
        sources |= {source for memory in kept for source in memory.kind.sources}
        for sensor in self.graph.sensors:
            if sensor.name in sources:
                yield f"sensor {sensor.name}", encode(sensor.kind.taught)
        for memory in self.graph.memories:
            if memory.name in sources | driven:
                yield f"memory {memory.name}", encode(memory.kind)
        carrying = {sensor.kind.servo for sensor in self.graph.sensors if sensor.name in sources}
        for actuator in self.graph.actuators:
            if actuator.name in driven | carrying or actuator.kind.acts_at_rest:
                yield f"actuator {actuator.name}", encode(actuator.kind)
        if any(thing.kind.can_be_delivered for thing in task.things):
            yield "claw", self.graph.claw_reach

    @cached_property
    def _names(self) -> list[str]:
        return [name for name, _ in self.graph.readings]

    def _skill(self, skill: Skill) -> dict[str, Any]:
        """The facts of a skill that its weights do not say: all of it where it does not learn."""
        fixed = [edge for edge in skill.edges if edge.programs or edge.cuts or edge.over]
        package = brought_by(type(skill.function))
        sends = {"sends": sorted(map(self._sends, fixed)), **({"chooses": "one"} if skill.chooses else {})}
        sends |= {"of": package[0]} if package else {}
        if skill.like:
            return {"like": skill.like, **self._instead(skill), **sends}
        if genes(skill):
            return sends
        reads = list(dict.fromkeys(self._names[index] for index in skill.inputs))
        if skill.function.calls is None:
            return {"is": names()[type(skill.function)], "reads": sorted(reads), **sends}
        answers = [self.graph.named(edge.to, edge.target) for edge in skill.edges if edge.output is not None]
        calls = skill.function.calls
        function: dict[str, Any] = {"is": f"procedure from {calls}", "text": self._hash(calls)}
        function |= {"files": {name: self._hash(calls, name) for name in skill.files}} if skill.files else {}
        return {**function, "reads": reads, "answers": answers, **sends}

    def _sends(self, edge: Edge) -> str:
        words = [self.graph.named(edge.to, edge.target)]
        words += [f"over {' and '.join(self.graph.named(*sink) for sink in edge.over)}"] * bool(edge.over)
        words += [f"at {infix(edge.value, self._leaf)}"] if edge.output is None else []
        if edge.gate:
            words.append(f"when {infix(edge.gate.when, self._leaf)}")
            words += [f"otherwise {infix(edge.gate.otherwise, self._leaf)}"] if edge.gate.otherwise is not None else []
        return " ".join([*words, *([f"cuts below {number(edge.cuts)}"] if edge.cuts else [])])

    def _instead(self, skill: Skill) -> dict[str, list[str]]:
        """Readings and targets of a skill that is like another, as `own for other`; the other's line has the order."""
        owner = next(each for each in self.graph.skills if each.name == skill.like)
        read = [(self._names[own], self._names[other]) for own, other in zip(skill.inputs, owner.inputs, strict=True)]
        edges = zip(skill.edges, owner.edges, strict=True)
        sent = [tuple(self.graph.named(edge.to, edge.target) for edge in pair) for pair in edges]
        instead = {
            word: [f"{own} for {other}" for own, other in dict.fromkeys(pairs) if own != other]
            for word, pairs in (("reads", read), ("sends to", sent))
        }
        return instead if instead["sends to"] else {"reads": instead["reads"]}

    def _hash(self, calls: str, file: str = "") -> str:
        """A hash of a procedure's module, or of its file; empty where it does not count or cannot be read."""
        if not self.folder:
            return ""
        try:
            data = used_file(calls, file, self.folder) if file else module_source(calls, self.folder).encode()
        except ProcedureError:
            data = b""
        return sha256(data).hexdigest() if data else ""

    def _ends(self, task: Task) -> dict[str, list[str]]:
        """The ends of a run by their verbs; what `opens` something begins with its name."""
        found: dict[str, list[str]] = {"ends": []}
        for end in task.ends:
            if end.event is None:
                cause = f"when {infix(end.when or (), self._leaf_of(task))}"
            else:
                cause = "on " * bool(end.opens) + f"{end.times} " * (end.times > 1) + phrase(task.events[end.event])
            verb = "opens" if end.opens else "succeeds" if end.succeeds else "ends"
            found.setdefault(verb, []).append(f"{end.opens} {cause}".lstrip())
        return {verb: sorted(causes) for verb, causes in found.items()}

    def _drawn(self, task: Task) -> Iterator[str]:
        """The numbers that a task draws, and the things that these place or that they let be there, as lines of it."""
        for draw in task.draws:
            yield f"draws {draw.name} from {(' to ' if draw.is_range else ' ').join(map(number, draw.values))}"
        for thing in task.things:
            if thing.when or thing.by or thing.many:
                place = [infix(each, self._leaf_of(task)) for each in thing.by]
                place = [f"+{each}" if each[0].isalpha() else each for each in place]
                words = [f"contains {thing.name} is {names()[type(thing.kind)]}"]
                words += ["along" if thing.kind.ways else "at", *place] if place else []
                words += [f"count {task.draws[thing.many - 1].name}"] if thing.many else []
                words += [f"when {infix(thing.when, self._leaf_of(task))}"] if thing.when else []
                yield " ".join(words)

    def _leaf_of(self, task: Task) -> Leaf:
        """The function that writes the leaves of a task's expressions."""

        def leaf(word: str, operand: float | int) -> str:
            match word:
                case "measure":
                    return phrase(task.measures[int(operand)])
                case "tally":
                    return self._tally(task, task.tallies[int(operand)], leaf)
                case "drawn":
                    return task.draws[int(operand)].name
                case "command":
                    return self.graph.actuators[int(operand)].name
            return "p" if word == "each" else self._leaf(word, operand)

        return leaf

    def _tally(self, task: Task, tally: Tally, leaf: Leaf) -> str:
        """A tally as it is written."""
        words = ["longest" if tally.longest else "sum of" if tally.value else "count"]
        words += [infix(tally.value, leaf)] if tally.value else []
        words += ["of", phrase(task.events[tally.event])] if tally.event is not None else []
        words += ["when", infix(tally.when, leaf)] if tally.when else []
        return f"({' '.join(words)})"

    def _reward(self, task: Task, reward: Reward) -> Iterator[str]:
        leaf = self._leaf_of(task)
        yield infix(reward.amount, leaf)
        words = ["per tick" if reward.on is None else f"on {phrase(task.events[reward.on])}"]
        words = ["at the end"] if reward.last else words
        if reward.each:
            words.append(f"for each p in {self._names[reward.each[0]]}")
        if reward.when is not None:
            words += ["when", infix(reward.when, leaf)]
        yield " ".join(words)

    def _leaf(self, word: str, operand: float | int) -> str:
        return self._names[int(operand)]


def hard_words(hard: HardLayouts) -> str:
    """The hard layouts of a lesson: their share, how many there are, and a hash of their seeds."""
    digest = sha256("\n".join(hard.seeds).encode()).hexdigest()[:HASH_DIGITS]
    return f"{100 * hard.share:g}% of {len(hard.seeds)} layouts {digest}"


def infix(program: Program, leaf: Leaf) -> str:
    """An expression as it is written; `leaf` says a reading or a measure by its word and its index."""

    def part(word: str, operand: float | int) -> ExpressionPart:
        return number(operand) if word == "number" else leaf(word, operand), ATOM_PRECEDENCE

    def negated(value: ExpressionPart) -> ExpressionPart:
        return f"-{_within(value, NEGATION_PRECEDENCE)}", NEGATION_PRECEDENCE

    def combined(operator: str, left: ExpressionPart, right: ExpressionPart) -> ExpressionPart:
        if operator not in PRECEDENCE:
            sides = f"{_within(left, ATOM_PRECEDENCE)} {_within(right, ATOM_PRECEDENCE)}"
            return f"{operator} of {sides}", EXTREME_PRECEDENCE
        here = PRECEDENCE[operator]
        return f"{_within(left, here)} {operator} {_within(right, here + 1)}", here

    return fold(program, part, negated, combined)[0] if program else ""


def _within(part: ExpressionPart, binding: int) -> str:
    text, own = part
    return text if own >= binding else f"({text})"


def number(value: float) -> str:
    """A number that reads back as the same."""
    short = f"{value:g}"
    return short if float(short) == value else repr(value)


def argument(noun: str, kind: str, field: str, value: Any) -> str:
    """An argument of a kind, as plain data, in words: range 12, at 0 22.5 deg, size 3 to 1 by 0.1; without along."""
    if value in UNSAID_VALUES:
        return f"without {field.removesuffix('_')}"
    meaning = meaning_of(noun, kind, field)
    if meaning == EXPRESSION:
        return f"{field} {infix(tuple((word, x) for word, x in value), lambda _, name: str(name))}"
    if isinstance(value, list) and value and isinstance(value[0], list):
        words = " or ".join(
            _places(each, meaning) for each in (value if isinstance(next(iter(value[0]), 0), list) else [value])
        )
    else:
        words = " ".join(_converted(each, meaning) for each in (value if isinstance(value, list) else [value]))
    if not words:
        return f"{field.removesuffix('_')} none"
    unit = next(iter(meaning.units), "") if isinstance(meaning, Quantity) else ""
    return f"{field.removesuffix('_')} {words} {unit}".rstrip()


def _places(places: Sequence[Sequence[float]], meaning: Quantity | Reference | None) -> str:
    return " to ".join(" ".join(_converted(each, meaning) for each in place) for place in places)


def completed(noun: str, kind: Mapping[str, Any]) -> Mapping[str, Any]:
    """A kind as plain data, with the arguments that are left out of it where they are as by default."""
    cls = kinds(noun).get(kind["is"])
    later = later_fields(cls) if cls else {}
    return {**{name: encode(default) for name, default in later.items()}, **kind}


def meaning_of(noun: str, kind: str, field: str) -> Quantity | Reference | None:
    """The quantity or reference that an argument of a kind is; None for one that this version does not know."""
    known = {each.field: each for each in arguments(kinds(noun)[kind])} if kind in kinds(noun) else {}
    return known[field].type if field in known else None


def _converted(value: Any, meaning: Quantity | Reference | None) -> str:
    match value:
        case {"first": first, "last": last, "by": by}:
            span = number(first) if first == last and by is None else f"{number(first)} to {number(last)}"
            return span if by is None else f"{span} by {number(by)}"
        case bool() | str() | None:
            return str(value)
    factor = next(iter(meaning.units.values()), 1.0) if isinstance(meaning, Quantity) else 1.0
    return number(value) if factor == 1.0 else f"{value / factor:g}"
