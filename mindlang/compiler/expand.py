"""Names → plain names: scenes, likeness, numbers and rates written out, so that each declaration says all that it is.

Whatever is written out keeps the place where it was said, so that a mistake in it is reported there. Where a scene or
task says more than the one that it is like, a line replaces the one of the same thing: a thing the one of its name, an
event that ends, succeeds, opens or is counted the same event, however many times it was to happen, a reward the one on
the same event or of the same readings and measures under the same condition.
"""

import re
from collections.abc import Callable, Hashable, Mapping, Sequence
from dataclasses import replace as with_fields
from typing import Any

from msgspec.structs import replace
from networkx import DiGraph

from mindlang.compiler import syntax
from mindlang.compiler.diagnostic import Findings, a
from mindlang.compiler.families import said
from mindlang.compiler.hierarchy import refuse_circles, reverse_topological_order
from mindlang.compiler.names import Names, mentions_in
from mindlang.compiler.syntax import Amount, Declaration, Fact, Name, Numbers, Phrase, rebuilt

UNLIKE_NOUNS = ("body", "curriculum")  # whose declarations are like nothing
_WORD = re.compile(r"[a-z]\w*")

Declarations = dict[str, Declaration]


def number_values(names: Names, findings: Findings) -> dict[str, Amount]:
    """The amount that each name stands for; one that stands for itself in the end is reported, and left out."""
    graph = DiGraph()
    graph.add_nodes_from(names.numbers)
    others = ((name, number.amount.name, number.span) for name, number in names.numbers.items())
    graph.add_edges_from((name, other, {"span": span}) for name, other, span in others if other)
    hint = "Write a number in one of the lines."
    refuse_circles("number-circle", graph, findings, "A number stands for itself", hint, "through this one")
    found: dict[str, Amount] = {}
    for name in (each for each in reverse_topological_order(graph) if each in names.numbers):
        amount = names.numbers[name].amount
        if not amount.name or names.find(amount.constant, ("number",), findings):
            found[name] = fill_number(amount, found)
    return {name: amount for name, amount in found.items() if not amount.name}


def fill_number(amount: Amount, numbers: Mapping[str, Amount]) -> Amount:
    """The amount with its named number filled in, keeping its sign and span; itself where it names no known number."""
    value = numbers.get(amount.name)
    if value is None:
        return amount
    return replace(value, number=amount.number * value.number, span=amount.span, said=value.said or value.span)


def expand(names: Names, values: Mapping[str, Amount], tick_seconds: float, findings: Findings) -> Names:
    """The declarations with scenes, likeness, names of numbers and rates written out.

    `values` are what the names of numbers stand for.
    """
    line = number_writer(names, values, tick_seconds)
    table = {
        noun: {
            name: replace(each, header=line(each.header), facts=tuple(map(line, each.facts)))
            for name, each in declarations.items()
        }
        for noun, declarations in names.table.items()
    }
    written = with_fields(names, table=table)
    for noun in UNLIKE_NOUNS:
        for like in (each.header.like for _, each in written.declarations(noun)):
            if like:
                hint = "Say what it is itself; skills, scenes and tasks can be like others."
                findings.error("cannot-be-like", like.span, f"{a(noun).capitalize()} is like no other.", hint)
    scenes = _followed("scene", written, lambda scene: scene, findings)

    def in_scene(task: Declaration) -> Declaration:
        scene = task.header.inside
        if scene is None:
            return task
        known = written.find(scene, ("scene",), findings)
        return _like(task, scenes[scene.text]) if known else replace(task, whole=False)

    whole = {"scene": scenes, "task": _followed("task", written, in_scene, findings)}
    return with_fields(names, table=table | {noun: each for noun, each in whole.items() if each})


