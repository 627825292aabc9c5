"""Every kind is explained whole: what 0, 0.5 and 1 are, each argument by every door, and an example that compiles."""

from itertools import chain
from pathlib import Path

import pytest
from mindrun.kinds.registry import arguments, kinds

from docs.reference.pages import reference
from mindlang.compiler.compile import load
from mindlang.explaining.article import SCALE_MARKS, Article, article_card, sections
from mindlang.explaining.kinds import NOUNS, kind_articles
from mindlang.explaining.terminal import LINE_COLUMNS, article_text, kind_list
from tests.explain.examples import write_among

SENTENCE_CHARACTERS = 60  # with which a line of mindc kinds fits a terminal
SCALED = ("actuator", "sensor", "memory")


def printed(article: Article) -> str:
    """An article as a terminal has it."""
    return "".join(text for text, _ in article_text(article))


def test_every_kind_has_an_article_and_nothing_else_has() -> None:
    known = {(noun, name) for noun, of in NOUNS.items() for name in kinds(of)}
    assert {(each.noun, each.name) for each in kind_articles()} == known
    assert [(each.chapter, each.name) for each in sections("kinds.md")] == list(
        dict.fromkeys((each.chapter, each.name) for each in sections("kinds.md"))
    )
    assert {(each.chapter, each.name) for each in sections("kinds.md")} == known


def test_a_kind_says_in_a_sentence_what_it_is() -> None:
    for article in kind_articles():
        assert article.summary.endswith("."), f"kinds.md has no sentence of {article.name}"
        assert len(article.summary) <= SENTENCE_CHARACTERS, article.name
        assert article.text, article.name


def test_what_has_readings_or_commands_says_what_0_and_a_half_and_1_are() -> None:
    for article in kind_articles():
        assert tuple(article.scale) == (SCALE_MARKS if article.noun in SCALED else ()), article.name
        assert all(article.scale.values()), article.name


def test_every_door_has_each_argument() -> None:
    for article in kind_articles():
        said = {argument.key for argument in arguments(kinds(NOUNS[article.noun])[article.name])}
        assert {each.key for each in article.parameters} == said, article.name
        doors = printed(article), article_card(article), reference("Kinds", "", [article])
        shown = [*article.scale.values(), *chain(*map(str.splitlines, article.right))]
        assert [line for line in shown for text in doors if line not in text] == [], article.name
        for parameter in article.parameters:
            lines = [line for text in doors for line in text.splitlines() if parameter.key in line]
            assert len(lines) >= len(doors), (article.name, parameter.key)
            words = (_unwrapped(parameter.words), _unwrapped(parameter.default or ""))
            assert [each for each in words for text in doors if each not in _unwrapped(text)] == [], article.name


def _unwrapped(text: str) -> str:
    return " ".join(text.split())


def test_every_argument_says_what_it_is_for_and_nothing_else_does() -> None:
    said = {(each.chapter, each.name): each.title for each in sections("arguments.md")}
    used = set()
    for article in kind_articles():
        for parameter in article.parameters:
            chapters = (f"{article.noun} {article.name}", article.noun, "every kind")
            found = next(((each, parameter.key) for each in chapters if (each, parameter.key) in said), None)
            assert found, f"arguments.md does not say what {parameter.key} of {article.name} is for"
            assert parameter.purpose == said[found]
            used.add(found)
    assert set(said) == used
    assert not [purpose for purpose in said.values() if purpose.endswith(".") or "\n" in purpose]


@pytest.mark.parametrize("article", kind_articles(), ids=lambda each: f"{each.noun}-{each.name}")
def test_an_example_compiles_and_has_the_kind(article: Article, tmp_path: Path) -> None:
    assert article.right, f"kinds.md has no example of {article.name}"
    for text in article.right:
        if "gymnasium" in text:
            pytest.importorskip("gymnasium")
        assert f" {article.name}" in text
        assert [each.message for each in load(write_among(text, tmp_path)).diagnostics] == []


def test_it_fits_a_terminal() -> None:
    lines = [line for article in kind_articles() for line in printed(article).splitlines()]
    assert [line for line in lines if len(line) > LINE_COLUMNS] == []


def test_the_list_of_kinds_fits_a_terminal() -> None:
    lines = "".join(text for text, _ in kind_list(kind_articles())).splitlines()
    assert max(map(len, lines)) <= LINE_COLUMNS
    assert all(f"  {each.name} " in "\n".join(lines) for each in kind_articles())


def test_a_kind_that_nobody_wrote_about_is_explained_all_the_same() -> None:
    """The tests above ask for more; a program that runs says what it knows."""
    bare = Article("sonar", "sensor", "kind of sensor", "Sensors", "")
    assert printed(bare).startswith("sonar (kind of sensor)\n")
    assert article_card(bare) == "**sonar**, a kind of sensor"
