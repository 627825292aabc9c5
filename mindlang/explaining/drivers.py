"""Every driver of a robot.yaml: what its docstring and its options say of it, with what `drivers.md` says more.

How its device is wired is said there, too, in lines such as `trigger -> TRIG`, `5 V -> VCC`.
"""

import re
from collections.abc import Iterator, Mapping
from functools import cache
from inspect import cleandoc

from mindlang.explaining.article import Article, DeviceWiring, Section, Wire, sections, unwrap_paragraphs
from mindlang.explaining.parameters import parameter
from mindlang.robot.options import driver_options, drivers

NOUNS = ("sensor", "actuator")
# The pins of a Raspberry Pi's header: what has a name, and the GPIOs from 0 on, as Broadcom counts them.
NAMED_PINS = {"3.3 V": 1, "5 V": 2, "GND": 6, "SDA": 3, "SCL": 5, "MOSI": 19, "MISO": 21, "SCLK": 23, "CE0": 24}
GPIO_PINS = (
    *(27, 28, 3, 5, 7, 29, 31, 26, 24, 21, 19, 23, 32, 33),
    *(8, 10, 36, 11, 12, 35, 38, 40, 15, 16, 18, 22, 37, 13),
)
HEADER_PINS = 40


@cache
def driver_articles() -> tuple[Article, ...]:
    """All drivers, those for sensors first; some names are there for both."""
    more = {(each.chapter, each.name): each for each in sections("drivers.md")}
    return tuple(_article(noun, name, more.get((noun, name))) for noun in NOUNS for name in sorted(drivers(noun)))


def _article(noun: str, name: str, more: Section | None) -> Article:
    cls = drivers(noun)[name]
    right = more.labelled("yaml") if more else ()
    return Article(
        name,
        "driver",
        f"driver of {noun}s",
        f"For {noun}s",
        more.title if more else "",
        unwrap_paragraphs(cleandoc(cls.__doc__ or "")),
        tuple(parameter(each) for each in driver_options(cls)),
        right=right,
        language="yaml",
        wiring=next(map(parse_wiring, more.labelled("wiring"), right), None) if more else None,
    )


def parse_wiring(lines: str, example: str) -> DeviceWiring:
    """The wiring that these lines say, where options have the pins of an example in YAML."""
    device, *said = lines.strip().splitlines()
    pairs = (line.strip().partition(": ") for line in example.splitlines()[1:])
    options = {key: [int(number) for number in re.findall(r"\d+", value)] for key, _, value in pairs}
    return DeviceWiring(device, tuple(wire for line in said for wire in _wires(line, options)))


def _wires(line: str, options: Mapping[str, list[int]]) -> Iterator[Wire]:
    """A line as wires: one for each pin of an option, of which `#` is the number."""
    source, _, terminal = line.partition(" -> ")
    if source not in options:
        yield Wire(source, NAMED_PINS.get(source), terminal)
    for number, gpio in enumerate(options.get(source, ()), start=1):
        yield Wire(f"GPIO {gpio}, {source}", GPIO_PINS[gpio], terminal.replace("#", str(number)))
