"""How a driver's device is wired, from the lines that `drivers.md` has of it: `trigger -> TRIG`, `5 V -> VCC`."""

import re
from collections.abc import Iterator, Mapping

from mindlang.explaining.article import Wire, Wiring

# The pins of a Raspberry Pi's header: what has a name, and the GPIOs as Broadcom counts them.
NAMED_PINS = {
    "3.3 V": 1,
    "5 V": 2,
    "GND": 6,
    "SDA": 3,
    "SCL": 5,
    "MOSI": 19,
    "MISO": 21,
    "SCLK": 23,
    "CE0": 24,
}
GPIO_PINS = {
    0: 27,
    1: 28,
    2: 3,
    3: 5,
    4: 7,
    5: 29,
    6: 31,
    7: 26,
    8: 24,
    9: 21,
    10: 19,
    11: 23,
    12: 32,
    13: 33,
    14: 8,
    15: 10,
    16: 36,
    17: 11,
    18: 12,
    19: 35,
    20: 38,
    21: 40,
    22: 15,
    23: 16,
    24: 18,
    25: 22,
    26: 37,
    27: 13,
}
HEADER_PINS = 40


def wiring_of(lines: str, example: str) -> Wiring:
    """The wiring that these lines say, where options have the pins of an example in YAML."""
    device, *said = lines.strip().splitlines()
    options = {key: [int(number) for number in re.findall(r"\d+", value)] for key, value in _options(example)}
    return Wiring(device, tuple(wire for line in said for wire in _wires(line, options)))


def _options(example: str) -> Iterator[tuple[str, str]]:
    for line in example.splitlines()[1:]:
        key, _, value = line.strip().partition(": ")
        yield key, value


def _wires(line: str, options: Mapping[str, list[int]]) -> Iterator[Wire]:
    """A line as wires: one for each pin of an option, of which `#` is the number."""
    source, _, terminal = line.partition(" -> ")
    if source not in options:
        yield Wire(source, NAMED_PINS.get(source), terminal)
    for number, gpio in enumerate(options.get(source, ()), start=1):
        yield Wire(f"GPIO {gpio}, {source}", GPIO_PINS[gpio], terminal.replace("#", str(number)))
