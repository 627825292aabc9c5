"""The numbers that a task draws, and the places of things that they are."""

from collections.abc import Mapping
from itertools import product
from math import isfinite

from mindrun.graph.draws import MAX_VALUES, Draw
from mindrun.numbers.quantity import NUMBER
from msgspec.structs import replace

from mindlang.compiler.diagnostic import Findings, Label, a
from mindlang.compiler.names import SHARED, Names
from mindlang.compiler.resolve.parts import said_once
from mindlang.compiler.resolve.quantities import convert, value_list
from mindlang.compiler.syntax import Amount, Argument, Declaration, Draws, Either, Name, Numbers, Phrase, Range, of_form

PLACE_NUMBERS = 2
Signed = tuple[int, int]  # which number is x, and which y: counted from 1, below 0 where it is negated, 0 for none


def resolve_draws(declaration: Declaration, names: Names, findings: Findings) -> tuple[Draw, ...]:
    """The numbers that a task or a scene draws, each once; the lines that are wrong are reported and left out."""
    found = []
    facts = of_form(declaration.facts, Draws)
    for fact in said_once(facts, lambda fact: f"The task already draws {fact.name.text}.", findings):
        name = fact.name
        if noun := names.noun_of(name.text, SHARED["draw"]):
            first = Label(names.place_of(noun, name.text), "first declared here")
            message, hint = f"There is already {a(noun)} called {name.text}.", "Give one of the two another name."
            findings.error("duplicate-name", name.span, message, hint, first)
        elif draw := _draw(fact, findings):
            found.append(draw)
    return tuple(found)


def _draw(fact: Draws, findings: Findings) -> Draw | None:
    match fact.of:
        case Range(by=by) as several:
            if by:
                hint = "Write each of its numbers, with spaces between, or leave by out."
                findings.error("no-range", several.span, "A range that is drawn from has no steps.", hint)
                return None
            ends = [convert(each, NUMBER, findings) for each in (several.first, several.last)]
            low, high = (None if each is None else float(each) for each in ends)
            if low is None or high is None:
                return None
            if low > high:
                hint = "Write the smaller number first."
                findings.error("range-backwards", several.span, "This range ends below its beginning.", hint)
                return None
            return Draw(fact.name.text, (low, high), is_range=True)
        case several:
            values = value_list(several, NUMBER, findings)
            if values and len(values) > MAX_VALUES:
                hint = "Write a range: from 0 to 10."
                findings.error("too-many-numbers", several.span, f"That is more than {MAX_VALUES} numbers.", hint)
                return None
            return Draw(fact.name.text, tuple(map(float, values))) if values else None


def at_drawn(phrase: Phrase, draws: Mapping[str, Draw], findings: Findings) -> tuple[Phrase, Signed]:
    """The phrase of a thing with every place at which a drawn number may put it, and which number is its x and its y.

    Of a range these are its ends.
    """
    numbers = {name: place for place, name in enumerate(draws, 1)}
    for place, argument in enumerate(phrase.arguments):
        amounts = argument.value.amounts if isinstance(argument.value, Numbers) else ()
        if (
            argument.key.text != "at"
            or len(amounts) != PLACE_NUMBERS
            or not any(each.name in draws for each in amounts)
        ):
            continue
        signs = [int(each.number) * numbers[each.name] if each.name in draws else 0 for each in amounts]
        first, *others = (Numbers(both, argument.value.span) for both in product(*(_ends(a, draws) for a in amounts)))
        instead = [Argument(Name("or", argument.span), Either(tuple(others), argument.span), argument.span)]
        is_said = all(isfinite(each.number) for each in amounts)  # what is not is reported once
        changed = [replace(argument, value=first), *(instead if others and is_said else [])]
        arguments = (*phrase.arguments[:place], *changed, *phrase.arguments[place + 1 :])
        if any(each.key.text in ("or", "count") for each in phrase.arguments):
            hint = "Write a thing for each of them, or leave the drawn number out."
            findings.error("place-for-many", phrase.span, "A drawn number is the place of one thing.", hint)
            arguments = tuple(each for each in arguments if each in changed or each.key.text not in ("or", "count"))
        return replace(phrase, arguments=arguments), (signs[0], signs[1])
    return phrase, (0, 0)


def _ends(amount: Amount, draws: Mapping[str, Draw]) -> list[Amount]:
    """The amounts that may stand for one."""
    if amount.name not in draws:
        return [amount]
    return [replace(amount, number=amount.number * end, name="") for end in draws[amount.name].ends]
