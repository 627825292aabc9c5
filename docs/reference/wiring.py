"""How a device is wired: the header of a Raspberry Pi, the terminals of the device, and the wires between them."""

from collections.abc import Iterator, Sequence
from itertools import cycle

from docs.reference import svg
from mindlang.explaining.article import DeviceWiring, Wire
from mindlang.explaining.collection import HEADER_PINS

WIDTH_PIXELS, TOP_PIXELS, ROW_PIXELS = 640, 46, 14
ODD_X, EVEN_X = 60, 74  # the two columns of the header
TERMINAL_X, TERMINAL_ROW = 230, 22
SOURCE_CHARACTER = 6  # pixels, of the longest source, which stands before the terminals
SUPPLIES = {"GND": svg.INK, "5 V": svg.RED, "3.3 V": svg.RED}
COLOURS = (svg.BLUE, svg.GREEN, svg.ORANGE, svg.PURPLE)


def wiring_picture(wiring: DeviceWiring) -> str:
    """A device beside the header, each wire in its colour."""
    wires = sorted(wiring.wires, key=lambda each: each.pin or HEADER_PINS + 1)
    height = TOP_PIXELS + ROW_PIXELS * HEADER_PINS / 2 + 14
    shapes = [*_header(wires), *_device(wiring.device, wires, height), *_wires(wires, height)]
    return svg.document(WIDTH_PIXELS, height, shapes, f"How to wire the {wiring.device}")


def _header(wires: Sequence[Wire]) -> Iterator[str]:
    used = {wire.pin for wire in wires}
    height = ROW_PIXELS * HEADER_PINS / 2 + 6
    yield svg.words(((ODD_X + EVEN_X) / 2, TOP_PIXELS - 26), "Raspberry Pi", "middle", bold=True)
    yield svg.words(((ODD_X + EVEN_X) / 2, TOP_PIXELS - 11), "header, seen from above", "middle", svg.FAINT, 10)
    yield svg.rectangle(ODD_X - 11, TOP_PIXELS - 4, EVEN_X - ODD_X + 22, height, svg.PANEL, svg.FAINT)
    for pin in range(1, HEADER_PINS + 1):
        if pin not in used:
            yield svg.circle(_place(pin), 3.5, svg.PAPER, svg.FAINT, 1)


def _device(name: str, wires: Sequence[Wire], height: float) -> Iterator[str]:
    top = _terminal(0, len(wires), height)[1] - 18
    yield svg.words((TERMINAL_X, top - 8), name, bold=True)
    yield svg.rectangle(
        TERMINAL_X, top, WIDTH_PIXELS - TERMINAL_X - 14, TERMINAL_ROW * len(wires) + 12, svg.PANEL, svg.FAINT
    )


def _wires(wires: Sequence[Wire], height: float) -> Iterator[str]:
    signals = cycle(COLOURS)
    column = TERMINAL_X + 26 + SOURCE_CHARACTER * max(len(wire.source) for wire in wires)
    for number, wire in enumerate(wires):
        colour = SUPPLIES.get(wire.source) or next(signals)
        x, y = end = _terminal(number, len(wires), height)
        if wire.pin:
            yield from _wire(wire.pin, end, colour)
        yield svg.circle(end, 4, colour if wire.pin else svg.PAPER, colour, 1.5)
        yield svg.words((x + 12, y + 4), wire.source, colour=svg.FAINT, size=11)
        yield svg.words((column, y + 4), wire.terminal, size=11)


def _wire(pin: int, end: svg.Point, colour: str) -> Iterator[str]:
    """From a pin out of the header, those of the left column between two rows, and over to the device."""
    x, y = _place(pin)
    is_odd = pin % 2 == 1
    out = (EVEN_X + 16, y + ROW_PIXELS / 2 * is_odd)
    yield svg.path([(x, y), (x + ROW_PIXELS / 2, out[1]), out] if is_odd else [(x, y), out], colour, 2)
    yield svg.bow(out, end, colour)
    yield svg.circle((x, y), 4.5, colour, svg.PAPER, 1)
    number = (ODD_X - 15, y + 3.5) if is_odd else (EVEN_X + 13, y - 3)
    yield svg.words(number, str(pin), "end" if is_odd else "start", size=9)


def _place(pin: int) -> svg.Point:
    """Where a pin of the header is: odd ones left, even ones right."""
    return (ODD_X if pin % 2 else EVEN_X), TOP_PIXELS + 6 + ROW_PIXELS * ((pin - 1) // 2)


def _terminal(number: int, of: int, height: float) -> svg.Point:
    """Where a terminal is: all of them below one another, beside the middle of the header."""
    return TERMINAL_X, height / 2 + TERMINAL_ROW * (number - (of - 1) / 2) + 8
