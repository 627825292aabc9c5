"""Every driver of a robot.yaml: what its docstring and its options say of it, with what `drivers.md` says more."""

from functools import cache
from inspect import cleandoc

from mindlang.explaining.article import Article
from mindlang.explaining.parameters import parameter
from mindlang.explaining.sections import Section, in_lines, sections
from mindlang.explaining.wiring import wiring_of
from mindlang.robot.options import driver_options, drivers

NOUNS = ("sensor", "actuator")


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
        in_lines(cleandoc(cls.__doc__ or "")),
        tuple(parameter(each) for each in driver_options(cls)),
        right=right,
        language="yaml",
        wiring=next(map(wiring_of, more.labelled("wiring"), right), None) if more else None,
    )
