"""Whether a task's runs are decided before they begin: by where the robot starts, or by an empty battery."""

from collections.abc import Iterable

from mindrun.kinds.events.event import EventKind
from mindrun.kinds.sensors.sensor import SensorKind

from mindlang.compiler.beginning import Beginning
from mindlang.compiler.diagnostic import Findings, Label
from mindlang.compiler.model import End


def happens_at_once(event: EventKind, begun: Beginning, sensors: Iterable[SensorKind]) -> int:
    """How often an event happens in the first tick of every run, whatever the robot does."""
    if event.is_of_battery:
        batteries = [kind.battery for kind in sensors if kind.battery]
        charging = any(begun.reached(thing.name) for thing in begun.things if thing.kind and thing.kind.charges)
        return int(any(battery.start == 0 for battery in batteries) and not charging)
    match event.outcome:
        case "reached":
            return begun.reached(event.thing)
        case "delivered":
            return begun.delivered(event.thing, getattr(event, "to", ""))
    return 0


def check_decided(ends: Iterable[End], begun: Beginning, sensors: Iterable[SensorKind], findings: Findings) -> None:
    """Report an event that ends every run in its first tick."""
    kinds = [*sensors]
    for end in ends:
        if end.event is None or happens_at_once(end.event, begun, kinds) < end.times:
            continue
        there = (Label(each.span, "this one") for each in begun.things if each.name == end.event.thing)
        message = "This ends every run in its first tick."
        findings.error("decided-start", end.fact.span, message, hint_apart(end.event), *there)


def hint_apart(event: EventKind) -> str:
    """What to do about an event that comes in the first tick."""
    if event.is_of_battery:
        return "Let the battery start above 0."
    if event.outcome == "delivered":
        return f"Write another place for {event.thing}, outside of where it is to come."
    return f"Write another place for {event.thing} or the robot."
