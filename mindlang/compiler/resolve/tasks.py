"""Tasks: their worlds, their ends, their rewards."""

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

from mindrun.graph.tasks import unfit_thing
from mindrun.kinds.registry import names
from mindrun.numbers.quantity import SECONDS, TICKS

from mindlang.compiler import model
from mindlang.compiler.beginning import first_tick_hint, task_beginning
from mindlang.compiler.diagnostic import Findings, Label, a, listed
from mindlang.compiler.resolve.expressions import Visible, resolve_expressions
from mindlang.compiler.resolve.kinds import make_event
from mindlang.compiler.resolve.parts import refuse_facts, said_once
from mindlang.compiler.resolve.quantities import MAX_RUN_TICKS, TIMES, convert
from mindlang.compiler.resolve.worlds import ResolvedWorld, RobotFacts, resolve_world
from mindlang.compiler.syntax import Counts, Declaration, Ends, Lasts, Name, Opens, Phrase, Rewards, Succeeds, of_form

LASTS = replace(TICKS, low=1.0, high=MAX_RUN_TICKS)


def resolve_tasks(robot: RobotFacts, findings: Findings) -> tuple[model.Task, ...]:
    """Every task, without the lines that are reported; one that several tasks have is reported once."""
    for _, scene in robot.names.declarations("scene"):
        with findings.each_once():
            refuse_facts(scene, findings)
            resolve_world(scene, robot, findings)
    found = []
    for _, declaration in robot.names.declarations("task"):
        with findings.each_once():
            found.append(_task(declaration, robot, findings))
    return tuple(found)


def _task(declaration: Declaration, robot: RobotFacts, findings: Findings) -> model.Task:
    refuse_facts(declaration, findings)
    world = resolve_world(declaration, robot, findings)
    commands = frozenset(robot.names.of("actuator"))
    visible = Visible(robot.widths, world.scope, unread=robot.names.unread, commands=commands, draws=world.drawn)
    ends = _ends(declaration, world, visible, findings)
    _check_decided(ends, world, robot, findings)
    _check_groups(world, robot, findings)
    return model.Task(
        declaration.header.name.text,
        world.scene,
        world.things,
        world.start,
        world.varies,
        world.fails,
        world.draws,
        _ticks(declaration, robot.tick, findings),
        ends,
        tuple(_reward(fact, world, visible, robot, findings) for fact in of_form(declaration.facts, Rewards)),
        tuple(event_in(fact.event, world, findings) for fact in of_form(declaration.facts, Counts)),
        declaration.facts,
        declaration,
    )


def _ticks(declaration: Declaration, tick: float, findings: Findings) -> int:
    """How many ticks a task lasts; 1 where that is wrong."""
    lasts = of_form(declaration.facts, Lasts)
    name = declaration.header.name
    if not lasts:
        if declaration.whole:
            message = f"{name.text} does not say how long it lasts."
            findings.error("endless-task", name.span, message, "Add lasts 10000 ticks.")
        return 1
    said_once(lasts, lambda _: "The task already says how long it lasts.", findings)
    amount = lasts[0].amount
    if amount.unit == "s":
        # What would be a single tick, or none, was surely meant otherwise.
        seconds = convert(amount, replace(SECONDS, low=1.5 * tick, high=MAX_RUN_TICKS * tick), findings)
        return round(seconds / tick) if seconds else 1
    return int(convert(amount, LASTS, findings) or 1)


def event_in(written: Phrase, world: ResolvedWorld, findings: Findings) -> Any:
    """The event of a phrase; one that can never happen in the world is reported."""
    event = make_event(written, world.scope, findings)
    said = (written, *((written.within.of,) if written.within else ()))
    for single, phrase in zip(event.single, said, strict=True) if event else ():
        if found := single.missing(world):
            findings.error("impossible-event", phrase.span, found.reason, found.hint)
    return event


