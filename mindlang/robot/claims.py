"""Which pins, addresses and channels a wiring uses; each belongs to one sensor or actuator."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from mindrun.robot.driver_support import ADDRESS, BUS, CHANNEL, CHIP, PIN

from mindlang.compiler.diagnostic import Findings, Label
from mindlang.compiler.source import Span
from mindlang.robot.driver import Wired
from mindlang.robot.nodes import Items, report_error
from mindlang.robot.options import DriverOption
from mindlang.robot.values import first_line

OUTPUTS = ("channel", "motor", "port", "ports", "output", "input")  # which of the things on a board
BUS_PINS = {0: (0, 1), 1: (2, 3)}  # of a Raspberry Pi
SPI_PINS, CHIP_PINS = (9, 10, 11), {0: 8, 1: 7}  # of its SPI bus 0, and of its chip selects


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
            report_error(findings, "used-twice", claim.span, f"{claim.what} is used twice.", hint, label)


def _claims(wired: Wired) -> Iterator[Claim]:
    for option in wired.options:
        if option.type == PIN:
            yield from (Claim(f"GPIO {number}", span) for number, span in _numbers(wired, option))
        if option.type == CHIP:
            pins = *SPI_PINS, CHIP_PINS[wired.values[option.field]]
            yield from (Claim(f"GPIO {pin}", wired.span(option.key, "driver"), "SPI bus 0") for pin in pins)
    bus = next((wired.values[option.field] for option in wired.options if option.type == BUS), None)
    used = [wired.values[option.field] is not None for option in _outputs(wired)]
    if bus is None or (used and not any(used)):  # a camera without servos
        return
    here = wired.span("bus", "driver")
    yield from (Claim(f"GPIO {pin}", here, f"I2C bus {bus}") for pin in BUS_PINS.get(bus, ()))
    for option in wired.options:
        if option.type == ADDRESS:
            yield from _on_board(wired, f"I2C address 0x{wired.values[option.field]:02x} of bus {bus}", option)


def _on_board(wired: Wired, board: str, address: DriverOption) -> Iterator[Claim]:
    """A board has one address. Drivers with the same usual one are for the same board, each for other outputs of it."""
    selecting = _outputs(wired)
    can_share = selecting or wired.noun == "sensor"
    yield Claim(board, wired.span(address.key, "driver"), ("board", address.default) if can_share else None)
    for option in selecting:
        for number, place in _numbers(wired, option):
            yield Claim(f"Number {number} at {board}", place, _one_device(wired))


def _outputs(wired: Wired) -> list[DriverOption]:
    """The options that say which of the things on a board."""
    return [option for option in wired.options if option.key in OUTPUTS or option.type == CHANNEL]


def _one_device(wired: Wired) -> object:
    """What sensors that read different things of one device have in common: all of its numbers, and its texts."""
    if wired.noun != "sensor":
        return None
    options = [option for option in wired.options if option.shape not in ("word", "words")]
    return wired.span("driver").text, tuple(wired.values[option.field] for option in options)


def _numbers(wired: Wired, option: DriverOption) -> Iterator[tuple[int, Span]]:
    """The numbers under a key, and where each stands."""
    found, entry = wired.values[option.field], wired.entry(option.key)
    numbers = found if isinstance(found, tuple) else (found,)
    if entry and isinstance(entry.value, Items):
        yield from ((number, node.span) for number, node in zip(numbers, entry.value.items, strict=True))
    else:
        place = first_line(entry.value.span) if entry else wired.span("driver")
        yield from ((number, place) for number in numbers if number is not None)
