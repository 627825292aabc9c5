"""Collects all articles, those on codes of diagnostics too, and finds the articles of a name."""

from collections.abc import Iterable, Iterator, Sequence
from functools import cache
from pathlib import Path

from mindlang.compiler.diagnostic import ERRORS, did_you_mean, listed
from mindlang.explaining.article import Article, sections
from mindlang.explaining.drivers import driver_articles
from mindlang.explaining.kinds import kind_articles
from mindlang.explaining.words import word_articles

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
    said = *error_articles(), *_of_codes("rules.md", RULE), *_of_codes("findings.md", FINDING)
    return {each.name: each for each in said}


def error_articles() -> Iterator[Article]:
    """The errors."""
    return _of_codes(ERRORS, ERROR)


def _of_codes(texts: str | Path, sort: str) -> Iterator[Article]:
    for each in sections(texts):
        wrong, right = each.labelled("mind bad"), each.labelled("mind good")
        yield Article(each.name, sort, sort, each.chapter, each.title, each.text, wrong=wrong, right=right)
