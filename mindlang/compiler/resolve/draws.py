"""The numbers that a task draws, and the places and counts of things that they are."""

from collections.abc import Mapping, Sequence, Set
from itertools import product
from math import isnan
from typing import Any

from mindrun.graph.draws import MAX_VALUES, Draw, ends_of, intervals_of
from mindrun.kinds.scenes.scene import SceneKind
from mindrun.numbers.expression import Program, is_valid_program, leaves
from mindrun.numbers.intervals import Interval
from mindrun.numbers.quantity import COORDINATE, NUMBER, fits
from msgspec.structs import replace

from mindlang.compiler import syntax
from mindlang.compiler.diagnostic import Findings
from mindlang.compiler.names import SHARED, Names, refuse_declared
from mindlang.compiler.parse.build import as_expression
from mindlang.compiler.resolve.expressions import Visible, resolve_expression
from mindlang.compiler.resolve.parts import said_once
from mindlang.compiler.resolve.quantities import convert, value_list

PLACE_NUMBERS = 2


def resolve_draws(declaration: syntax.Declaration, names: Names, findings: Findings) -> tuple[Draw, ...]:
    """The numbers that a task or a scene draws, each once; the lines that are wrong are reported and left out."""
    found = []
    facts = syntax.of_form(declaration.facts, syntax.Draws)
    for fact in said_once(facts, lambda fact: f"The task already draws {fact.name.text}.", findings):
        name = fact.name
        if noun := names.noun_of(name.text, SHARED["draw"]):
            refuse_declared(names, noun, name, findings)
        elif draw := _draw(fact, findings):
            found.append(draw)
    return tuple(found)


def _draw(fact: syntax.Draws, findings: Findings) -> Draw | None:
    match fact.of:
        case syntax.Range(by=by) as several:
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


def with_drawn(
    phrase: syntax.Phrase, draws: Mapping[str, Draw], unread: Set[str], findings: Findings
) -> tuple[syntax.Phrase | None, tuple[Program, ...], int]:
    """The phrase of a thing with all that may be drawn of it, then its x and its y, then which number counts it.

    It is at every place that may be drawn, of a range at the ends, and there are as many as there may be. It is None
    after reporting a place that is none. The place is empty and the number 0 where they are not drawn.
    """
    changed, many = dict[str, list[syntax.Argument]](), 0
    by: tuple[Program, ...] = ()
    for argument in phrase.arguments:
        match argument.key.text, argument.value:
            case ("at", syntax.Numbers() | syntax.Sums()) | ("along", syntax.Points(by=None)) if _is_computed(
                argument.value, draws
            ):
                by = _coordinates(argument.value, draws, unread, findings)
                if not by:
                    return None, (), 0
                changed[argument.key.text] = _at_each(argument, ends_of(by, [*draws.values()]))
            case "count", syntax.Name(text) if text in draws:
                if not _check_count(argument.value, draws[text], findings):
                    return None, (), 0
                many = [*draws].index(text) + 1
                most = syntax.Amount(draws[text].interval[1], "", argument.value.span)
                changed["count"] = [replace(argument, value=syntax.Numbers((most,), argument.value.span))]
    others = ("or",) if "along" in changed else ("or", "count")
    if by and any(each.key.text in others for each in phrase.arguments):
        hint = "Write a thing for each of them, or leave the drawn number out."
        findings.error("place-for-many", phrase.span, "A drawn number is the place of one thing.", hint)
        return None, (), 0
    arguments = (each for argument in phrase.arguments for each in changed.get(argument.key.text, [argument]))
    is_drawn = any(leaves(program, "drawn") for program in by)
    return replace(phrase, arguments=tuple(arguments)), by if is_drawn else (), many


def may_leave(half: float, by: Sequence[Program], draws: Sequence[Draw], scene: SceneKind) -> bool:
    """True if something of half that size, at a place that is drawn, may not be inside a scene with all of it."""
    ends = [[end for _, found in intervals_of(program, draws) for end in found] for program in by]
    hulls = [(min(each), max(each)) for each in ends]
    corners = (corner for place in zip(hulls[::2], hulls[1::2], strict=True) for corner in product(*place))
    return not all(scene.has_room(corner, half) for corner in corners)


