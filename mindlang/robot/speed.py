"""Whether what is wired can be as fast as it is asked to be: what drivers say of themselves, beside what wires say."""

from collections import defaultdict
from collections.abc import Sequence
from math import floor, log10

from mindrun.graph.wiring import ActuatorWire, SensorWire

from mindlang.compiler.diagnostic import Findings, listed
from mindlang.robot.driver import Wired
from mindlang.robot.nodes import report_warning

ROUNDING_FACTOR = 1 + 1e-9  # what is asked for is written in decimals
WAYS = {"sensor": "measure less often (rate)", "actuator": "let the mind tick more slowly"}
Users = Sequence[tuple[float, Wired]]  # who uses something, and for how much of each second


def check_speed(wired: Wired, wire: SensorWire, findings: Findings) -> None:
    """Warn of a sensor that is to be measured more often than it can be, or to measure more than it can."""
    seconds, most = wired.timing.seconds, wired.timing.most
    if wire.rate * seconds > ROUNDING_FACTOR:
        message = f"One measurement takes {1000 * seconds:.3g} ms here, and {wire.rate:g} a second are asked for."
        hint = f"Write rate: {_below(1 / seconds):g} Hz, or less, and a max_age of two measurements at least."
        report_warning(findings, "too-often", wired.span("rate", "driver"), message, hint)
    asked, unit = max(abs(wire.low), abs(wire.high)), wired.driver.unit
    if asked > most * ROUNDING_FACTOR:
        limit = f"{_below(most):g} {unit}"
        message = f"It is to read up to {asked:g} {unit}, and measures {limit} at most: faster reads as slower."
        hint = f"Write from: -{limit} and to: {limit}, and never go faster; or wire one with fewer steps."
        report_warning(findings, "too-fast", wired.span("to", "from", "steps"), message, hint)


def check_shared(
    sensors: Sequence[tuple[Wired, SensorWire | None]],
    actuators: Sequence[tuple[Wired, ActuatorWire | None]],
    tick: float,
    findings: Findings,
) -> None:
    """Warn of a bus, or of a board that does one thing at a time, with more to do in a second than fits into it."""
    rates = [(wired, wire.rate) for wired, wire in sensors if wire] + [(wired, 1 / tick) for wired, _ in actuators]
    boards: dict[str, list[tuple[float, Wired]]] = defaultdict(list)
    buses: dict[int, list[tuple[float, Wired]]] = defaultdict(list)
    for wired, rate in rates:
        timing = wired.timing
        if timing.queue or wired.noun == "actuator":  # a sensor that waits for no other is told of by `check_speed`
            boards[timing.queue or f" {wired.name.text}"].append((rate * timing.seconds, wired))
        if timing.bus_seconds:
            buses[timing.bus].append((rate * timing.bus_seconds, wired))
    for queue, users in boards.items():
        if len(users) > 1 or users[0][1].noun == "actuator":
            of = "" if queue.startswith(" ") else f" of {queue}, which does one thing at a time"
            _check_share("too-often", of, "board", users, findings)
    for bus, users in buses.items():
        _check_share("busy-bus", f" of I2C bus {bus} at its usual 100 kHz", "bus", users, findings)


def _check_share(code: str, of: str, what: str, users: Users, findings: Findings) -> None:
    """Warn of what these need for more than a second of each second, at the one that needs most of it."""
    total, (_, busiest) = sum(needed for needed, _ in users), max(users, key=lambda user: user[0])
    if total <= ROUNDING_FACTOR:
        return
    names = listed([wired.name.text for _, wired in users], "and")
    message = f"In each second {names} need{'s' * (len(users) == 1)} {total:.3g} s{of}."
    nouns = {wired.noun for _, wired in users}
    ways = [way for noun, way in WAYS.items() if noun in nouns]
    hint = listed([*ways, f"wire {'some to ' * (len(users) > 1)}another {what}"])
    report_warning(findings, code, busiest.span("bus", "driver"), message, f"{hint[0].upper()}{hint[1:]}.")


def _below(number: float) -> float:
    """A number rounded down to three digits, for a hint: no more than it."""
    if number == 0:
        return 0.0
    unit = 10.0 ** (floor(log10(number)) - 2)
    return floor(number / unit * ROUNDING_FACTOR) * unit
