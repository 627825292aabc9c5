"""The pages of reference in docs/, made of the articles."""

from collections.abc import Callable, Iterable, Iterator, Mapping
from functools import partial
from itertools import groupby
from textwrap import fill

from docs.reference.of_kinds import OF_KINDS
from docs.reference.wiring import wiring_picture
from mindlang.cli.explain import command_articles
from mindlang.explaining.article import Article, Parameter, fenced
from mindlang.explaining.collection import codes, driver_articles
from mindlang.explaining.kinds import kind_articles, word_articles

LINE_CHARACTERS = 120
CELL = str.maketrans({"|": "\\|"})
MADE = "\n<!-- made from what mindc knows: UPDATE=1 pytest tests/explain/test_pages.py -->"
KINDS = f"""\
What stands behind `is` in a `.mind` ([language.md](language.md)): what it is, what a reading or command of 0, 0.5 and
1 means, what it takes, and an example. `mindc explain wheel` prints one of them, `mindc kinds` lists them.
{MADE}
"""
DRIVERS = f"""\
What `driver:` can be in a `robot.yaml` ([robot-yaml.md](robot-yaml.md)), and the options of each; `mindc explain
ultrasonic` prints one of them.
{MADE}
"""
WORDS = f"""\
What each word of the language is for, and a few terms; [language.md](language.md) has the exact meaning. `mindc
explain teaches` prints one of them.
{MADE}
"""
CODES = f"""\
The codes that stand in brackets at the end of a message: what each means, and what to do. `mindc explain CODE` prints
one of them, `mindc explain` lists them.
{MADE}
"""
COMMANDS = """\
The commands of `mindc`, and what `mindrun` does on a robot, each with its options and examples, as `--help` has them.
`mindc explain train` and `mindc explain mindrun replay` print one of them.
"""
PAGES: Mapping[str, Callable[[], str]] = {
    "kinds.md": lambda: reference("Kinds", KINDS, kind_articles()),
    "drivers.md": lambda: reference("Drivers", DRIVERS, driver_articles()),
    "words.md": lambda: reference("Words", WORDS, word_articles().values()),
    "codes.md": lambda: reference("Codes", CODES, codes().values()),
    "commands.md": lambda: reference("Commands", COMMANDS, command_articles()),
}


def pictures() -> Mapping[str, Callable[[], str]]:
    """What draws each picture of the pages, by its path in docs/."""
    articles = (*kind_articles(), *driver_articles())
    return {_path(article): draw for article in articles if (draw := _drawing(article))}


def _path(article: Article) -> str:
    return f"pictures/{article.noun}-{article.name}.svg"


def _drawing(article: Article) -> Callable[[], str] | None:
    if article.wiring:
        return partial(wiring_picture, article.wiring)
    draw = OF_KINDS.get((article.noun, article.name))
    return partial(draw, article) if draw else None


def reference(title: str, about: str, articles: Iterable[Article]) -> str:
    """A page: chapters, and a section for each article."""
    text = f"# {title}\n\n{about}"
    for chapter, group in groupby(articles, key=lambda each: each.chapter):
        text += f"\n## {chapter}\n\n" + "\n".join("\n".join(_section(each)) for each in group)
    return text


def _section(article: Article) -> Iterator[str]:
    """The lines of an article in a page."""
    yield from (f"### `{article.name}`", "", article.summary, "")
    for paragraph in article.paragraphs:
        yield from (fill(paragraph, LINE_CHARACTERS, break_long_words=False, break_on_hyphens=False), "")
    if _drawing(article):
        about = f"How to wire the {article.wiring.device}" if article.wiring else f"{article.name}: {article.summary}"
        yield from (f"![{about}]({_path(article)})", "")
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