def _places(value: Any) -> tuple[syntax.Numbers | syntax.Sums, ...]:
    return value.points if isinstance(value, syntax.Points) else (value,)


def _is_computed(value: Any, draws: Mapping[str, Draw]) -> bool:
    """True if a place is more than two numbers that are said; one of other than two is reported where all are."""
    return any(isinstance(at, syntax.Sums) or any(each.name in draws for each in at.amounts) for at in _places(value))


def _coordinates(value: Any, draws: Mapping[str, Draw], unread: Set[str], findings: Findings) -> tuple[Program, ...]:
    """The programs of x and y; none after reporting what is wrong."""
    written = list[syntax.Expression]()
    for at in _places(value):
        both = at.sums if isinstance(at, syntax.Sums) else [as_expression(each) for each in at.amounts]
        written += both
        if len(both) != PLACE_NUMBERS:
            hint = (
                "A sign with a space on both sides is plus or minus; one that touches a number begins the next: 10 -20."
            )
            findings.error("not-a-place", at.span, "A place is two numbers, along x and along y.", hint)
            return ()
    visible = Visible(
        {}, unread=unread, draws=draws, made_of="numbers, and of what the task draws", where="A drawn place"
    )
    found, indices = list[Program](), {draw: index for index, draw in enumerate(draws.values())}
    for each in written:
        formula = resolve_expression(each, visible, findings).formula
        program = tuple((word, indices.get(x, x) if word == "drawn" else x) for word, x in formula)
        if is_valid_program(program) and _check_coordinate(each, program, [*draws.values()], findings):
            found.append(program)
    return tuple(found) if len(found) == len(written) else ()


def _check_coordinate(written: syntax.Expression, program: Program, draws: Sequence[Draw], findings: Findings) -> bool:
    """True if a program is a coordinate whatever is drawn; the first case in which it is none is reported."""
    for known, found in intervals_of(program, draws):
        if fits(COORDINATE, found):
            continue
        where = " and ".join(f"{draws[index].name} is {_in_words(its)}" for index, its in known.items())
        is_, hint = _in_words(found), f"Write what is at least {COORDINATE.low:g} and at most {COORDINATE.high:g}."
        if isnan(found[0]):
            is_, hint = "no number", "Divide by nothing that can be 0."
        message = f"{' '.join(written.span.text.split())} is {is_}{f' where {where}' if where else ''}."
        findings.error("out-of-range", written.span, message, hint)
        return False
    return True


def _in_words(of: Interval) -> str:
    return f"{of[0]:g}" if of[0] == of[1] else f"{of[0]:g} to {of[1]:g}"


def _check_count(name: syntax.Name, draw: Draw, findings: Findings) -> bool:
    """True if a number that is drawn says how many things there are; one that does not is reported."""
    if draw.is_count and draw.interval[1] >= 1:
        return True
    hint = f"Draw whole numbers, as in draws {name.text} from 0 1 2."
    findings.error("not-whole", name.span, f"{name.text} does not say how many there are.", hint)
    return False


def _at_each(argument: syntax.Argument, places: Sequence[Sequence[float]]) -> list[syntax.Argument]:
    """The argument of the first place or way, and that of all others, if there are any."""
    span = argument.span

    def said(numbers: Sequence[float]) -> syntax.Numbers | syntax.Points:
        pairs = zip(numbers[::2], numbers[1::2], strict=True)
        points = [syntax.Numbers(tuple(syntax.Amount(x, "", span) for x in pair), span) for pair in pairs]
        return points[0] if len(points) == 1 else syntax.Points(tuple(points), None, span)

    first, *others = map(said, places)
    instead = [syntax.Argument(syntax.Name("or", span), syntax.Either(tuple(others), span), span)] if others else []
    return [replace(argument, value=first), *instead]
