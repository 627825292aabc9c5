"""Curricula: who is taught what, under which master, for how long, and with whose weights a lesson begins."""

from collections import defaultdict
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from heapq import heappop, heappush
from itertools import pairwise
from typing import Any, cast

from mindrun.graph.graph import Need
from mindrun.kinds.functions.function import Function
from mindrun.kinds.registry import arguments, kinds, phrase
from mindrun.numbers.quantity import GENERATIONS, NUMBER, RATIO, Quantity
from networkx import DiGraph

from mindlang.compiler import model
from mindlang.compiler.diagnostic import Findings, listed
from mindlang.compiler.families import said
from mindlang.compiler.hierarchy import with_descendants
from mindlang.compiler.resolve.expressions import Widths
from mindlang.compiler.resolve.kinds import Scope, a_name, make_event, make_kind, once, overrides
from mindlang.compiler.resolve.layouts import HARD, OF, hard_layouts
from mindlang.compiler.resolve.parts import refuse_facts
from mindlang.compiler.resolve.quantities import convert
from mindlang.compiler.resolve.worlds import RobotFacts
from mindlang.compiler.syntax import Amount, Argument, Name, Needs, Phrase, Teaches, of_form

# Words that a lesson says beside the arguments of its learner.
FROM, SCRATCH = "from", "scratch"
SWITCHES = {
    FROM: (SCRATCH, "A lesson starts from scratch, from another skill or, without this, from the skill's own weights."),
    "with": ("subskills", "A lesson teaches one skill or, with subskills, all that learn below it together with it."),
}
MEASURED: Mapping[Any, Quantity] = {"score": NUMBER, "success": RATIO}  # what a lesson can need
OFTEN = Quantity("how often in the mean of all runs", {"": 1.0}, low=1e-3, high=1e9)
USING = "using"  # a kind of learner other than the curriculum's


def lessons(
    robot: RobotFacts,
    skills: Sequence[model.Skill],
    influences: DiGraph,
    tasks: Sequence[model.Task],
    findings: Findings,
) -> Iterator[model.Lesson]:
    """Every lesson of every curriculum that is well said; those that others wait for come first."""
    known = {skill.name: skill for skill in skills}, influences, {task.name: task for task in tasks}
    context = _LessonContext(robot, *known, findings)
    for name, declaration in robot.names.declarations("curriculum"):
        refuse_facts(declaration, findings)
        phrase = declaration.header.phrase
        learner = make_kind("curriculum", phrase, Scope(robot.names, None), findings) if phrase else None
        taught = of_form(declaration.facts, Teaches)
        heirs = {fact.skill.text: origin.text for fact in taught if (origin := _origin(fact.arguments))}
        said = (context.lesson(name, fact, learner, heirs) for fact in taught)
        for number, lesson in enumerate(context.by_need([lesson for lesson in said if lesson]), 1):
            yield replace(lesson, number=number)


