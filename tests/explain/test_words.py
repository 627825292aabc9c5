"""Every word of the language is explained, with an example that compiles."""

from pathlib import Path

import pytest

from mindlang.compiler.compile import load
from mindlang.explaining.article import Article
from mindlang.explaining.kinds import NOUNS, kind_articles, language_words, word_articles, words_of
from mindlang.explaining.terminal import LINE_COLUMNS, article_text
from tests.explain.examples import write_among

SPOKEN = ("reading", "command", "influence", "reward", "lesson", "learner")  # terms that no line of a mind shows alone


@pytest.mark.parametrize("article", word_articles().values(), ids=lambda each: each.name)
def test_an_example_compiles_and_has_the_word(article: Article, tmp_path: Path) -> None:
    for text in article.right:
        is_written = all(word in text for word in article.name.split())
        assert is_written or article.noun == "term"
        assert [each.message for each in load(write_among(text, tmp_path)).diagnostics] == []
    assert article.right or article.noun == "unit" or article.name in SPOKEN


def test_a_word_fits_a_terminal() -> None:
    texts = ("".join(text for text, _ in article_text(article)) for article in word_articles().values())
    assert [line for text in texts for line in text.splitlines() if len(line) > LINE_COLUMNS] == []


@pytest.mark.parametrize("noun", NOUNS)
def test_a_noun_names_all_of_its_kinds(noun: str) -> None:
    text = word_articles()[noun].text
    assert all(each.name in text for each in kind_articles() if each.noun == noun)


def test_terms_are_no_words_of_a_line() -> None:
    assert set(word_articles()) - set(language_words()) == set(words_of("Terms"))
