"""Whether what is wired can be as fast as it is asked to be: what drivers say of themselves, beside what wires say."""

from collections.abc import Sequence
from math import floor, inf, log10

from mindrun.wiring import ActuatorWire, SensorWire

from mindlang.compiler.diagnostic import Findings, listed
from mindlang.wiring.driver import Wired
from mindlang.wiring.nodes import report_warning

ROUNDING_FACTOR = 1 + 1e-9  # what is asked for is written in decimals


def check_speed(wired: Wired, wire: SensorWire, findings: Findings) -> None:
    """Warn of a sensor that is to be measured more often than it can be, or to measure more than it can."""
    seconds, most = _seconds(wire.driver), getattr(wire.driver, "most", inf)
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
    """Warn of a bus or a board that has more to do in a tick than fits into it."""
    boards: dict[str, list[Wired]] = {}
    for wired, _ in actuators:
        boards.setdefault(wired.driver.device or wired.name.text, []).append(wired)
    for on_board in boards.values():
        needed = sum(_seconds(wired.driver) for wired in on_board)
        if needed > tick * ROUNDING_FACTOR:
            names = listed([wired.name.text for wired in on_board], "and")
            message = f"Commands of {names} take {1000 * needed:.3g} ms, and a tick is {1000 * tick:.3g} ms."
            hint = "Let the mind tick more slowly, or wire another board."
            report_warning(findings, "too-often", on_board[0].span("driver"), message, hint)
    shares = [(wired, wire.rate) for wired, wire in sensors if wire] + [(wired, 1 / tick) for wired, _ in actuators]
    buses: dict[int, list[tuple[float, Wired]]] = {}
    for wired, rate in shares:
        if needed := rate * getattr(wired.driver, "bus_seconds", 0.0):
            buses.setdefault(wired.driver.bus, []).append((needed, wired))
    for number, users in buses.items():
        total, (_, busiest) = sum(needed for needed, _ in users), max(users, key=lambda user: user[0])
        if total > ROUNDING_FACTOR:
            message = f"In each second I2C bus {number} needs {total:.3g} s at its usual 100 kHz, most for this one."
            hint = "Measure less often (rate), let the mind tick more slowly, or wire some to another bus."
            report_warning(findings, "busy-bus", busiest.span("bus", "driver"), message, hint)


def _seconds(driver: object) -> float:
    """How long one measurement or command takes."""
    seconds: float = getattr(driver, "seconds", 0.0)
    return seconds


def _below(number: float) -> float:
    """A number rounded down to three digits, for a hint: no more than it."""
    if number == 0:
        return 0.0
    unit = 10.0 ** (floor(log10(number)) - 2)
    return floor(number / unit * ROUNDING_FACTOR) * unit
