"""Collects all articles, those on drivers and on codes of diagnostics too, and finds the articles of a name.

What a driver of a robot.yaml is, its docstring and its options say, and more `drivers.md`. How its device is wired is
said there, too, in lines such as `trigger -> TRIG`, `5 V -> VCC`.
"""

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import cache
from inspect import cleandoc
from pathlib import Path

from mindlang.compiler.diagnostic import ERRORS, did_you_mean, listed
from mindlang.explaining.article import (
    NO_SECTION,
    Article,
    DeviceWiring,
    Wire,
    named_sections,
    sections,
    unwrap_paragraphs,
)
from mindlang.explaining.kinds import kind_articles, parameter, word_articles
from mindlang.robot.options import driver_options, drivers

ERROR, RULE, FINDING = "error", "lint rule", "finding"  # sorts of codes
# Nouns of kinds that people say as well.
ALSO_CALLED = {"task": "scene", "content": "thing", "function": "skill", "mindc": "command"}
NAMED_OWNERS = 4  # of an argument, so many of whose kinds are named


@cache
def articles() -> tuple[Article, ...]:
    """The articles on words, kinds and drivers, then those on codes."""
    return (*word_articles().values(), *kind_articles(), *driver_articles(), *codes().values())


def find_articles(asked: str, among: Sequence[Article]) -> list[Article]:
    """The articles of a name, or of a name behind its noun: `light`, `sensor light`."""
    of_name = [each for each in among if each.name == asked]
    noun, _, name = asked.partition(" ")
    return of_name or [each for each in among if (each.noun, each.name) == (ALSO_CALLED.get(noun, noun), name)]


def unknown_hint(asked: str, among: Iterable[Article]) -> str:
    """The hint for a name without an article."""
    known = list(among)
    owners = [each for each in known if any(parameter.key == asked for parameter in each.parameters)]
    if owners:
        some = [f"{each.noun} {each.name}" for each in owners[:NAMED_OWNERS]]
        some += [f"{len(owners) - len(some)} more"] if len(owners) > len(some) else []
        return f"It is an argument of {listed(some, 'and')}: mindc explain {owners[0].name} says what it takes."
    near = did_you_mean(asked, [*(each.name for each in known), *(f"{each.noun} {each.name}" for each in known)])
    return near or "mindc kinds lists the kinds and drivers, mindc explain the codes."


@cache
def codes() -> dict[str, Article]:
    """All codes: errors in the order of their chapters, then the lint rules, then what an audit finds."""
    said = (ERRORS, ERROR), ("rules.md", RULE), ("findings.md", FINDING)
    return {each.name: each for texts, sort in said for each in _of_codes(texts, sort)}


def _of_codes(texts: str | Path, sort: str) -> Iterator[Article]:
    for each in sections(texts):
        wrong, right = each.labelled("mind bad"), each.labelled("mind good")
        yield Article(each.name, sort, sort, each.chapter, each.title, each.text, wrong=wrong, right=right)


DRIVER_NOUNS = ("sensor", "actuator")
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
    return tuple(_article(noun, name) for noun in DRIVER_NOUNS for name in sorted(drivers(noun)))


def _article(noun: str, name: str) -> Article:
    cls, more = drivers(noun)[name], named_sections("drivers.md").get((noun, name), NO_SECTION)
    right = more.labelled("yaml")
    return Article(
        name,
        "driver",
        f"driver of {noun}s",
        f"For {noun}s",
        more.title,
        unwrap_paragraphs(cleandoc(cls.__doc__ or "")),
        tuple(parameter(each) for each in driver_options(cls)),
        right=right,
        language="yaml",
        wiring=next(map(parse_wiring, more.labelled("wiring"), right), None),
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
