"""The world of a task or a scene: things, where they and the robot begin, variations and failures."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from math import prod
from pathlib import Path
from typing import Any

from mindrun.graph.draws import Draw
from mindrun.graph.graph import VARIED_NOUNS, Failure, Start, Variation, Varying
from mindrun.kinds.actuators.actuator import REACH_UNITS
from mindrun.kinds.bodies.body import BodyKind
from mindrun.kinds.registry import arguments, varied_quantity, varying_of
from mindrun.kinds.registry import names as kind_names
from mindrun.kinds.scenes.scene import SceneKind
from mindrun.kinds.things.robot import MOST_ROBOTS
from mindrun.kinds.things.thing import MAX_OBSTACLES, MAX_THINGS, ThingKind, ThingMistake, outside
from mindrun.numbers.expression import Program
from mindrun.numbers.quantity import ANGLE, COORDINATE, RATE

from mindlang.compiler.beginning import Beginning, task_beginning
from mindlang.compiler.diagnostic import Findings, Label, did_you_mean, listed
from mindlang.compiler.model import Part, Thing
from mindlang.compiler.names import Names, declared_things
from mindlang.compiler.resolve.draws import may_leave, resolve_draws, with_drawn
from mindlang.compiler.resolve.expressions import Visible, Widths, resolve_expressions
from mindlang.compiler.resolve.kinds import Scope, make_kind
from mindlang.compiler.resolve.maps import map_start, with_places
from mindlang.compiler.resolve.parts import said_once
from mindlang.compiler.resolve.quantities import convert
from mindlang.compiler.source import Span
from mindlang.compiler.syntax import Contains, Declaration, Fails, Name, Starts, Succeeds, Varies, When, of_form

IN_ARENA = "Write a place that is in it with all of the robot; 0 0 is the middle."
NAMES = "Name the body, an actuator, a sensor or a thing of the task."


@dataclass(frozen=True, slots=True)
class RobotFacts:
    """The parts of a mind that its tasks are checked against."""

    names: Names
    widths: Widths
    tick: float
    root: Path
    body: Part[Any] | None
    actuators: tuple[Part[Any], ...]
    sensors: tuple[Part[Any], ...]

    @property
    def parts(self) -> tuple[Part[Any], ...]:
        """The sensors and the actuators."""
        return (*self.sensors, *self.actuators)

    @property
    def body_kind(self) -> BodyKind | None:
        """The body; None where none is well said."""
        return self.body.kind if self.body else None

    @property
    def claw(self) -> float:
        """How far ahead of the body things come into reach, with a claw or without."""
        return next((each.kind.reach for each in self.actuators if each.kind.reach is not None), REACH_UNITS)


@dataclass(frozen=True, slots=True)
class ResolvedWorld:
    """A scene, None where it is not well said, and its things; how runs in it begin, and what differs between them."""

    scene: Any
    things: tuple[Thing, ...]
    scope: Scope
    has_battery: bool
    can_succeed: bool
    start: Start = field(default_factory=Start)
    varies: tuple[Variation, ...] = ()
    fails: tuple[Failure, ...] = ()
    draws: tuple[Draw, ...] = ()

    @property
    def drawn(self) -> dict[str, Draw]:
        """The numbers that it draws, by their names."""
        return {draw.name: draw for draw in self.draws}

    @property
    def kinds(self) -> list[ThingKind]:
        """The kinds of the things that are well said."""
        return [thing.kind for thing in self.things if thing.kind]


def resolve_world(declaration: Declaration, robot: RobotFacts, findings: Findings) -> ResolvedWorld:
    """The world that a task or a scene declares; the lines that are wrong are reported and left out."""
    noun, name = declaration.header.noun.text, declaration.header.name.text
    scope = Scope(
        robot.names, declared_things(declaration) if declaration.whole else None, f"{noun} {name}", root=robot.root
    )
    phrase = declaration.header.phrase
    scene = make_kind("task", phrase, scope, findings) if phrase else None
    draws = resolve_draws(declaration, robot.names, findings)
    things = _things(declaration, scene, scope, {draw.name: draw for draw in draws}, robot.body_kind, findings)
    parts = {"body": (robot.body,) if robot.body else (), "actuator": robot.actuators, "sensor": robot.sensors}
    variable = _Variable(robot.names, {**parts, "thing": things}, scope.place, findings)
    return ResolvedWorld(
        scene,
        things,
        scope,
        any(sensor.kind.battery for sensor in robot.sensors),
        not declaration.whole or bool(of_form(declaration.facts, Succeeds)),
        _start(declaration, scene, things, robot.body_kind, findings),
        tuple(variable.variations(declaration)),
        tuple(variable.failures(declaration)),
        draws,
    )


def _things(
    declaration: Declaration,
    scene: Any,
    scope: Scope,
    draws: Mapping[str, Draw],
    body: BodyKind | None,
    findings: Findings,
) -> tuple[Thing, ...]:
    found: dict[str, Thing] = {}
    obstacles = 0
    for fact in of_form(declaration.facts, Contains):
        name = fact.name.text
        phrase, by, many = with_drawn(fact.phrase, draws, scope.names.unread, findings)
        kind: Any = make_kind("content", phrase, scope, findings) if phrase else None
        if name in found:
            places, hint = (found[name].span, fact.name.span), "Give one of the two another name."
            message = f"The {declaration.header.noun.text} already contains something called {name}."
            findings.refuse_again("duplicate-thing", places, message, hint)
        if kind:
            if mistake := _mistake(kind, by, [*draws.values()], scene, body):
                findings.error(mistake.code, fact.phrase.span, mistake.message, mistake.hint)
            elif obstacles <= MAX_OBSTACLES < (made := obstacles + kind.obstacles(scene)):
                message = f"With those above, that makes {made} obstacles."
                hint = f"A world takes {MAX_OBSTACLES} in all."
                findings.error("too-many-obstacles", fact.phrase.span, message, hint)
            obstacles += min(kind.obstacles(scene), MAX_OBSTACLES)  # as if there were few where there are too many
        when, master = _presence(fact, draws, scope, findings), _master(fact, kind, scope, findings)
        found.setdefault(name, Thing(name, kind, fact.name.span, when=when, by=by, many=many, master=master))
    for thing in (each for each in found.values() if each.kind and isinstance(each.kind.within, str)):
        zone = found.get(str(thing.kind.within))
        if zone and zone.kind and zone.kind.within:
            message = f"{zone.name} is itself within something."
            hint = f"Write another zone, or a place for {zone.name}."
            findings.error("unfit-thing", thing.span, message, hint, Label(zone.span, "this one"))
    is_task = declaration.header.noun.text == "task"  # which has all that a scene lacks
    things = with_places(tuple(found.values()), scene, is_task, findings)
    _check_robots([thing for thing in things if thing.kind and thing.kind.is_robot], scene, body, findings)
    _check_places(things, scene, body, findings)
    return things


def _mistake(
    kind: ThingKind, by: Sequence[Program], draws: Sequence[Draw], scene: SceneKind | None, body: BodyKind | None
) -> ThingMistake | None:
    """The error that keeps a thing out of a scene, or None: of a robot, too, whose body says how large it is."""
    half = body.radius if kind.is_robot and body else kind.largest / 2
    mistake = kind.mistake(scene) or outside(scene, kind.spots if kind.is_robot else (), half, IN_ARENA)
    if mistake or not (scene and may_leave(half, by, draws, scene)):
        return mistake
    hint = "Write a place that is in it with all of the thing, whatever is drawn; 0 0 is the middle."
    return ThingMistake("outside-arena", "That is not always inside the arena.", hint)


def _check_robots(robots: Sequence[Thing], scene: SceneKind | None, body: BodyKind | None, findings: Findings) -> None:
    """Report robots that are too many, that are larger than their arena, or are not always there."""
    count = 1
    for thing in robots:
        count += thing.kind.copies
        if thing.when or thing.many:
            hint = "Write a count and no condition; a task for each number of robots."
            findings.error("cannot-vary", thing.span, "There are as many robots in every run.", hint)
        if count > MOST_ROBOTS:
            hint = f"A world takes {MOST_ROBOTS}: write a smaller count."
            findings.error("too-many-things", thing.span, f"That makes {count} robots, with the first.", hint)
            return
        if scene and body and count * prod(body.area) > prod(scene.sides):
            message = f"{count} robots, with the first, are larger than the arena."
            findings.error("outside-arena", thing.span, message, "Write a larger arena, or a smaller count.")


def _master(fact: Contains, kind: ThingKind | None, scope: Scope, findings: Findings) -> str:
    """The skill that is in charge of a robot; empty where the line names none, or none that there is."""
    if fact.master is None:
        return ""
    if kind and not kind.is_robot:
        hint = f"Leave under {fact.master.text} out: a skill is in charge of a robot alone."
        findings.error("unfit-thing", fact.master.span, f"{fact.name.text} is no robot.", hint)
    return fact.master.text if scope.names.find(fact.master, ("skill",), findings) else ""


def _presence(fact: Contains, draws: Mapping[str, Draw], scope: Scope, findings: Findings) -> When | None:
    """The condition under which a thing is there; None where it always is."""
    made_of = "numbers, and of what the task draws"
    visible = Visible({}, unread=scope.names.unread, draws=draws, made_of=made_of, where="A condition of a thing")
    return resolve_expressions(fact.when, visible, findings)


def _check_places(things: Sequence[Thing], scene: SceneKind | None, body: BodyKind | None, findings: Findings) -> None:
    """Report one thing too many, or else what stands where something else stands in every run."""
    apart = [
        thing.span
        for thing in things
        if not (thing.kind and thing.kind.is_obstacle)
        for _ in range(thing.kind.copies if thing.kind else 1)
    ]
    if len(apart) > MAX_THINGS:
        hint = f"A world takes {MAX_THINGS} beside its obstacles: leave some out."
        findings.error("too-many-things", apart[MAX_THINGS], f"That is thing number {MAX_THINGS + 1}.", hint)
        return
    met: dict[str, tuple[Thing, Thing]] = {}
    for thing, other in Beginning(scene, things, None, None, body, 0.0).overlapping():
        met.setdefault(thing.name, (thing, other))
    for thing, other in met.values():
        hint, there = f"Write another place for {thing.name} or {other.name}.", Label(other.span, "this one")
        if thing is other:
            hint = "Write places that are farther apart, or a smaller size."
            findings.error("same-place", thing.span, f"Two of {thing.name} are in one another.", hint)
        elif other.kind.is_obstacle:
            findings.error("inside-obstacle", thing.span, "An obstacle stands there.", hint, there)
        else:
            findings.error("same-place", thing.span, f"It is in {other.name} when a run begins.", hint, there)


def _start(
    declaration: Declaration, scene: SceneKind | None, things: Sequence[Thing], body: Any, findings: Findings
) -> Start:
    """Where the robot starts, as the last line of a task or scene that says so has it; `body` is None if not known."""
    start, said = Start(), of_form(declaration.facts, Starts)
    for fact in said:
        facing = convert(fact.facing, ANGLE, findings) if fact.facing else None
        x, y = (convert(amount, COORDINATE, findings) for amount in fact.place) if fact.place else (None, None)
        start = Start(None if x is None or y is None else (x, y), facing)
    message = f"The {declaration.header.noun.text} already says where the robot starts."
    said_once(said, lambda _: message, findings, "Write both on one line: starts at 0 0 facing 90 deg.")
    drawn = None if said and said[-1].place else map_start(things, findings)
    start = replace(start, at=drawn[0]) if drawn else start
    where = drawn[1] if drawn else said[-1].span if start.at else None
    is_left_open = declaration.header.noun.text == "scene" and not (said or drawn)  # to the tasks in it
    if scene and not is_left_open and not (said and said[-1].place and not start.at):
        begun = task_beginning(scene, things, start, body, 0.0)
        _check_start(declaration.header.name.span, where, begun, findings)
    return start


def _check_start(here: Span, said: Span | None, begun: Beginning, findings: Findings) -> None:
    """Report a robot that starts in the border of its arena or in a thing, or has no room at all.

    `here` is the name of the task, `said` where it says the robot's place.
    """
    if not begun.is_inside and said is None:
        message = "The robot does not fit into it."
        findings.error("outside-arena", here, message, "Write a larger arena, or a smaller body.")
        return
    if not begun.is_inside and said:
        findings.error("outside-arena", said, "That is not inside the arena.", IN_ARENA)
    if not (thing := begun.on_robot()):
        return
    if said is None:
        hint = f"Write another place for {thing.name}, or starts at and a place for the robot."
        message = "The robot starts there: in the middle of a plain scene."
        findings.error("inside-obstacle", thing.span, message, hint)
        return
    hint, there = f"Write another place for the robot or {thing.name}.", Label(thing.span, "this one")
    if thing.kind.is_solid:
        findings.error("inside-obstacle", said, "Something solid stands there.", hint, there)
    else:
        findings.error("same-place", said, f"The robot starts in {thing.name}.", hint, there)


@dataclass(frozen=True, slots=True)
class _Variable:
    """The parts that can vary from run to run, by noun: those of the robot, and the things of a task or scene."""

    names: Names
    parts: Mapping[str, Sequence[Part[Any]]]
    place: str
    findings: Findings

    def variations(self, declaration: Declaration) -> Iterator[Variation]:
        """The variations of a task or a scene, each once."""
        facts, already = of_form(declaration.facts, Varies), "The task already says how {} of {} varies."
        once = said_once(facts, lambda fact: already.format(fact.argument.text, fact.of.text), self.findings)
        return filter(None, map(self._variation, once))

    def failures(self, declaration: Declaration) -> Iterator[Failure]:
        """The failures of actuators in a task or a scene, each once."""
        facts = of_form(declaration.facts, Fails)
        for fact in said_once(facts, lambda fact: f"The task already says how {fact.name.text} fails.", self.findings):
            actuator = self.names.find(fact.name, ("actuator",), self.findings)
            rate = convert(fact.rate, RATE, self.findings)
            if actuator and rate is not None:
                yield Failure(fact.name.text, rate)

    def _variation(self, fact: Varies) -> Variation | None:
        of, key = self._find(fact.of), fact.argument
        if of is None:
            return None
        noun, kind = of
        known = {each.key: each.field for each in arguments(type(kind))}
        field = known.get(key.text, "")
        quantity = varied_quantity(kind, field)
        if quantity is None:
            varying = [word for word, each in known.items() if each in varying_of(kind)]
            can = (
                f"Of {fact.of.text} can vary {listed(varying)}." if varying else f"Nothing of {fact.of.text} can vary."
            )
            if field:
                message = f"{key.text} of {fact.of.text} is the same in every run."
                self.findings.error("cannot-vary", key.span, message, can)
            else:
                message = f"{kind_names()[type(kind)]} has no argument called {key.text}."
                self.findings.error("unknown-argument", key.span, message, did_you_mean(key.text, varying) or can)
            return None
        if (high := convert(fact.high, quantity, self.findings)) is None:
            return None
        if (low := convert(fact.low, quantity, self.findings, fact.high.unit)) is None:
            return None
        if low > high:
            where = Span(fact.span.source, fact.low.span.start, fact.high.span.end)
            message = "This range ends below its beginning."
            self.findings.error("range-backwards", where, message, "Write the smaller number first.")
            return None
        return Variation(noun, "" if noun == "body" else fact.of.text, field, float(low), float(high))

    def _find(self, name: Name) -> tuple[Varying, Any] | None:
        """The noun and kind of a named part; None after reporting an unknown name, or for a part with mistakes."""
        noun: Varying = self.names.noun_of(name.text, VARIED_NOUNS) or "thing"
        if found := [part for part in self.parts[noun] if part.name == name.text]:
            return (noun, found[0].kind) if found[0].kind else None
        if self.names.noun_of(name.text, ("memory",)):
            self.findings.error("cannot-vary", name.span, "A memory is the same in every run.", NAMES)
        elif noun == "thing" and name.text not in self.names.unread:
            known = [*self.names.of(*VARIED_NOUNS), *(thing.name for thing in self.parts["thing"])]
            hint = self.findings.suggest(name.text, known) or NAMES
            message = f"There is no part of the robot and nothing in {self.place} called {name.text}."
            self.findings.error("unknown-part", name.span, message, hint)
        return None
