"""Curricula: who is taught what, under which master, for how long."""

from collections.abc import Iterator, Mapping, Set
from dataclasses import dataclass, replace
from typing import Any, cast

from mindrun.graph.graph import Need
from mindrun.kinds.registry import kinds
from mindrun.numbers.quantity import GENERATIONS, NUMBER, RATIO, Quantity
from networkx import DiGraph

from mindlang.compiler import model
from mindlang.compiler.diagnostic import Findings, listed
from mindlang.compiler.hierarchy import below
from mindlang.compiler.names import Names
from mindlang.compiler.resolve.kinds import Scope, a_name, make, once, overrides
from mindlang.compiler.resolve.origin import check_origin
from mindlang.compiler.resolve.parts import refuse_facts, refuse_repeated
from mindlang.compiler.resolve.quantities import convert
from mindlang.compiler.syntax import Argument, Name, Needs, Phrase, Teaches

# Words that a lesson says beside the arguments of its learner.
FROM, SCRATCH = "from", "scratch"
SWITCHES = {
    FROM: (SCRATCH, "A lesson starts from scratch, from another skill or, without this, from the skill's own weights."),
    "with": ("subskills", "A lesson teaches one skill or, with subskills, all that learn below it together with it."),
}
MEASURED: Mapping[Any, Quantity] = {"score": NUMBER, "success": RATIO}  # what a lesson can need
USING = "using"  # a kind of learner other than the curriculum's


def lessons(
    names: Names,
    skills: tuple[model.Skill, ...],
    influences: DiGraph,
    tasks: tuple[model.Task, ...],
    widths: Mapping[str, int],
    findings: Findings,
) -> Iterator[model.Lesson]:
    """Every lesson of every curriculum that is well said, in order."""
    by_name = {skill.name: skill for skill in skills}
    hopeless = {each.name for each in tasks if each.declaration.whole and not any(end.succeeds for end in each.ends)}
    for name, declaration in names.declarations("curriculum"):
        refuse_facts(declaration, (Teaches,), findings)
        phrase = declaration.header.phrase
        learner = make("curriculum", phrase, Scope(names, None), findings) if phrase else None
        taught = [fact for fact in declaration.facts if isinstance(fact, Teaches)]
        heirs = {fact.skill.text: origin.text for fact in taught if (origin := _origin(fact))}
        curriculum = _Curriculum(name, learner, names, by_name, influences, hopeless, widths, heirs, findings)
        yield from filter(None, (curriculum.lesson(number, fact) for number, fact in enumerate(taught, 1)))