def number_writer(names: Names, values: Mapping[str, Amount], tick_seconds: float) -> Callable[[Any], Any]:
    """A function that replaces names of numbers in a line by their values.

    What is for a second, or in seconds where an event comes soon after another, is given the length of a tick.
    """
    words = frozenset(name.rpartition(".")[2] for name in values)  # all that stands of a name in a file with an alias

    def written(line: Any) -> Any:
        text = said(line)
        has_names = words and not words.isdisjoint(_WORD.findall(text))
        if not has_names and "per" not in text and "within" not in text:  # as most lines
            return line
        found = mentions_in(line, names, None) if has_names else ()
        places = {each.name.span for each in found if each.noun == "number" and each.name.text in values}

        def changed(node: Any) -> Any:
            match node:
                case Amount():
                    amount = fill_number(node, values)
                    return replace(amount, tick_seconds=tick_seconds) if "s" in (amount.per, amount.unit) else amount
                case Phrase(kind, ()) if kind.span in places:
                    return changed(Amount(1.0, "", kind.span, name=kind.text))
                case Name(name, span) if span in places:
                    return Numbers((changed(Amount(1.0, "", span, name=name)),), span)
            return node

        return rebuilt(line, changed)

    return written


def _followed(noun: str, names: Names, begun: Callable[[Declaration], Declaration], findings: Findings) -> Declarations:
    """The declarations of a noun with likeness written out; `begun` prepares those that are like no other."""
    declared = dict(names.declarations(noun))
    graph = DiGraph()
    graph.add_nodes_from(declared)
    for name, header in ((name, declaration.header) for name, declaration in declared.items()):
        if header.like and names.find(header.like, (noun,), findings):
            graph.add_edge(name, header.like.text, span=header.span)
    says, hint = f"{a(noun).capitalize()} is like itself", "Let one of them say what it is itself."
    refuse_circles("like-circle", graph, findings, says, hint, "through this one")
    found: Declarations = {}
    for name in reverse_topological_order(graph):
        own, other = declared[name], next(iter(graph[name]), None)
        if other in found:
            found[name] = _like(own, found[other])
        elif not own.header.like:
            found[name] = begun(own)
    return {name: found.get(name) or replace(each, whole=False) for name, each in declared.items()}


def _like(own: Declaration, other: Declaration) -> Declaration:
    """A declaration with the phrase and facts of the other that it is like, and its own facts after them."""
    header = replace(own.header, phrase=other.header.phrase)
    return replace(own, header=header, facts=_with_more(other.facts, own.facts), whole=own.whole and other.whole)


def _with_more(first: Sequence[Fact], more: Sequence[Fact]) -> tuple[Fact, ...]:
    """The facts of `first` and then `more`; one of `more` with the subject of an earlier one replaces that."""
    own: dict[Hashable, list[Fact]] = {}
    for fact in more:
        own.setdefault(_subject(fact), []).append(fact)
    found: list[Fact] = []
    for fact in first:
        found += own.get(_subject(fact), [fact])
        if _subject(fact) in own:
            own[_subject(fact)] = []
    return (*found, *(fact for fact in more if own[_subject(fact)]))


def _subject(fact: Fact) -> Hashable:
    """The key of a fact's subject; of two facts with one subject the later one counts."""
    match fact:
        case syntax.Contains(name) | syntax.Draws(name) | syntax.Fails(name):
            about: tuple[Hashable, ...] = (name.text,)
        case syntax.Varies(argument, of):
            about = argument.text, of.text
        case syntax.Outcome(_, event, when):
            opened = (fact.name.text,) if isinstance(fact, syntax.Opens) and fact.name else ()
            about = *opened, _text(event), _text(when)
        case syntax.Counts(event) | syntax.Wants(event=event):
            about = (_text(event),)
        case syntax.Keeps(when):
            about = (_text(when),)
        case syntax.Prefers(how, amount):
            about = how.text, _text(amount)
        case syntax.Rewards(amount, None, each, when):
            read = frozenset(_text(term) for term in amount.terms if isinstance(term, Phrase | syntax.Tally))
            about = read, fact.final is None, each and each.sensor.text, _text(when)
        case syntax.Rewards(_, on, _, when):
            about = _text(on), _text(when)
        case syntax.Lasts() | syntax.Starts():  # is said once
            about = ()
        case _:  # that does not belong here: all are reported
            about = (fact,)
    return type(fact), *about


def _text(node: Phrase | syntax.When | syntax.Tally | syntax.Expression | None) -> str:
    """The source text with single spaces; empty for None."""
    return " ".join(said(node).split()) if node else ""
