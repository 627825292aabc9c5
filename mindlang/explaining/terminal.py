"""Articles on a terminal, in 80 columns, and as data."""

from collections.abc import Callable, Iterable, Iterator
from itertools import groupby
from textwrap import fill, indent
from typing import Any

from mindlang.explaining.article import Article
from mindlang.explaining.collection import ERROR

LINE_COLUMNS = 80
WITH_OPTIONS = ("driver", "command", "program", "mindrun")  # nouns
NAME_COLUMNS = 12  # columns of a name, at least
Segment = tuple[str, str]  # text and style


def article_text(article: Article) -> Iterator[Segment]:
    yield article.name, "bold"
    yield f" ({article.sort})\n", "dim"
    yield f"{fill(article.summary, LINE_COLUMNS, break_on_hyphens=False)}\n", ""
    for paragraph in article.paragraphs:
        yield f"\n{fill(paragraph, LINE_COLUMNS, break_on_hyphens=False)}\n", ""
    if article.scale:
        yield "\n", ""
        yield from _rows([(mark, meaning, "") for mark, meaning in article.scale.items()], 4)
    if article.parameters:
        yield f"\n{'Options' if article.noun in WITH_OPTIONS else 'Arguments'}:\n", "bold"
        yield from _rows([(each.key, each.words, each.otherwise) for each in article.parameters], NAME_COLUMNS)
    yield from _examples(article)
    if article.wiring:
        yield f"\nWires to the {article.wiring.device}:\n", "bold"
        yield from _rows([(each.begin, each.terminal, "") for each in article.wiring.wires], NAME_COLUMNS)


def _rows(rows: list[tuple[str, str, str]], least: int) -> Iterator[Segment]:
    """A name, what there is to say of it, and a remark behind it, below one another."""
    wide = max(least, *(len(key) for key, _, _ in rows))
    for key, text, remark in rows:
        lines = fill(f"{text}{remark}", LINE_COLUMNS - wide - 4, break_on_hyphens=False).split("\n")
        yield f"  {key:{wide}}", "cyan"
        yield "  " + f"\n{'':{wide + 4}}".join(lines) + "\n", ""


def _examples(article: Article) -> Iterator[Segment]:
    right = "Right" if article.wrong else "Example"
    for heading, style, texts in (("Wrong", "red", article.wrong), (right, "green", article.right)):
        for text in texts:
            yield f"\n{heading}:\n", style
            yield f"{indent(text.rstrip(), '  ')}\n", ""


def code_list(codes: Iterable[Article]) -> Iterator[Segment]:
    """All codes with their sentences, by chapter."""
    yield from _by_chapter(codes, lambda each: f"Errors: {each.chapter}" if each.noun == ERROR else each.chapter)
    yield "mindc explain CODE says more; mindc kinds lists the kinds and the drivers.\n", "dim"


def kind_list(articles: Iterable[Article]) -> Iterator[Segment]:
    """Kinds and drivers by their sort, a line each."""
    yield from _by_chapter(
        articles, lambda each: f"Drivers {each.chapter.lower()}" if each.noun == "driver" else each.chapter
    )
    yield "mindc explain NAME says more of one.\n", "dim"


def _by_chapter(articles: Iterable[Article], heading: Callable[[Article], str]) -> Iterator[Segment]:
    known = list(articles)
    wide = max(len(each.name) for each in known)
    for title, group in groupby(known, key=heading):
        yield f"{title}\n", "bold"
        for each in group:
            yield f"  {each.name:{wide}}", "cyan"
            yield f"  {each.summary}\n", ""
        yield "\n", ""


def article_data(article: Article) -> dict[str, Any]:
    arguments = [
        {"key": each.key, "for": each.purpose, "takes": each.meaning, "default": each.default or None}
        for each in article.parameters
    ]
    words = {key: getattr(article, key) for key in ("name", "noun", "sort", "chapter", "summary", "text")}
    return words | {"arguments": arguments} | {key: getattr(article, key) for key in ("scale", "wrong", "right")}
