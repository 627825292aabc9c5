"""Tasks: their worlds, their ends, their rewards."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, TypeVar

from mindrun.kinds.actuators.gripper import REACH_UNITS
from mindrun.kinds.bodies.body import BodyKind
from mindrun.kinds.scenes.scene import SceneKind
from mindrun.kinds.things.thing import MAX_OBSTACLES, ThingKind
from mindrun.numbers.quantity import SECONDS, TICKS, Quantity

from mindlang.compiler import model
from mindlang.compiler.beginning import beginning
from mindlang.compiler.diagnostic import Findings, Label
from mindlang.compiler.names import Names, things_of
from mindlang.compiler.resolve.decided import check_decided
from mindlang.compiler.resolve.expressions import Visible, condition, resolve
from mindlang.compiler.resolve.kinds import Scope, make
from mindlang.compiler.resolve.maps import with_places
from mindlang.compiler.resolve.parts import refuse_facts, refuse_repeated
from mindlang.compiler.resolve.places import check_places, start_of
from mindlang.compiler.resolve.quantities import convert
from mindlang.compiler.resolve.variations import Variable, failures, variations
from mindlang.compiler.syntax import (
    Contains,
    Counts,
    Declaration,
    Ends,
    Fact,
    Fails,
    Lasts,
    Phrase,
    Rewards,
    Starts,
    Succeeds,
    Varies,
)

MAX_RUN_TICKS = 10_000_000  # of a run
TIMES = Quantity("how many times", {"": 1.0}, low=1, high=MAX_RUN_TICKS, whole=True)
LASTS = replace(TICKS, low=1.0, high=MAX_RUN_TICKS)

TASK_FACTS: tuple[type[Fact], ...] = (Contains, Starts, Varies, Fails, Lasts, Ends, Succeeds, Rewards, Counts)
SCENE_FACTS: tuple[type[Fact], ...] = (
    Contains,
    Starts,
    Varies,
    Fails,
)  # what the world is, not what is to be done in it

F = TypeVar("F", bound=Fact)


@dataclass(frozen=True, slots=True)
class RobotFacts:
    """What tasks need to know of the rest of the mind."""

    names: Names
    widths: Mapping[str, int]
    tick: float
    root: Path
    body: model.Part[Any] | None
    actuators: tuple[model.Part[Any], ...]
    sensors: tuple[model.Part[Any], ...]

    @property
    def body_kind(self) -> BodyKind | None:
        """The body; None where none is well said."""
        return self.body.kind if self.body else None

    @property
    def claw(self) -> float:
        """How far ahead of the body things come into reach, with a claw or without."""
        return next((each.kind.reach for each in self.actuators if each.kind.reach is not None), REACH_UNITS)

    @property
    def has_battery(self) -> bool:
        """Whether any sensor reads one."""
        return any(sensor.kind.battery for sensor in self.sensors)


@dataclass(frozen=True, slots=True)
class World:
    """What a task says of its world: what its events and measures can be about."""

    scene: Any  # a SceneKind; None where it is not well said
    things: tuple[model.Part[Any], ...]
    scope: Scope
    has_battery: bool
    can_succeed: bool

    @property
    def kinds(self) -> list[ThingKind]:
        """The kinds of the things that are well said."""
        return [thing.kind for thing in self.things if thing.kind]

    def variable(self, robot: RobotFacts) -> Variable:
        """What can differ from run to run in it."""
        parts = {"body": (robot.body,) if robot.body else (), "actuator": robot.actuators, "sensor": robot.sensors}
        return Variable(robot.names, {**parts, "thing": self.things}, self.scope.place)


def tasks(robot: RobotFacts, findings: Findings) -> tuple[model.Task, ...]:
    """Every task, without the lines that are reported; one that several tasks have is reported once."""
    for _, scene in robot.names.declarations("scene"):
        with findings.each_once():
            refuse_facts(scene, SCENE_FACTS, findings)
            world = _world(scene, robot, findings)
            start_of(scene, world.scene, world.things, robot.body_kind, findings)
            variations(scene, world.variable(robot), findings)
            failures(scene, world.variable(robot), findings)
    found = []
    for name, declaration in robot.names.declarations("task"):
        with findings.each_once():
            found.append(_task(name, declaration, robot, findings))
    return tuple(found)


def _world(declaration: Declaration, robot: RobotFacts, findings: Findings) -> World:
    """What a task or a scene says of the world."""
    noun, name = declaration.header.noun.text, declaration.header.name.text
    things = things_of(declaration) if declaration.whole else None
    scope = Scope(robot.names, things, f"{noun} {name}", root=robot.root)
    phrase = declaration.header.phrase
    scene: Any = make("task", phrase, scope, findings) if phrase else None
    succeeds = not declaration.whole or any(isinstance(fact, Succeeds) for fact in declaration.facts)
    return World(scene, _things(declaration, scene, scope, findings), scope, robot.has_battery, succeeds)


def _task(name: str, declaration: Declaration, robot: RobotFacts, findings: Findings) -> model.Task:
    refuse_facts(declaration, TASK_FACTS, findings)
    world = _world(declaration, robot, findings)
    start = start_of(declaration, world.scene, world.things, robot.body_kind, findings)
    ends = _ends(declaration, world, robot, findings)
    begun = beginning(world.scene, world.things, start, robot.body_kind, robot.claw)
    check_decided(ends, begun, [sensor.kind for sensor in robot.sensors], findings)
    return model.Task(
        name,
        world.scene,
        world.things,
        start,
        variations(declaration, world.variable(robot), findings),
        failures(declaration, world.variable(robot), findings),
        _ticks(declaration, robot.tick, findings),
        ends,
        tuple(_reward(fact, world, robot, findings) for fact in _facts(declaration, Rewards)),
        tuple(event_in(fact.event, world, findings) for fact in _facts(declaration, Counts)),
        declaration.facts,
        declaration,
    )


def _facts(declaration: Declaration, form: type[F]) -> Iterator[F]:
    return (fact for fact in declaration.facts if isinstance(fact, form))


def _things(declaration: Declaration, scene: Any, scope: Scope, findings: Findings) -> tuple[model.Part[Any], ...]:
    found: dict[str, model.Part[Any]] = {}
    obstacles = 0
    for fact in _facts(declaration, Contains):
        name = fact.name.text
        kind = make("content", fact.phrase, scope, findings)
        if name in found:
            first = Label(found[name].span, "first said here")
            message = f"The {declaration.header.noun.text} already contains something called {name}."
            findings.error("duplicate-thing", fact.name.span, message, "Give one of the two another name.", first)
        if kind:
            _check_obstacles(kind, scene, obstacles, fact.phrase, findings)
            obstacles += min(kind.obstacles(scene), MAX_OBSTACLES)  # as if there were few where there are too many
        found.setdefault(name, model.Part(name, kind, fact.name.span))
    is_task = declaration.header.noun.text == "task"  # which has all that a scene lacks
    things = with_places(tuple(found.values()), scene, is_task, findings)
    check_places(things, scene, findings)
    return things


def _check_obstacles(kind: ThingKind, scene: SceneKind | None, before: int, phrase: Phrase, findings: Findings) -> None:
    """What a thing needs of its scene, and how many obstacles there is room for with those `before`."""
    if found := kind.mistake(scene):
        findings.error(found.code, phrase.span, found.message, found.hint)
    elif before <= MAX_OBSTACLES < (made := before + kind.obstacles(scene)):
        message = f"With those above, that makes {made} obstacles."
        findings.error("too-many-obstacles", phrase.span, message, f"A world takes {MAX_OBSTACLES} in all.")


def _ticks(declaration: Declaration, tick: float, findings: Findings) -> int:
    lasts = list(_facts(declaration, Lasts))
    name = declaration.header.name
    if not lasts:
        if declaration.whole:
            message = f"{name.text} does not say how long it lasts."
            findings.error("endless-task", name.span, message, "Add lasts 10000 ticks.")
        return 1
    refuse_repeated(lasts, "The task already says how long it lasts.", "Leave one out.", findings)
    amount = lasts[0].amount
    if amount.unit == "s":
        # What would be a single tick, or none, was surely meant otherwise.
        seconds = convert(amount, replace(SECONDS, low=1.5 * tick, high=MAX_RUN_TICKS * tick), findings)
        return round(seconds / tick) if seconds else 1
    return int(convert(amount, LASTS, findings) or 1)


def event_in(written: Phrase, world: World, findings: Findings) -> Any:
    """The event of a phrase; one that can never happen in the world is reported."""
    event = make("event", written, world.scope, findings)
    if event and (found := event.missing(world)):
        findings.error("impossible-event", written.span, found.reason, found.hint)
    return event


def _ends(declaration: Declaration, world: World, robot: RobotFacts, findings: Findings) -> tuple[model.End, ...]:
    """What ends a run, in the order of the source; of two that come in one tick the first one counts."""
    ends = []
    for fact in (fact for fact in declaration.facts if isinstance(fact, Ends | Succeeds)):
        times = convert(fact.times, TIMES, findings) if fact.times else 1
        event = event_in(fact.event, world, findings) if fact.event else None
        when = condition(fact.when, _visible(world, robot), findings) if fact.when else None
        if fact.event and event and event.is_of_success and world.can_succeed:
            hint = "Write what a success is: succeeds on 5 delivery of red."
            findings.error("own-success", fact.event.span, "A success ends the run by itself.", hint)
        ends.append(model.End(event, int(times or 1), when, isinstance(fact, Succeeds), fact))
    return tuple(ends)


def _visible(world: World, robot: RobotFacts) -> Visible:
    """What the expressions of a task can see."""
    commands = frozenset(robot.names.of("actuator"))
    return Visible(robot.widths, world.scope, unread=robot.names.unread, commands=commands)


def _reward(fact: Rewards, world: World, robot: RobotFacts, findings: Findings) -> model.Reward:
    visible = _visible(world, robot)
    each = None
    if fact.each:
        visible = replace(visible, each=fact.each.name.text)
        each = fact.each.sensor.text if robot.names.find(fact.each.sensor, ("sensor", "memory"), findings) else None
    on = event_in(fact.on, world, findings) if fact.on else None
    when = condition(fact.when, visible, findings) if fact.when else None
    return model.Reward(resolve(fact.amount, visible, findings), on, each, when, fact)