@dataclass(frozen=True, slots=True)
class _Curriculum:
    """What its lessons are held against: its learner, None where that is wrong, and the mind's names and skills.

    `hopeless` are the tasks that say no success, `heirs` the skills that begin with another's weights, with the names
    of these.
    """

    name: str
    learner: Any
    names: Names
    skills: Mapping[str, model.Skill]
    influences: DiGraph
    hopeless: Set[str]
    widths: Mapping[str, int]
    heirs: Mapping[str, str]
    findings: Findings

    def lesson(self, number: int, fact: Teaches) -> model.Lesson | None:
        """The lesson that a fact says, the `number`th of the curriculum; None after reporting what is wrong with it."""
        before = len(self.findings.diagnostics)
        found = [self._find(fact.skill, "skill"), self._find(fact.task, "task")]
        if fact.master:
            found.append(self._find(fact.master, "skill"))
        generations = convert(fact.generations, GENERATIONS, self.findings)
        switches = {argument.key.text for argument in fact.arguments if argument.key.text in SWITCHES}
        _check_switches(fact.arguments, self.findings)
        learner = self._learner(fact)
        starts_from = _origin(fact)
        if starts_from:
            found.append(self._find(starts_from, "skill"))
        if found[0]:
            self._check_learns(fact, "with" in switches)
        master = fact.master or fact.skill
        if None not in found:
            self._check_reached(fact, master)
            if starts_from:
                check_origin(
                    starts_from, self.skills[fact.skill.text], self.skills, self.widths, self.heirs, self.findings
                )
        needs = self._needs(fact)
        if learner is None or generations is None or len(self.findings.diagnostics) > before:
            return None
        return model.Lesson(
            curriculum=self.name,
            skill=fact.skill.text,
            task=fact.task.text,
            master=master.text,
            generations=int(generations),
            from_scratch=FROM in switches and not starts_from,
            with_subskills="with" in switches,
            learner=learner,
            number=number,
            starts_from=starts_from.text if starts_from else "",
            needs=needs,
            fact=fact,
        )

    def _find(self, name: Name, noun: str) -> Any:
        return self.names.find(name, (noun,), self.findings)

    def _learner(self, fact: Teaches) -> Any:
        """The curriculum's learner, or that of a kind after `using`, with the arguments of the lesson."""
        learner, said_by = self.learner, "teaches"
        if using := once(USING, fact.arguments, self.findings):
            hint = f"Here stands a kind of curriculum: {listed(sorted(kinds('curriculum')))}."
            if not (kind := a_name(using, hint, self.findings)):
                return None
            phrase, said_by = Phrase(kind, (), kind.span), kind.text
            learner = make("curriculum", phrase, Scope(self.names, None), self.findings)
        if learner is None:
            return None
        own = (argument for argument in fact.arguments if argument.key.text not in {*SWITCHES, USING})
        return replace(learner, **overrides(type(learner), said_by, own, self.findings))

    def _needs(self, fact: Teaches) -> tuple[Need, ...]:
        """What a lesson needs, each measure once."""
        for measure in MEASURED:
            again = [need for need in fact.needs if need.measure.text == measure]
            refuse_repeated(again, f"What {measure} is needed is said already.", "Say it once.", self.findings)
        return tuple(filter(None, (self._need(need, fact.task.text) for need in fact.needs)))

    def _need(self, need: Needs, task: str) -> Need | None:
        """What a lesson on a task needs; None after reporting what is wrong with it."""
        before, (measure, span) = len(self.findings.diagnostics), (need.measure.text, need.measure.span)
        if measure not in MEASURED:
            hint = self.findings.suggest(measure, MEASURED) or "Write needs score > 300, or needs success > 50%."
            self.findings.error("unknown-need", span, f"A lesson cannot need {measure}.", hint)
            return None
        above = convert(need.above, MEASURED[measure], self.findings)
        if need.compare != ">":
            message = f"A lesson needs more than a number: the greater {measure} is, the better."
            self.findings.error("needs-more", need.span, message, f"Write needs {measure} > {need.above.span.text}.")
        if measure == "success" and task in self.hopeless:
            hint = "Add a line to it: succeeds on 5 delivery of red; or write needs score > 300."
            self.findings.error("needs-success", need.span, f"{task} does not say what a success is.", hint)
        if measure == "success" and above is not None and above >= 1:
            hint = "Write a share that can be exceeded: needs success > 95%."
            self.findings.error("needs-more", need.above.span, "More than all runs cannot succeed.", hint)
        if above is None or len(self.findings.diagnostics) > before:
            return None
        return Need(cast(Any, measure), above)

    def _check_learns(self, fact: Teaches, with_subskills: bool) -> None:
        """Report a lesson in which nobody learns, or a skill that has no weights of its own."""
        skill = self.skills[fact.skill.text]
        if skill.like:
            message = f"{skill.name} is like {skill.like}, so it has no weights of its own to be taught."
            self.findings.error(
                "taught-by-another", fact.skill.span, message, f"Teach {skill.like}: both learn from that."
            )
            return
        taught = below(self.influences, [skill.name]) if with_subskills else {skill.name}
        functions = [self.skills[name].function for name in taught]
        if None in functions or any(function.learns for function in functions):
            return
        kind = type(skill.function).__name__.lower()
        hint = f"Leave the lesson out, or make {skill.name} an mlp."
        message = f"{skill.name} is a {kind}, which does not learn{', and nothing below it does' * with_subskills}."
        self.findings.error("cannot-learn", fact.skill.span, message, hint)

    def _check_reached(self, fact: Teaches, master: Name) -> None:
        """Report a learner that the master never influences: nothing that it does would show."""
        reached = below(self.influences, [master.text])
        if fact.skill.text not in {each for name in reached for each in (name, self.skills[name].owner)}:
            hint = f"Let {master.text} or a skill below it influence {fact.skill.text}, or leave under out."
            message = f"{master.text} has no influence on {fact.skill.text}, which would learn nothing."
            self.findings.error("out-of-reach", master.span, message, hint)


def _origin(fact: Teaches) -> Name | None:
    """The skill with a copy of whose weights a lesson begins."""
    values = (argument.value for argument in fact.arguments if argument.key.text == FROM)
    return next((value for value in values if isinstance(value, Name) and value.text[0].isupper()), None)


def _check_switches(written: tuple[Argument, ...], findings: Findings) -> None:
    for argument in written:
        word, message = SWITCHES.get(argument.key.text, ("", ""))
        if argument.key.text == FROM and isinstance(argument.value, Name) and argument.value.text[0].isupper():
            continue
        if word and (not isinstance(argument.value, Name) or argument.value.text != word):
            said = f"{argument.key.text} {word}"
            findings.error(said.replace(" ", "-"), argument.span, message, f"Write {said}.")
