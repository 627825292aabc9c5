"""The claims of a wiring: pins, addresses and channels, each of which belongs to one, and time, which must suffice."""

from collections import defaultdict
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from math import floor, log10

from mindrun.graph.wiring import ActuatorWire, SensorWire
from mindrun.robot.driver_support import ADDRESS, BUS, CHANNEL, CHIP, PIN

from mindlang.compiler.diagnostic import Diagnostic, Findings, Label, listed
from mindlang.compiler.source import Span
from mindlang.robot.driver import Wired
from mindlang.robot.options import DriverOption
from mindlang.robot.read import Items, first_line

OUTPUTS = ("channel", "motor", "port", "ports", "output", "input")  # which of the things on a board
BUS_PINS = {0: (0, 1), 1: (2, 3)}  # of a Raspberry Pi
SPI_PINS, CHIP_PINS = (9, 10, 11), {0: 8, 1: 7}  # of its SPI bus 0, and of its chip selects
ROUNDING_FACTOR = 1 + 1e-9  # what is asked for is written in decimals
WAYS = {"sensor": "measure less often (rate)", "actuator": "let the mind tick more slowly"}
Users = Sequence[tuple[float, Wired]]  # who uses something, and for how much of each second


@dataclass(frozen=True, slots=True)
class Claim:
    """Something that is used (a pin, an address), and where that stands; `sharing` says who may use it as well."""

    what: str
    span: Span
    sharing: object = None


def check_claims(everything: Iterable[Wired], findings: Findings) -> None:
    """Report what is used twice."""
    taken: dict[str, Claim] = {}
    claims = [claim for wired in everything for claim in _claims(wired)]
    for claim in sorted(claims, key=lambda claim: not isinstance(claim.sharing, str)):  # buses are where they are
        first = taken.setdefault(claim.what, claim)
        if first is not claim and (first.sharing is None or first.sharing != claim.sharing):
            label = Label(first.span, f"used here{f', by {first.sharing}' * isinstance(first.sharing, str)}")
            hint = "Write where this one is wired to: each has its own."
            findings.error("used-twice", claim.span, f"{claim.what} is used twice.", hint, label)


def _claims(wired: Wired) -> Iterator[Claim]:
    """A board has one address. Drivers with the same usual one are for the same board, each for other outputs of it.

    Sensors that read different things of one device have in common all of its numbers, and its texts.
    """
    for option in wired.options:
        if option.type == PIN:
            yield from (Claim(f"GPIO {number}", span) for number, span in _numbers(wired, option))
        if option.type == CHIP:
            pins = *SPI_PINS, CHIP_PINS[wired.values[option.field]]
            yield from (Claim(f"GPIO {pin}", wired.span(option.key, "driver"), "SPI bus 0") for pin in pins)
    bus = next((wired.values[option.field] for option in wired.options if option.type == BUS), None)
    selecting = [option for option in wired.options if option.key in OUTPUTS or option.type == CHANNEL]
    used = [wired.values[option.field] is not None for option in selecting]
    if bus is None or (used and not any(used)):  # a camera without servos
        return
    here = wired.span("bus", "driver")
    yield from (Claim(f"GPIO {pin}", here, f"I2C bus {bus}") for pin in BUS_PINS.get(bus, ()))
    is_sensor = wired.noun == "sensor"
    said = (wired.values[option.field] for option in wired.options if option.shape not in ("word", "words"))
    device = (wired.span("driver").text, tuple(said)) if is_sensor else None
    for address in (option for option in wired.options if option.type == ADDRESS):
        board = f"I2C address 0x{wired.values[address.field]:02x} of bus {bus}"
        can_share = selecting or is_sensor
        yield Claim(board, wired.span(address.key, "driver"), ("board", address.default) if can_share else None)
        for option in selecting:
            for number, place in _numbers(wired, option):
                yield Claim(f"Number {number} at {board}", place, device)


def _numbers(wired: Wired, option: DriverOption) -> Iterator[tuple[int, Span]]:
    """The numbers under a key, and where each stands."""
    found, entry = wired.values[option.field], wired.entry(option.key)
    numbers = found if isinstance(found, tuple) else (found,)
    if entry and isinstance(entry.value, Items):
        yield from ((number, node.span) for number, node in zip(numbers, entry.value.items, strict=True))
    else:
        place = first_line(entry.value.span) if entry else wired.span("driver")
        yield from ((number, place) for number in numbers if number is not None)


def check_speed(wired: Wired, wire: SensorWire, findings: Findings) -> None:
    """Warn of a sensor that is to be measured more often than it can be, or to measure more than it can."""
    seconds, most = wired.timing.seconds, wired.timing.most
    if wire.rate * seconds > ROUNDING_FACTOR:
        message = f"One measurement takes {1000 * seconds:.3g} ms here, and {wire.rate:g} a second are asked for."
        hint = f"Write rate: {_below(1 / seconds):g} Hz, or less, and a max_age of two measurements at least."
        warn(findings, "too-often", wired.span("rate", "driver"), message, hint)
    asked, unit = max(abs(wire.low), abs(wire.high)), wired.driver.unit
    if asked > most * ROUNDING_FACTOR:
        limit = f"{_below(most):g} {unit}"
        message = f"It is to read up to {asked:g} {unit}, and measures {limit} at most: faster reads as slower."
        hint = f"Write from: -{limit} and to: {limit}, and never go faster; or wire one with fewer steps."
        warn(findings, "too-fast", wired.span("to", "from", "steps"), message, hint)


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
    warn(findings, code, busiest.span("bus", "driver"), message, f"{hint[0].upper()}{hint[1:]}.")


def _below(number: float) -> float:
    """A number rounded down to three digits, for a hint: no more than it."""
    if number == 0:
        return 0.0
    unit = 10.0 ** (floor(log10(number)) - 2)
    return floor(number / unit * ROUNDING_FACTOR) * unit


def warn(findings: Findings, code: str, span: Span, message: str, hint: str, *labels: Label) -> None:
    """Collect a warning: the wiring is taken as it is."""
    findings.diagnostics.append(Diagnostic(code, message, span, hint, labels, "warning"))
