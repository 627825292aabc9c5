"""How much time a driver needs, as it says itself: one of mindrun as one of the user's own."""

from collections.abc import Mapping
from dataclasses import dataclass
from inspect import getattr_static
from math import inf, isfinite
from typing import Any

from mindrun.numbers.given_numbers import is_truth, number
from mindrun.numbers.quantity import fits
from mindrun.robot.driver_support import BUS

ABSENT = object()


class UnfitTimingError(Exception):
    """What a driver says of its time cannot be; the sentence goes on after its name."""


@dataclass(frozen=True, slots=True)
class Timing:
    """What a driver can do, in the words of `SensorDriver`; `queue` is empty where nothing has to wait for another."""

    seconds: float = 0.0
    bus_seconds: float = 0.0
    most: float = inf
    bus: int = -1
    queue: str = ""


def timing_of(driver: object, noun: str) -> Timing:
    """What a driver says of its time; UnfitTimingError where that cannot be."""
    names = Timing.__dataclass_fields__.keys() | {"device"}
    said = {name: getattr(driver, name) for name in names if getattr_static(driver, name, ABSENT) is not ABSENT}
    queue = said.get("queue", said.get("device", "") if noun == "actuator" else "")
    if not isinstance(queue, str) or not queue.isprintable():
        raise UnfitTimingError("has a queue that is no text")
    seconds, bus_seconds = (_amount(said, name) for name in ("seconds", "bus_seconds"))
    bus = said.get("bus") if bus_seconds else -1
    if not isinstance(bus, int) or is_truth(bus) or (bus_seconds and not fits(BUS, bus)):
        raise UnfitTimingError(f"has bus_seconds, and no bus that is a whole number from {BUS.low:g} to {BUS.high:g}")
    return Timing(seconds, bus_seconds, _amount(said, "most", inf), bus, queue)


def _amount(said: Mapping[str, Any], name: str, unsaid: float = 0.0) -> float:
    """A number from 0, which is finite or what it is where nothing is said."""
    given = said.get(name, unsaid)
    try:
        found = number(given)
    except Exception:  # whatever the code of a user's number raises
        found = -1.0
    if is_truth(given) or not (found == unsaid or (isfinite(found) and found >= 0)):
        raise UnfitTimingError(f"has {name} that {'is' if name == 'most' else 'are'} no number from 0: {given!r:.60}")
    return found
