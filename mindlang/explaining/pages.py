"""The pages of reference in docs/, made of the articles."""

from collections.abc import Callable, Iterable, Mapping

from mindlang.explaining.article import Article
from mindlang.explaining.codes import codes
from mindlang.explaining.drivers import driver_articles
from mindlang.explaining.kinds import kind_articles
from mindlang.explaining.markdown import reference
from mindlang.explaining.pictures.collection import picture_file, pictures
from mindlang.explaining.words import word_articles

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
What each word of the language is for, and a few terms; [language.md](language.md) has all of it together. `mindc
explain teaches` prints one of them.
{MADE}
"""
CODES = f"""\
The codes that stand in brackets at the end of a message: what each means, and what to do. `mindc explain CODE` prints
one of them, `mindc explain` lists them.
{MADE}
"""


def all_pictures() -> Mapping[str, Callable[[], str]]:
    """What draws each picture of the pages, by its path in docs/."""
    drawn = pictures((*kind_articles(), *driver_articles()))
    return {f"pictures/{name}": draw for name, draw in drawn.items()}


def _paths(articles: Iterable[Article]) -> Mapping[str, str]:
    """The pictures that there are of some articles, by noun and name."""
    known = all_pictures()
    paths = {f"{each.noun} {each.name}": f"pictures/{picture_file(each)}" for each in articles}
    return {name: path for name, path in paths.items() if path in known}


PAGES: Mapping[str, Callable[[], str]] = {
    "kinds.md": lambda: reference("Kinds", KINDS, kind_articles(), _paths(kind_articles())),
    "drivers.md": lambda: reference("Drivers", DRIVERS, driver_articles(), _paths(driver_articles())),
    "words.md": lambda: reference("Words", WORDS, word_articles().values()),
    "codes.md": lambda: reference("Codes", CODES, codes().values()),
}
