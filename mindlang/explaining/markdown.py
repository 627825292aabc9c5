"""Articles as Markdown: what an editor shows under the mouse, and the pages of reference in docs/."""

from collections.abc import Iterable, Iterator, Mapping
from itertools import groupby
from textwrap import fill
from types import MappingProxyType

from mindlang.compiler.diagnostic import a
from mindlang.explaining.article import Article, Parameter

LINE_CHARACTERS = 120  # of a page
NO_PICTURES: Mapping[str, str] = MappingProxyType({})
CELL = str.maketrans({"|": "\\|"})


def card(article: Article) -> str:
    """What an editor shows of it."""
    parts = [f"**{article.name}**, {a(article.sort)}", article.summary, *article.paragraphs]
    parts += ["\n".join(f"- **{mark}** {meaning}" for mark, meaning in article.scale.items())]
    parts += ["\n".join(f"- {parameter_line(each)}" for each in article.parameters)]
    parts += [fenced(text, article.language) for text in article.right]
    return "\n\n".join(filter(None, parts))


def parameter_line(parameter: Parameter) -> str:
    """An argument in a line: what it takes, and its default."""
    return f"`{parameter.key}` {parameter.words}{parameter.otherwise}"


def parameter_card(parameter: Parameter, of: Article) -> str:
    """What an editor shows of an argument."""
    return "\n\n".join([parameter_line(parameter), f"of **{of.name}**: {of.summary}", *of.paragraphs])


def reference(title: str, about: str, articles: Iterable[Article], pictures: Mapping[str, str] = NO_PICTURES) -> str:
    """A page of reference: chapters, and a section for each article; `pictures` are paths by noun and name."""
    text = f"# {title}\n\n{about}"
    for chapter, group in groupby(articles, key=lambda each: each.chapter):
        text += f"\n## {chapter}\n\n" + "\n".join("\n".join(_section(each, pictures)) for each in group)
    return text


def _section(article: Article, pictures: Mapping[str, str]) -> Iterator[str]:
    """The lines of an article in a page."""
    yield from (f"### `{article.name}`", "", article.summary, "")
    for paragraph in article.paragraphs:
        yield from (fill(paragraph, LINE_CHARACTERS, break_long_words=False, break_on_hyphens=False), "")
    if drawn := pictures.get(f"{article.noun} {article.name}"):
        about = f"How to wire the {article.wiring.device}" if article.wiring else f"{article.name}: {article.summary}"
        yield from (f"![{about}]({drawn})", "")
    if article.scale:
        yield from (f"| {' | '.join(article.scale)} |", "|---" * len(article.scale) + "|")
        yield from (f"| {' | '.join(each.translate(CELL) for each in article.scale.values())} |", "")
    if article.parameters:
        yield from (f"| of `{article.name}` | | if it is not said |", "|---|---|---|")
        for each in article.parameters:
            yield f"| `{each.key}` | {each.words.translate(CELL)} | {_default(each)} |"
        yield ""
    for heading, texts in (("Wrong:", article.wrong), ("Right:" if article.wrong else "", article.right)):
        for text in texts:
            yield from ((heading, "") if heading else ())
            yield from (fenced(text, article.language), "")


def _default(parameter: Parameter) -> str:
    return "needed" if parameter.default is None else parameter.default.translate(CELL)


def fenced(text: str, language: str) -> str:
    """A text as a block of code."""
    return f"```{language}\n{text.rstrip()}\n```"
