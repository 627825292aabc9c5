"""Every driver is explained with all of its options, and its example is a wire that mindc build takes."""

import re
from pathlib import Path

import pytest
from mindrun.robot.driver_support import PIN

from docs.reference.pages import reference
from mindlang.compiler.diagnostic import Findings
from mindlang.compiler.source import Source
from mindlang.explaining.article import Article, article_card, sections
from mindlang.explaining.collection import DRIVER_NOUNS, GPIO_PINS, HEADER_PINS, NAMED_PINS, driver_articles
from mindlang.explaining.terminal import LINE_COLUMNS, article_text
from mindlang.robot.driver import wired
from mindlang.robot.options import driver_options, drivers
from mindlang.robot.read import Table, read

every_driver = pytest.mark.parametrize("article", driver_articles(), ids=lambda each: f"{each.sort}-{each.name}")


def noun_of(article: Article) -> str:
    """Of what a driver is."""
    return next(noun for noun in DRIVER_NOUNS if article.chapter == f"For {noun}s")


def printed(article: Article) -> str:
    """An article as a terminal has it."""
    return "".join(text for text, _ in article_text(article))


def test_every_driver_has_an_article_and_nothing_else_has() -> None:
    known = [(noun, name) for noun in DRIVER_NOUNS for name in sorted(drivers(noun))]
    assert [(noun_of(each), each.name) for each in driver_articles()] == known
    assert sorted((each.chapter, each.name) for each in sections("drivers.md")) == sorted(known)


@every_driver
def test_a_driver_says_what_it_is(article: Article) -> None:
    assert article.summary.endswith(".")
    assert article.text
    assert max(map(len, printed(article).splitlines())) <= LINE_COLUMNS


@every_driver
def test_every_door_has_each_option(article: Article) -> None:
    for option in driver_options(drivers(noun_of(article))[article.name]):
        assert f"  {option.key} " in printed(article)
        assert f"- `{option.key}` " in article_card(article)
        assert f"| `{option.key}` |" in reference("Drivers", "", [article])


@every_driver
def test_an_example_is_a_wire(article: Article) -> None:
    assert article.right
    findings = Findings()
    for text in article.right:
        table = read(Source("robot.yaml", text, Path()), findings)
        assert isinstance(table, Table), [each.message for each in findings.diagnostics]
        (entry,) = table.entries.values()
        assert isinstance(entry.value, Table)
        found = wired(noun_of(article), entry.key, entry.value, findings)
        assert [each.message for each in findings.diagnostics] == []
        assert found is not None
        assert isinstance(found.driver, drivers(noun_of(article))[article.name])


@every_driver
def test_a_wiring_has_every_pin_of_the_example_once(article: Article) -> None:
    options = driver_options(drivers(noun_of(article))[article.name])
    keys = [option.key for option in options if option.type is PIN]
    wires = article.wiring.wires if article.wiring else ()
    wired_keys = {wire.source.partition(", ")[2] for wire in wires}
    assert wired_keys - {""} == set(keys)
    pins = [wire.pin for wire in wires if wire.pin]
    assert len(set(pins)) == len(pins)
    assert not keys or "GND" in {wire.source for wire in wires}


def test_the_pins_of_the_header_are_those_of_a_raspberry_pi() -> None:
    """GPIO 2 and 3 are the I2C bus, 9 to 11 and 8 the SPI; no GPIO is on a pin for power or ground."""
    assert (GPIO_PINS[2], GPIO_PINS[3]) == (NAMED_PINS["SDA"], NAMED_PINS["SCL"])
    spi = [NAMED_PINS[name] for name in ("MOSI", "MISO", "SCLK", "CE0")]
    assert [GPIO_PINS[gpio] for gpio in (10, 9, 11, 8)] == spi
    supplies = {1, 17, 2, 4, 6, 9, 14, 20, 25, 30, 34, 39}
    assert sorted([*GPIO_PINS, *supplies]) == list(range(1, HEADER_PINS + 1))


@every_driver
def test_a_driver_speaks_of_options_that_there_are(article: Article) -> None:
    """`low` and `high` are called `from` and `to` in a robot.yaml."""
    assert not {"low", "high"} & set(re.findall(r"`(\w+)`", article_card(article)))
