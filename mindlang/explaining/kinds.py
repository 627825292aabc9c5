"""Every kind of the language: what its docstring and its fields say of it, with what `kinds.md` says more.

The words of the language are in `words.md`: what each is for.
"""

from collections.abc import Iterator
from dataclasses import fields, is_dataclass
from functools import cache
from inspect import cleandoc
from typing import Any

import mindrun.graph.graph  # noqa: F401  (it knows all kinds)
from mindrun.kinds.registry import arguments, kinds, names

from mindlang.explaining.article import NO_SECTION, Article, Section, named_sections, sections, unwrap_paragraphs
from mindlang.explaining.parameters import parameter

# The nouns of kinds as people say them, in the order in which a mind is written: in the registry, and as a chapter.
_SAID = {
    "body": ("body", "Bodies"),
    "actuator": ("actuator", "Actuators"),
    "sensor": ("sensor", "Sensors"),
    "memory": ("memory", "Memories"),
    "skill": ("skill", "Skills"),
    "scene": ("task", "Worlds"),
    "thing": ("content", "Things"),
    "event": ("event", "Events"),
    "measure": ("measure", "Measures"),
    "curriculum": ("curriculum", "Curricula"),
}
NOUNS = {noun: of for noun, (of, _) in _SAID.items()}
SAID_AS = {of: noun for noun, of in NOUNS.items()} | {"scene": "scene"}


@cache
def kind_articles() -> tuple[Article, ...]:
    """All kinds, by noun and name."""
    return tuple(kind_article(of, name) for of in NOUNS.values() for name in sorted(kinds(of)))


@cache
def kind_article(of: str, name: str) -> Article:
    """The kind of a noun of the registry with that name."""
    cls, noun = kinds(of)[name], SAID_AS[of]
    more = named_sections("kinds.md").get((noun, name), NO_SECTION)
    return Article(
        name,
        noun,
        f"kind of {noun}",
        _SAID[noun][1],
        more.title,
        "\n\n".join(filter(None, _texts(cls))),
        tuple(parameter(each, _purpose(noun, name, each.key)) for each in arguments(cls)),
        more.scale,
        right=more.labelled("mind"),
    )


def _purpose(noun: str, name: str, key: str) -> str:
    """The purpose of an argument in `arguments.md`: of the kind, else of its noun, else of every kind."""
    known, chapters = named_sections("arguments.md"), (f"{noun} {name}", noun, "every kind")
    return next((known[chapter, key].title for chapter in chapters if (chapter, key) in known), "")


def _texts(cls: type[Any]) -> Iterator[str]:
    """The docstring of a kind; then, without titles, those of a kind that it varies and of bases with its arguments."""
    yield unwrap_paragraphs(cleandoc(cls.__doc__ or ""))
    for each in cls.__mro__[1:]:
        if is_dataclass(each) and (each in names() or all(field.kw_only for field in fields(each))):
            yield unwrap_paragraphs(cleandoc(each.__doc__ or "")).partition("\n\n")[2]


SORTS = {"Nouns": "noun", "Settings": "setting", "Verbs": "verb", "Words": "word", "Units": "unit", "Terms": "term"}


@cache
def word_articles() -> dict[str, Article]:
    """All words by themselves, in the order of their chapters."""
    return {each.name: _article(each) for each in sections("words.md")}


@cache
def language_words() -> dict[str, Article]:
    """The words that stand in a mind: all but the terms."""
    return {name: each for name, each in word_articles().items() if each.noun != "term"}


def words_of(chapter: str) -> tuple[str, ...]:
    """The words of a chapter: Nouns, Settings, Verbs, Words, Units."""
    return tuple(name for name, each in word_articles().items() if each.chapter == chapter)


def _article(section: Section) -> Article:
    sort = SORTS[section.chapter]
    text = "\n\n".join(filter(None, (section.text, _kinds(section.name))))
    return Article(section.name, sort, sort, section.chapter, section.title, text, right=section.labelled("mind"))


def _kinds(noun: str) -> str:
    """A sentence that lists the kinds of a noun; empty for other words."""
    if noun not in NOUNS:
        return ""
    its = [each.name for each in kind_articles() if each.noun == noun]
    return f"Its kinds: {', '.join(its)}. `mindc kinds {noun}` says what they are." if its else ""
