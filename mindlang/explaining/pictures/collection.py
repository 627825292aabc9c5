"""The pictures of articles, by the names of their files in docs/pictures/."""

from collections.abc import Callable, Iterable, Iterator, Mapping
from functools import partial

from mindlang.explaining.article import Article
from mindlang.explaining.pictures.of_kinds import OF_KINDS
from mindlang.explaining.pictures.wiring import wiring_picture

Draw = Callable[[], str]


def pictures(articles: Iterable[Article]) -> Mapping[str, Draw]:
    """What draws each picture of some articles, by the name of its file."""
    return {picture_file(each): draw for each in articles for draw in _drawn(each)}


def picture_file(article: Article) -> str:
    """The name of a file."""
    return f"{article.noun}-{article.name}.svg"


def _drawn(article: Article) -> Iterator[Draw]:
    if draw := OF_KINDS.get((article.noun, article.name)):
        yield partial(draw, article)
    if article.wiring:
        yield partial(wiring_picture, article.wiring)
