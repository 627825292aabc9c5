"""Articles as Markdown: what an editor shows under the mouse."""

from mindlang.compiler.diagnostic import a
from mindlang.explaining.article import Article, Parameter


def article_card(article: Article) -> str:
    """The Markdown that an editor shows of an article."""
    parts = [f"**{article.name}**, {a(article.sort)}", article.summary, *article.paragraphs]
    parts += ["\n".join(f"- **{mark}** {meaning}" for mark, meaning in article.scale.items())]
    parts += ["\n".join(f"- {parameter_line(each)}" for each in article.parameters)]
    parts += [fenced(text, article.language) for text in article.right]
    return "\n\n".join(filter(None, parts))


def parameter_line(parameter: Parameter) -> str:
    """An argument in a line: what it takes, and its default."""
    return f"`{parameter.key}` {parameter.words}{parameter.otherwise}"


def fenced(text: str, language: str) -> str:
    """A text as a block of code."""
    return f"```{language}\n{text.rstrip()}\n```"