@dataclass(frozen=True, slots=True)
class _LessonContext:
    """The parts of a mind that lessons are checked against."""

    robot: RobotFacts
    skills: Mapping[str, model.Skill]
    influences: DiGraph
    tasks: Mapping[str, model.Task]
    findings: Findings

    def lesson(self, curriculum: str, fact: Teaches, learner: Any, heirs: Mapping[str, str]) -> model.Lesson | None:
        """The lesson that a fact says; None after reporting what is wrong with it.

        `learner` is the curriculum's, None where that is wrong; `heirs` are the skills that begin with another's
        weights, with the names of these.
        """
        before = len(self.findings.diagnostics)
        master, origin = fact.master or fact.skill, _origin(fact.arguments)
        skills = [fact.skill, *([fact.master] if fact.master else []), *([origin] if origin else [])]
        found = [self.robot.names.find(fact.task, ("task",), self.findings)]
        found += [self.robot.names.find(name, ("skill",), self.findings) for name in skills]
        generations = convert(fact.generations, GENERATIONS, self.findings)
        switches = self._switches(fact.arguments)
        learner = self._learner(fact, learner)
        if fact.skill.text in self.skills:
            self._check_learns(fact, "with" in switches)
        if None not in found:
            self._check_reached(fact, master)
            if origin:
                self._check_origin(origin, self.skills[fact.skill.text], heirs)
        hard = hard_layouts(fact.arguments, self.robot.root, self.findings)
        needs = self._needs(fact)
        until = self._need(fact.until, fact.task.text, "until") if fact.until else None
        if learner is None or generations is None or len(self.findings.diagnostics) > before:
            return None
        return model.Lesson(
            curriculum=curriculum,
            skill=fact.skill.text,
            task=fact.task.text,
            master=master.text,
            generations=int(generations),
            from_scratch=FROM in switches and not origin,
            with_subskills="with" in switches,
            learner=learner,
            starts_from=origin.text if origin else "",
            needs=needs,
            until=until,
            hard=hard,
            fact=fact,
        )

    def by_need(self, lessons: Sequence[model.Lesson]) -> Iterator[model.Lesson]:
        """Lessons in an order in which each comes after the first that teaches what acts in it or what it begins with.

        Those that teach one skill stay in order. Of a circle the first stands where it is.
        """
        teachers = defaultdict[str, list[int]](list)
        for place, lesson in enumerate(lessons):
            for skill in self._taught(lesson):
                teachers[skill].append(place)
        waits = DiGraph(pair for places in teachers.values() for pair in pairwise(places))
        waits.add_nodes_from(range(len(lessons)))
        for place, lesson in enumerate(lessons):
            acting = self._owners({*self._below(lesson.master), lesson.starts_from})
            first = {teachers[skill][0] for skill in acting & teachers.keys()}
            waits.add_edges_from((earlier, place) for earlier in first - {place})
        free = sorted(place for place, earlier in waits.in_degree if not earlier)
        while waits:
            place = heappop(free) if free else min(waits)
            later = list(waits[place])
            waits.remove_node(place)
            for each in later:
                if not waits.in_degree(each):
                    heappush(free, each)
            yield lessons[place]

    def _taught(self, lesson: model.Lesson) -> set[str]:
        names = self._below(lesson.skill) if lesson.with_subskills else {lesson.skill}
        owners = (self.skills[name] for name in self._owners(names))
        return {skill.name for skill in owners if not skill.frozen and skill.function and skill.function.learns}

    def _below(self, name: str) -> set[str]:
        """A skill and all that it influences; nothing where it could not be read."""
        return with_descendants(self.influences, self.skills.keys() & {name})

    def _owners(self, names: Iterable[str]) -> set[str]:
        """The skills whose weights these have; those that are not known are left out."""
        return {self.skills[name].owner for name in names if name in self.skills} & self.skills.keys()

    def _switches(self, written: Sequence[Argument]) -> set[str]:
        """The switches that a lesson says; a word after one that is not its own is reported, but for a skill's name."""
        switches = [argument for argument in written if argument.key.text in SWITCHES]
        for argument in (each for each in switches if not _origin([each])):
            word, message = SWITCHES[argument.key.text]
            if not isinstance(argument.value, Name) or argument.value.text != word:
                said = f"{argument.key.text} {word}"
                self.findings.error(said.replace(" ", "-"), argument.span, message, f"Write {said}.")
        return {argument.key.text for argument in switches}

    def _learner(self, fact: Teaches, learner: Any) -> Any:
        """The curriculum's learner, or that of a kind after `using`, with the arguments of the lesson."""
        said_by = "teaches"
        if using := once(USING, fact.arguments, self.findings):
            hint = f"Here stands a kind of curriculum: {listed(sorted(kinds('curriculum')))}."
            if not (kind := a_name(using, hint, self.findings)):
                return None
            phrase, said_by = Phrase(kind, (), kind.span), kind.text
            learner = make_kind("curriculum", phrase, Scope(self.robot.names, None), self.findings)
        if learner is None:
            return None
        others = {*SWITCHES, USING, HARD, *([OF] if any(each.key.text == HARD for each in fact.arguments) else [])}
        own = [argument for argument in fact.arguments if argument.key.text not in others]
        return replace(learner, **overrides(type(learner), said_by, own, self.findings))

    def _needs(self, fact: Teaches) -> tuple[Need, ...]:
        """The needs of a lesson; a measure that is said again is reported."""
        needs = [(need.span, self._need(need, fact.task.text)) for need in fact.needs]
        for which in {(need.measure, need.event): None for _, need in needs if need}:
            said = [span for span, need in needs if need and (need.measure, need.event) == which]
            what = f"How often {phrase(which[1])}" if which[1] else f"What {which[0]}"
            self.findings.refuse_again("repeated-fact", said, f"{what} is needed is said already.", "Say it once.")
        return tuple(need for _, need in needs if need)

    def _need(self, need: Needs, task: str, word: str = "needs") -> Need | None:
        """What a lesson on a task needs, or goes on until; None after reporting what is wrong with it."""
        if need.event:
            return self._event_need(need.event, need.above, task, word)
        assert need.measure
        before, (measure, span) = len(self.findings.diagnostics), (need.measure.text, need.measure.span)
        if measure not in MEASURED:
            hint = self.findings.suggest(measure, MEASURED) or f"Write {word} score > 300, or {word} success > 50%."
            if measure in kinds("event"):
                hint = f"Write how often it has to happen, and with what: {word} 25 {measure} …."
            message = f"A lesson cannot {'need' if word == 'needs' else 'go on until'} {measure}."
            self.findings.error("unknown-need", span, message, hint)
            return None
        above = convert(need.above, MEASURED[measure], self.findings)
        if need.compare != ">":
            message = f"After {word} {measure} stands > and a number: the greater {measure} is, the better."
            self.findings.error("needs-more", need.span, message, f"Write {word} {measure} > {need.above.span.text}.")
        if measure == "success" and self._lacks(task, lambda its: any(end.succeeds for end in its.ends)):
            hint = f"Add a line to it: succeeds on 5 delivery of red; or write {word} score > 300."
            self.findings.error("needs-success", need.span, f"{task} does not say what a success is.", hint)
        if measure == "success" and above is not None and above >= 1:
            hint = f"Write a share that can be exceeded: {word} success > 95%."
            self.findings.error("needs-more", need.above.span, "More than all runs cannot succeed.", hint)
        if above is None or len(self.findings.diagnostics) > before:
            return None
        return Need(cast(Any, measure), above)

    def _event_need(self, written: Phrase, above: Amount, task: str, word: str) -> Need | None:
        """How often an event of its task has to happen in a lesson; None after reporting what is wrong with it."""
        before, learners = len(self.findings.diagnostics), kinds("curriculum").values()
        of_lessons = {*SWITCHES, USING, HARD, *(each.key for learner in learners for each in arguments(learner))}
        for argument in (each for each in written.arguments if each.key.text in of_lessons):
            place = "before needs" if word == "needs" else "behind the generations"
            message = f"{argument.key.text} is no part of an event, and stands elsewhere in a lesson."
            self.findings.error("order", argument.span, message, f"Write {said(argument)} {place}.")
            return None
        event = make_event(written, Scope(self.robot.names, None), self.findings)
        times = convert(above, OFTEN, self.findings)
        if event and self._lacks(task, lambda its: event in its.events):
            hint = f"Add a line to it: counts {said(written)}."
            self.findings.error("needs-count", written.span, f"{task} does not count {said(written)}.", hint)
        return Need("event", times, event) if times and len(self.findings.diagnostics) == before else None

    def _lacks(self, task: str, says: Callable[[model.Task], bool]) -> bool:
        """True if a task that could be read as a whole does not say something."""
        known = self.tasks.get(task)
        return known is not None and known.declaration.whole and not says(known)

    def _check_learns(self, fact: Teaches, with_subskills: bool) -> None:
        """Report a lesson in which nobody learns, or a skill that has no weights of its own."""
        skill = self.skills[fact.skill.text]
        if skill.like:
            message = f"{skill.name} is like {skill.like}, so it has no weights of its own to be taught."
            hint = f"Teach {skill.like}: both learn from that."
            self.findings.error("taught-by-another", fact.skill.span, message, hint)
            return
        taught = with_descendants(self.influences, [skill.name]) if with_subskills else {skill.name}
        functions = [self.skills[name].function for name in taught]
        if None in functions or any(function.learns for function in functions):
            return
        kind = type(skill.function).__name__.lower()
        hint = f"Leave the lesson out, or make {skill.name} an mlp."
        message = f"{skill.name} is a {kind}, which does not learn{', and nothing below it does' * with_subskills}."
        self.findings.error("cannot-learn", fact.skill.span, message, hint)

    def _check_reached(self, fact: Teaches, master: Name) -> None:
        """Report a learner that the master never influences: nothing that it does would show."""
        reached = with_descendants(self.influences, [master.text])
        if fact.skill.text not in {each for name in reached for each in (name, self.skills[name].owner)}:
            hint = f"Let {master.text} or a skill below it influence {fact.skill.text}, or leave under out."
            message = f"{master.text} has no influence on {fact.skill.text}, which would learn nothing."
            self.findings.error("out-of-reach", master.span, message, hint)

    def _check_origin(self, origin: Name, learner: model.Skill, heirs: Mapping[str, str]) -> None:
        """Report weights with which a lesson cannot begin."""
        other = self.skills[origin.text]
        if not learner.function or not other.function:
            return
        if other.owner == learner.name:
            hint = f"Leave from {origin.text} out: it begins with its weights."
            self.findings.error("own-origin", origin.span, f"{learner.name} has these weights already.", hint)
        elif difference := self._difference(learner, other, heirs):
            hint = (
                "Weights fit the same function. Of its readings and outputs one each may be another, and what is read "
                "or influenced beside them is new."
            )
            message = f"{learner.name} cannot begin with the weights of {other.name}: {difference}."
            self.findings.error("other-shape", origin.span, message, hint)

    def _difference(self, learner: model.Skill, other: model.Skill, heirs: Mapping[str, str]) -> str:
        """Why weights of one skill do not fit another; empty where they do."""
        if not other.function.learns:
            return f"{other.name} learns nothing"
        widths = self.robot.widths
        kinds = {each.name: type(each.kind).__name__ for each in self.robot.sensors}
        found: dict[str, str] = {}
        for verb, mine, others in (
            ("reads", *([f"{name}:{widths.get(name, 1)}" for name in skill.reads] for skill in (learner, other))),
            ("sends to", *(_sends(skill) for skill in (learner, other))),
        ):
            stands = counterparts(mine, others, heirs, kinds)
            if stands is None:
                own, its = _words(mine, others), _words(others, mine)
                where = f"{learner.name} {verb} {own} where {other.name} {verb} {its}"
                return f"{where}, and which stands for which cannot be told"
            found |= stands
        commands = [edge.target for edge in learner.edges if edge.at is None and edge.to == "actuator"]
        if driven := [name for name in commands if name not in found]:
            return f"{learner.name} drives {listed(driven, 'and')}, too, and a command of 0 is one"
        return "" if _holds(learner, other, widths) else "their functions differ"