def _ends(
    declaration: Declaration, world: ResolvedWorld, visible: Visible, findings: Findings
) -> tuple[model.End, ...]:
    """The ends of a task's runs, and what opens in them, in the order of the source.

    Of two ends in one tick the first one counts.
    """
    ends = []
    for fact in (fact for fact in declaration.facts if isinstance(fact, Ends | Succeeds | Opens)):
        times = convert(fact.times, TIMES, findings) if fact.times else 1
        event = event_in(fact.event, world, findings) if fact.event else None
        when = resolve_expressions(fact.when, visible, findings)
        if fact.event and event and event.is_of_success and world.can_succeed:
            hint = "Write what a success is: succeeds on 5 delivery of red."
            findings.error("own-success", fact.event.span, "A success ends the run by itself.", hint)
        opens = _opened(fact.name, world, findings) if isinstance(fact, Opens) and fact.name else ""
        ends.append(model.End(event, int(times or 1), when, isinstance(fact, Succeeds), fact, opens))
    return tuple(ends)


def _opened(name: Name, world: ResolvedWorld, findings: Findings) -> str:
    """The name of what opens; one of nothing that stands in the way is reported."""
    there = {thing.name: thing for thing in world.things}
    if world.scope.things is not None and name.text not in world.scope.things:
        hint = findings.suggest(name.text, there) or f"Add contains {name.text} is wall from 0 0 to 4 0 to the task."
        message = f"There is nothing called {name.text} in {world.scope.place}."
        findings.error("unknown-thing", name.span, message, hint)
    elif name.text in there and (kind := there[name.text].kind) and not kind.is_obstacle:
        hint = f"What opens is a wall, a map or an obstacle; {name.text} is {a(names()[type(kind)])}."
        findings.error("unfit-thing", name.span, f"{name.text} cannot open: it bars no way.", hint)
    return name.text


def _check_decided(ends: Sequence[model.End], world: ResolvedWorld, robot: RobotFacts, findings: Findings) -> None:
    """Report an event that ends every run in its first tick."""
    begun = task_beginning(world.scene, world.things, world.start, robot.body_kind, robot.claw)
    sensors = [sensor.kind for sensor in robot.sensors]
    for end in ends:
        if end.event and not end.opens and begun.first_tick_count(end.event, sensors) >= end.times:
            there = (Label(each.span, "this one") for each in world.things if each.name == end.event.thing)
            message = "This ends every run in its first tick."
            findings.error("decided-start", end.fact.span, message, first_tick_hint(end.event), *there)


def _check_groups(world: ResolvedWorld, robot: RobotFacts, findings: Findings) -> None:
    """Report a sensor about several things that are not side by side in a task, or are in its way."""
    for sensor in (each for each in robot.sensors if each.kind):
        if thing := unfit_thing(world.things, sensor.kind.things):
            names, there = listed(sensor.kind.things, "and"), Label(sensor.span, "this one")
            if thing.name in sensor.kind.things:
                message = f"Of the things that {sensor.name} is about, {thing.name} is an obstacle."
                hint = f"Leave it out of {sensor.name}, and write another sensor for it."
            else:
                message = f"{thing.name} stands between {names}, which {sensor.name} is about."
                hint = f"Write the lines of {names} one after the other."
            findings.error("things-apart", thing.span, message, hint, there)
            return  # what stands apart does so for all of them


def _reward(
    fact: Rewards, world: ResolvedWorld, visible: Visible, robot: RobotFacts, findings: Findings
) -> model.Reward:
    each = None
    if fact.each:
        visible = replace(visible, each=fact.each.name.text)
        each = fact.each.sensor.text if robot.names.find(fact.each.sensor, ("sensor", "memory"), findings) else None
    on = event_in(fact.on, world, findings) if fact.on else None
    when = resolve_expressions(fact.when, visible, findings)
    amount = resolve_expressions(fact.amount, visible, findings)
    return model.Reward(amount, on, each, when, fact)
