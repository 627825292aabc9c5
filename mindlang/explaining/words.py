"""The words of the language: what each is for, from `words.md`."""

from functools import cache

from mindlang.explaining.article import Article, Section, sections
from mindlang.explaining.kinds import NOUNS, kind_articles

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
