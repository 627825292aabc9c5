"""Whether what a task puts at a place can be there, beside what else it puts somewhere, the robot included."""

from collections.abc import Sequence
from typing import Any

from mindrun.graph.graph import Start
from mindrun.kinds.scenes.scene import SceneKind
from mindrun.kinds.things.thing import MAX_THINGS
from mindrun.numbers.quantity import ANGLE, COORDINATE, Place

from mindlang.compiler.beginning import Beginning, beginning
from mindlang.compiler.diagnostic import Findings, Label
from mindlang.compiler.model import Part
from mindlang.compiler.resolve.parts import refuse_repeated
from mindlang.compiler.resolve.quantities import convert
from mindlang.compiler.syntax import Declaration, Starts


def check_places(things: Sequence[Part[Any]], scene: SceneKind | None, findings: Findings) -> None:
    """Report one thing too many, and what stands where something else stands in every run."""
    _check_number(things, findings)
    told = set()
    for thing, other in Beginning(scene, things, None, None, None, 0.0).meeting():
        if thing.name in told:
            continue
        told.add(thing.name)
        if thing is other:
            hint = "Write places that are farther apart, or a smaller size."
            findings.error("same-place", thing.span, f"Two of {thing.name} are in one another.", hint)
            continue
        hint, there = f"Write another place for {thing.name} or {other.name}.", Label(other.span, "this one")
        if other.kind.is_obstacle:
            findings.error("inside-obstacle", thing.span, "An obstacle stands there.", hint, there)
        else:
            findings.error("same-place", thing.span, f"It is in {other.name} when a run begins.", hint, there)


def _check_number(things: Sequence[Part[Any]], findings: Findings) -> None:
    """A world looks at all of its things in every tick, and has so many."""
    apart = [
        thing
        for thing in things
        if not (thing.kind and thing.kind.is_obstacle)
        for _ in range(thing.kind.copies if thing.kind else 1)
    ]
    if len(apart) > MAX_THINGS:
        hint = f"A world takes {MAX_THINGS} beside its obstacles: leave some out."
        findings.error("too-many-things", apart[MAX_THINGS].span, f"That is thing number {MAX_THINGS + 1}.", hint)


def start_of(
    declaration: Declaration, scene: SceneKind | None, things: Sequence[Part[Any]], body: Any, findings: Findings
) -> Start:
    """Where the robot starts, as the last line of a task or scene that says so has it; `body` is None if not known."""
    start, said = Start(), [fact for fact in declaration.facts if isinstance(fact, Starts)]
    for fact in said:
        start = Start(_place(fact, findings), convert(fact.facing, ANGLE, findings) if fact.facing else None)
    message = f"The {declaration.header.noun.text} already says where the robot starts."
    refuse_repeated(said, message, "Write both on one line: starts at 0 0 facing 90 deg.", findings)
    is_left_open = declaration.header.noun.text == "scene" and not said  # to the tasks in it
    if scene and not is_left_open and not (said and said[-1].place and not start.at):
        _check_start(declaration, said[-1] if start.at else None, beginning(scene, things, start, body, 0.0), findings)
    return start


def _place(fact: Starts, findings: Findings) -> Place | None:
    """The place that a line names, None where it names none or after reporting what is wrong with it."""
    if fact.place is None:
        return None
    x, y = (convert(amount, COORDINATE, findings) for amount in fact.place)
    return None if x is None or y is None else (x, y)


def _check_start(declaration: Declaration, fact: Starts | None, begun: Beginning, findings: Findings) -> None:
    """Report a robot that starts in the border of its arena or in a thing, or has no room at all."""
    if not begun.is_inside:
        if fact is None:
            hint = "Write a larger arena, or a smaller body."
            findings.error("outside-arena", declaration.header.name.span, "The robot does not fit into it.", hint)
            return
        hint = "Write a place that is in it with all of the robot; 0 0 is the middle."
        findings.error("outside-arena", fact.span, "That is not inside the arena.", hint)
    if thing := begun.on_robot():
        if fact is None:
            hint = f"Write another place for {thing.name}, or starts at and a place for the robot."
            message = "The robot starts there: in the middle of a plain scene."
            findings.error("inside-obstacle", thing.span, message, hint)
            return
        hint, there = f"Write another place for the robot or {thing.name}.", Label(thing.span, "this one")
        if thing.kind.is_solid:
            findings.error("inside-obstacle", fact.span, "Something solid stands there.", hint, there)
        else:
            findings.error("same-place", fact.span, f"The robot starts in {thing.name}.", hint, there)
