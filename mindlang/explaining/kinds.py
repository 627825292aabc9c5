"""Every kind of the language: what its docstring and its fields say of it, with what `kinds.md` says more.

What an argument takes is said in words, of an option of a driver, too. What a word is for stands in `words.md`.
"""

from collections.abc import Iterator
from dataclasses import fields, is_dataclass
from functools import cache
from inspect import cleandoc
from typing import Any

import mindrun.graph.graph  # noqa: F401  (it knows all kinds)
from mindrun.kinds.registry import Argument, arguments, brought_by, kinds, names
from mindrun.numbers.quantity import FARTHEST_UNITS, UNSAID, Quantity, Reference, Span
from mindrun.robot.driver_support import ADDRESS

from mindlang.compiler.diagnostic import a, listed
from mindlang.explaining.article import (
    NO_SECTION,
    Article,
    Parameter,
    Section,
    named_sections,
    sections,
    unwrap_paragraphs,
)
from mindlang.robot.options import DriverOption

Asked = Argument | DriverOption
SHAPES = {
    "list": "several, each {}",
    "numbers": "a list, each {}",
    "words": "a list, each {}",
    "texts": "a list, each {}",
    "place": "two numbers, each {}",
    "places": "places, each number {}",
    "alternatives": "places, each number {}",
    "region": "{}, or two corners of a rectangle",
    "span": "{}, or a range of it",
    "extent": "{}, or two",
}
DECLARED = ("thing", "sensor", "servo", "skill")  # what has a name in a mind
LEAST_SAID, MOST_SAID, MOST_DEGREES = 1e-3, 99_999.0, 360.0  # bounds beyond these are for machines
UNLIMITED_NAMES = ("between", "at least", "up to")  # of quantities that say their bounds themselves


def parameter(asked: Asked, purpose: str = "") -> Parameter:
    """An argument or option in words: what it is for, where that is known, and what it takes."""
    return Parameter(asked.key, meaning(asked), None if asked.required else _default(asked), purpose)


def meaning(asked: Asked) -> str:
    """The values that an argument takes, in words."""
    shape = SHAPES.get(asked.shape, "{}")
    match asked.type:
        case Reference(noun, words) if words:
            return shape.format(listed(words))
        case Reference(noun):
            return shape.format(f"the name of {a(noun)}" if noun in DECLARED else a(noun))
        case Quantity() as quantity:
            share = ", or in %" if {"%", ""} <= quantity.units.keys() else ""
            rate = ", or so much per s" if quantity.rate else ""
            return shape.format(quantity.name) + share + rate + _bounds(quantity)


def _bounds(quantity: Quantity) -> str:
    """The bounds of a quantity in its own unit, where a person would ask for them."""
    unit, factor = _unit(quantity)
    low, high = quantity.low / factor, quantity.high / factor
    most = MOST_DEGREES if unit == "deg" else MOST_SAID
    said = [f"from {low:g}"] if low == 0 or LEAST_SAID <= abs(low) <= most else []
    said += [f"to {high:g}"] if abs(high) <= most else []
    if any(word in quantity.name for word in UNLIMITED_NAMES) or not (said or unit):
        return ""
    return ", " + " ".join([*said, unit] if said else ["in", unit]).strip()


def _unit(type_: Quantity | Reference) -> tuple[str, float]:
    """The unit in which it is said: the one that is stored, or the first."""
    units = type_.units if isinstance(type_, Quantity) else {}
    stored = ((unit, factor) for unit, factor in units.items() if factor == 1.0)
    return next(stored, next(((unit, factor) for unit, factor in units.items() if unit != "%"), ("", 1.0)))


def _default(asked: Asked) -> str:
    """The default as it would be written."""
    match asked.default:
        case bool(flag):
            return str(flag).lower()
        case None | () | "":
            return "none"
        case float(number) if number == FARTHEST_UNITS:
            return "however far"
        case Span() as span if span == UNSAID:
            return "as the scene says"
        case Span(first, last, by):
            step = f" by {_figures(asked, by)}" if by else ""
            least, most = _figures(asked, first), _figures(asked, last)
            return least if first == last else f"{least} to {most}{step}"
        case int(address) if asked.type is ADDRESS:
            return f"{address:#04x}"
        case int() | float() as number:
            return _figures(asked, number)
        case tuple() as numbers:
            return _figures(asked, *numbers)
    return str(asked.default)


def _figures(asked: Asked, *numbers: Any) -> str:
    unit, factor = _unit(asked.type)
    figures = [f"{each / factor:g}" for each in numbers]
    return " ".join([*figures, unit.removesuffix("s") if unit == "ticks" and figures == ["1"] else unit]).strip()


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
    text, package = "\n\n".join(filter(None, _texts(cls))), brought_by(cls)
    title, _, rest = text.partition("\n\n")
    return Article(
        name,
        noun,
        f"kind of {noun}, of {package[0]}" if package else f"kind of {noun}",
        _SAID[noun][1],
        title if package else more.title,
        rest if package else text,
        tuple(parameter(each, "" if package else _purpose(noun, name, each.key)) for each in arguments(cls)),
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
