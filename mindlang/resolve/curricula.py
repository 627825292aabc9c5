"""Curricula: who is taught what, under which master, for how long."""

from collections.abc import Iterator, Mapping
from dataclasses import replace
from typing import Any

from mindrun.functions import Mlp
from mindrun.quantity import GENERATIONS
from mindrun.registry import kinds

from mindlang import model
from mindlang.diagnostic import Findings, Label, listed
from mindlang.hierarchy import reached
from mindlang.resolve.kinds import Scope, make, overrides
from mindlang.resolve.names import Names
from mindlang.resolve.parts import refuse_facts
from mindlang.resolve.quantities import convert
from mindlang.syntax import Argument, Name, Phrase, Teaches

# Words that a lesson says beside the arguments of its learner.
SWITCHES = {
    "from": ("scratch", "A lesson starts from scratch or, without this, from the weights that the skill has."),
    "with": ("subskills", "A lesson teaches one skill or, with subskills, all that learn below it together with it."),
}
USING = "using"  # a kind of learner other than the curriculum's


def lessons(names: Names, skills: tuple[model.Skill, ...], findings: Findings) -> Iterator[model.Lesson]:
    """Every lesson of every curriculum that is well said, in order."""
    by_name = {skill.name: skill for skill in skills}
    for name, declaration in names.declarations("curriculum"):
        refuse_facts(declaration, (Teaches,), findings)
        phrase = declaration.header.phrase
        learner = make("curriculum", phrase, Scope(names, None), findings) if phrase else None
        taught = (fact for fact in declaration.facts if isinstance(fact, Teaches))
        for number, fact in enumerate(taught, 1):
            lesson = _lesson(name, number, fact, learner, names, by_name, findings)
            yield from [lesson] if lesson else []


def _lesson(
    curriculum: str,
    number: int,
    fact: Teaches,
    learner: Any,
    names: Names,
    skills: Mapping[str, model.Skill],
    findings: Findings,
) -> model.Lesson | None:
    before = len(findings.diagnostics)
    master = fact.master or fact.skill
    found = [names.find(fact.skill, ("skill",), findings), names.find(fact.task, ("task",), findings)]
    if fact.master:
        found.append(names.find(fact.master, ("skill",), findings))
    generations = convert(fact.generations, GENERATIONS, findings)
    switches = {argument.key.text for argument in fact.arguments if argument.key.text in SWITCHES}
    arguments = tuple(argument for argument in fact.arguments if argument.key.text not in {*SWITCHES, USING})
    _check_switches(fact.arguments, findings)
    learner, kind = _learner(fact, learner, findings)
    said = overrides(type(learner), kind, arguments, findings) if learner else {}
    if found[0]:
        _check_learns(fact, skills, "with" in switches, findings)
    if None not in found:
        _check_reached(fact, master, skills, findings)
    if learner is None or generations is None or len(findings.diagnostics) > before:
        return None
    return model.Lesson(
        curriculum,
        fact.skill.text,
        fact.task.text,
        master.text,
        int(generations),
        "from" in switches,
        "with" in switches,
        replace(learner, **said),
        number,
        fact,
    )


def _learner(fact: Teaches, of_all: Any, findings: Findings) -> tuple[Any, str]:
    """A lesson's learner with the defaults of its kind, the curriculum's or that after `using`, and whose it is."""
    said = [argument for argument in fact.arguments if argument.key.text == USING]
    for argument in said[1:]:
        first = Label(said[0].span, "first said here")
        findings.error("repeated-argument", argument.key.span, "using is said twice.", "Leave one out.", first)
    match [argument.value for argument in said]:
        case []:
            return of_all, "teaches"
        case [Name() as kind, *_]:
            return make("curriculum", Phrase(kind, (), kind.span), Scope(Names({}), None), findings), kind.text
    hint = f"Here stands a kind of curriculum: {listed(sorted(kinds('curriculum')))}."
    findings.error("not-a-name", said[0].value.span, "A number cannot stand after using.", hint)
    return None, USING


def _check_switches(written: tuple[Argument, ...], findings: Findings) -> None:
    for argument in written:
        word, message = SWITCHES.get(argument.key.text, ("", ""))
        if word and (not isinstance(argument.value, Name) or argument.value.text != word):
            said = f"{argument.key.text} {word}"
            findings.error(said.replace(" ", "-"), argument.span, message, f"Write {said}.")


def _check_learns(fact: Teaches, skills: Mapping[str, model.Skill], with_subskills: bool, findings: Findings) -> None:
    """Report a lesson in which nobody learns."""
    taught = reached(skills, fact.skill.text) if with_subskills else {fact.skill.text}
    functions = [skills[name].function for name in taught]
    if None in functions or any(isinstance(function, Mlp) for function in functions):
        return
    skill = skills[fact.skill.text]
    kind = type(skill.function).__name__.lower()
    hint = f"Leave the lesson out, or make {skill.name} an mlp."
    message = f"{skill.name} is a {kind}, which does not learn{', and nothing below it does' * with_subskills}."
    findings.error("cannot-learn", fact.skill.span, message, hint)


def _check_reached(fact: Teaches, master: Name, skills: Mapping[str, model.Skill], findings: Findings) -> None:
    """Report a learner that the master never influences: nothing that it does would show."""
    if fact.skill.text not in reached(skills, master.text):
        hint = f"Let {master.text} or a skill below it influence {fact.skill.text}, or leave under out."
        message = f"{master.text} has no influence on {fact.skill.text}, which would learn nothing."
        findings.error("out-of-reach", master.span, message, hint)