def _origin(written: Sequence[Argument]) -> Name | None:
    """The skill with a copy of whose weights a lesson begins."""
    values = (argument.value for argument in written if argument.key.text == FROM)
    return next((value for value in values if isinstance(value, Name) and value.text[0].isupper()), None)


def _holds(learner: model.Skill, other: model.Skill, widths: Widths) -> bool:
    """True if the learner computes the other's function once some of its weights are 0: no layer of it is smaller."""
    (own, size), (other_own, its) = (_sized(skill, widths) for skill in (learner, other))
    return (own, size) == (other_own, its) or own.holds(size, other_own, its)


def _sized(skill: model.Skill, widths: Widths) -> "tuple[Function, tuple[int, int]]":
    """A skill's function with every argument said, and how many inputs and outputs it has."""
    size = sum(widths.get(name, 1) for name in skill.reads), len(_sends(skill))
    return skill.function.explicit(*size), size


def _sends(skill: model.Skill) -> list[str]:
    return [edge.target for edge in skill.edges if edge.at is None]


def _words(names: Sequence[str], but: Sequence[str]) -> str:
    """The names that are not among the others."""
    found = [name.partition(":")[0] for name in names if name not in but]
    return listed(found, "and") if found else "nothing more"


def counterparts(
    of: Sequence[str], among: Sequence[str], heirs: Mapping[str, str], kinds: Mapping[str, str]
) -> dict[str, str] | None:
    """For each of these names the other skill's that it stands for, none where it is new; None if it cannot be told.

    The same name stands for itself, and a skill for the one with whose weights it begins (`heirs`). What else only the
    other one has is stood for by the only sensor of the same kind (`kinds`, by name) and width that the other does not
    have, and else by the only name of the same width. Of a width of which nothing is missing then, all that is left is
    new. Names say their width as in a lock: proximity:10.
    """
    found = {name: name for name in of if name in among}
    found |= {name: heirs[name] for name in of if heirs.get(name) in among and heirs[name] not in found}
    if len(set(found.values())) < len(found):
        return None

    def width(name: str) -> str:
        return name.partition(":")[2]

    def shape(name: str) -> tuple[str | None, str]:
        return kinds.get(name.partition(":")[0]), width(name)

    for alike in (shape, width):
        for missing in [name for name in among if name not in found.values()]:
            others = [name for name in among if alike(name) == alike(missing) and name not in found.values()]
            standing = [name for name in of if alike(name) == alike(missing) and name not in found]
            if len(others) == len(standing) == 1:
                found[standing[0]] = missing
    return found if {*found.values()} == {*among} else None
