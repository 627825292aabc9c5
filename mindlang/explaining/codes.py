"""Every code of a diagnostic: errors from the compiler's `errors.md`, lint rules from themselves."""

from collections.abc import Iterator
from functools import cache

from mindlang.compiler.diagnostic import ERRORS
from mindlang.explaining.article import Article
from mindlang.explaining.sections import sections, titled
from mindlang.lint.rules import all_rules

ERROR, RULE = "error", "lint rule"


@cache
def codes() -> dict[str, Article]:
    """All codes: errors in the order of their chapters, then the lint rules."""
    return {each.name: each for each in (*errors(), *_rules())}


def errors() -> Iterator[Article]:
    """The errors."""
    for each in sections(ERRORS):
        wrong, right = each.labelled("mind bad"), each.labelled("mind good")
        yield Article(each.name, ERROR, ERROR, each.chapter, each.title, each.text, wrong=wrong, right=right)


def _rules() -> Iterator[Article]:
    for rule in all_rules().values():
        wrong, right = (tuple(mind.lstrip("\n") for mind in minds) for minds in (rule.bad, rule.good))
        yield Article(rule.code, RULE, RULE, "Lint rules", *titled(rule.text), wrong=wrong, right=right)
