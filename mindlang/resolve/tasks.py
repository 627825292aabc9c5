"""Tasks: their worlds, their ends, their rewards."""

from collections.abc import Iterator, Mapping
from dataclasses import replace
from typing import Any, TypeVar

from mindrun.events import Delivery, Event, Exhaustion, Visit
from mindrun.quantity import SECONDS, TICKS
from mindrun.sensors import Battery
from mindrun.world import Arena, Zone

from mindlang import model, syntax
from mindlang.diagnostic import Findings, Label
from mindlang.resolve.expressions import Visible, resolve
from mindlang.resolve.kinds import Scope, make
from mindlang.resolve.names import Names, things_of
from mindlang.resolve.parts import refuse_facts
from mindlang.resolve.quantities import convert
from mindlang.syntax import Contains, Counts, Declaration, Ends, Fact, Lasts, Phrase, Rewards

LASTS = replace(TICKS, low=1.0)

F = TypeVar("F", bound=Fact)


def tasks(
    names: Names, sensors: tuple[model.Part[Any], ...], widths: Mapping[str, int], tick: float, findings: Findings
) -> tuple[model.Task, ...]:
    """Every task, without the lines that are reported."""
    has_battery = any(isinstance(sensor.kind, Battery) for sensor in sensors)
    return tuple(
        _task(name, declaration, names, widths, tick, has_battery, findings)
        for name, declaration in names.declarations("task")
    )


def _task(
    name: str, declaration: Declaration, names: Names, widths: Mapping[str, int], tick: float, has_battery: bool,
    findings: Findings,
) -> model.Task:  # fmt: skip
    refuse_facts(declaration, (Contains, Lasts, Ends, Rewards, Counts), findings)
    scope = Scope(names, things_of(declaration) if declaration.whole else None, f"task {name}")
    phrase = declaration.header.phrase
    scene: Any = make("task", phrase, scope, findings) if phrase else None
    things = _things(declaration, scope, findings)

    def event(written: Phrase) -> Any:
        made = make("event", written, scope, findings)
        if scene and made:
            _possible(made, written, scene, things, has_battery, findings)
        return made

    visible = Visible(widths, scope)
    return model.Task(
        name,
        scene,
        things,
        _ticks(declaration, tick, findings),
        tuple(event(fact.event) for fact in _facts(declaration, Ends)),
        tuple(
            _reward(fact, fact.on and event(fact.on), names, visible, findings) for fact in _facts(declaration, Rewards)
        ),
        tuple(event(fact.event) for fact in _facts(declaration, Counts)),
        declaration,
    )


def _facts(declaration: Declaration, form: type[F]) -> Iterator[F]:
    return (fact for fact in declaration.facts if isinstance(fact, form))


def _things(declaration: Declaration, scope: Scope, findings: Findings) -> tuple[model.Part[Any], ...]:
    found: dict[str, model.Part[Any]] = {}
    for fact in _facts(declaration, Contains):
        name = fact.name.text
        kind = make("content", fact.phrase, scope, findings)
        if name in found:
            first = Label(found[name].span, "first said here")
            message = f"The task already contains something called {name}."
            findings.error("duplicate-thing", fact.name.span, message, "Give one of the two another name.", first)
        found.setdefault(name, model.Part(name, kind, fact.name.span))
    return tuple(found.values())


def _ticks(declaration: Declaration, tick: float, findings: Findings) -> int:
    lasts = list(_facts(declaration, Lasts))
    name = declaration.header.name
    if not lasts and declaration.whole:
        findings.error(
            "endless-task", name.span, f"{name.text} does not say how long it lasts.", "Add lasts 10000 ticks."
        )
    if not lasts:
        return 1
    for again in lasts[1:]:
        first = Label(lasts[0].span, "first said here")
        findings.error("repeated-fact", again.span, "The task already says how long it lasts.", "Leave one out.", first)
    amount = lasts[0].amount
    if amount.unit == "s":
        seconds = convert(amount, SECONDS, findings)
        return max(1, round(seconds / tick)) if seconds else 1
    return int(convert(amount, LASTS, findings) or 1)


def _possible(
    event: Event,
    written: Phrase,
    scene: Any,
    things: tuple[model.Part[Any], ...],
    has_battery: bool,
    findings: Findings,
) -> None:
    """Report an event that can never happen in the task."""
    match event:
        case Visit() if not isinstance(scene, Arena):
            hint = "Patches are of an arena: write in arena size 100."
            findings.error("impossible-event", written.span, "A plain scene has no patches to visit.", hint)
        case Delivery() if not any(isinstance(thing.kind, Zone) for thing in things):
            hint = "Add contains drop_zone is zone size 5."
            findings.error("impossible-event", written.span, "The task has no zone to deliver to.", hint)
        case Exhaustion() if not has_battery:
            hint = "Declare one: sensor battery is battery."
            findings.error("impossible-event", written.span, "Without a battery nothing is exhausted.", hint)


def _reward(fact: Rewards, on: Any, names: Names, visible: Visible, findings: Findings) -> model.Reward:
    each = None
    if fact.each:
        visible = replace(visible, each=fact.each.name.text)
        each = fact.each.sensor.text if names.find(fact.each.sensor, ("sensor", "memory"), findings) else None
    when = _condition(fact.when, visible, findings) if fact.when else None
    return model.Reward(resolve(fact.amount, visible, findings), on, each, when, fact)


def _condition(when: syntax.When, visible: Visible, findings: Findings) -> model.Condition:
    return model.Condition(resolve(when.left, visible, findings), when.compare, resolve(when.right, visible, findings))
