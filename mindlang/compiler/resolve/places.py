"""Whether what a task puts at a place can be there, beside what else it puts somewhere."""

from collections.abc import Iterator, Sequence
from typing import Any

from mindrun.graph import Start
from mindrun.quantity import ANGLE, COORDINATE, Place
from mindrun.scenes import SceneKind
from mindrun.things.rectangle import Rectangle

from mindlang.compiler.diagnostic import Findings, Label
from mindlang.compiler.model import Part
from mindlang.compiler.resolve.parts import refuse_repeated
from mindlang.compiler.resolve.quantities import convert
from mindlang.compiler.syntax import Declaration, Starts

PLAIN_START: Place = (0.0, 0.0)  # where a robot starts in a plain scene that says nothing else


def check_places(things: Sequence[Part[Any]], scene: SceneKind | None, findings: Findings) -> None:
    """Report what stands where an obstacle stands in every run."""
    for thing in things:
        if thing.kind and thing.kind.places and not thing.kind.is_obstacle:
            _check_places(thing, thing.kind.places, things, scene, findings)


def start_of(
    declaration: Declaration, scene: SceneKind | None, things: Sequence[Part[Any]], findings: Findings
) -> Start:
    """Where the robot starts, as the last line of a task or scene that says so has it."""
    start, said = Start(), [fact for fact in declaration.facts if isinstance(fact, Starts)]
    for fact in said:
        start = Start(_start(fact, scene, things, findings), _facing(fact, findings))
    message = f"The {declaration.header.noun.text} already says where the robot starts."
    refuse_repeated(said, message, "Write both on one line: starts at 0 0 facing 90 deg.", findings)
    is_in_middle = scene and not scene.is_bounded and not _says_place(declaration)
    if is_in_middle and (thing := _solid_at(PLAIN_START, things, scene)):
        hint = f"Write another place for {thing.name}, or starts at and a place for the robot."
        findings.error("inside-obstacle", thing.span, "The robot starts there: in the middle of a plain scene.", hint)
    return start


def _says_place(declaration: Declaration) -> bool:
    """Whether a line says where the robot starts; of a scene, whether that is left to its tasks."""
    places = [fact.place for fact in declaration.facts if isinstance(fact, Starts)]
    return places[-1] is not None if places else declaration.header.noun.text == "scene"


def _facing(fact: Starts, findings: Findings) -> float | None:
    return convert(fact.facing, ANGLE, findings) if fact.facing else None


def _start(fact: Starts, scene: SceneKind | None, things: Sequence[Part[Any]], findings: Findings) -> Place | None:
    """The place that a line names, None where it names none or after reporting that nobody can be there."""
    if fact.place is None:
        return None
    x, y = (convert(amount, COORDINATE, findings) for amount in fact.place)
    if x is None or y is None:
        return None
    if scene and not scene.has_room((x, y), 0.0):
        hint = "Write a place that is in it; 0 0 is the middle."
        findings.error("outside-arena", fact.span, "That is not inside the arena.", hint)
    if thing := _solid_at((x, y), things, scene):
        hint, there = f"Write another place for the robot or {thing.name}.", Label(thing.span, "this one")
        findings.error("inside-obstacle", fact.span, "Something solid stands there.", hint, there)
    return x, y


def _solid_at(place: Place, things: Sequence[Part[Any]], scene: SceneKind | None) -> Part[Any] | None:
    """The first thing that fills a place with something solid when a run begins."""
    for thing in things:
        if thing.kind and any(box.holds(place) for box in (*thing.kind.standing(scene), *_loose(thing.kind))):
            return thing
    return None


def _loose(kind: Any) -> Iterator[Rectangle]:
    """Where loose things stand when a run begins, as far as that is said."""
    half = min(kind.size.first, kind.size.last) / 2
    yield from (Rectangle(x, y, half, half) for x, y in kind.at if kind.is_loose)


def _check_places(
    thing: Part[Any], at: Sequence[Place], things: Sequence[Part[Any]], scene: SceneKind | None, findings: Findings
) -> None:
    for other in things:
        if other.kind and any(box.holds(place) for box in other.kind.standing(scene) for place in at):
            hint = f"Write another place for {thing.name} or {other.name}."
            there = Label(other.span, "this one")
            findings.error("inside-obstacle", thing.span, "An obstacle stands there.", hint, there)
            return
