"""The pages of reference in docs/, made of the articles."""

from collections.abc import Callable, Mapping

from mindlang.explaining.codes import codes
from mindlang.explaining.drivers import driver_articles
from mindlang.explaining.kinds import kind_articles
from mindlang.explaining.markdown import page
from mindlang.explaining.words import word_articles

COMMANDS = """\
The commands of `mindc`, each with its options and examples, as `mindc COMMAND --help` has them. Those of `mindrun`
are in `mindrun --help`.
"""
MADE = "UPDATE=1 pytest tests/explain/test_pages.py"
KINDS = f"""\
What stands behind `is` in a `.mind` ([language.md](language.md)): what it is, what a reading or command of 0, 0.5 and
1 means, what it takes, and an example. `mindc explain wheel` prints one of them, `mindc kinds` lists them. Made from
the kinds themselves: {MADE}
"""
DRIVERS = f"""\
What `driver:` can be in a `robot.yaml` ([robot-yaml.md](robot-yaml.md)), and the options of each; `mindc explain
ultrasonic` prints one of them. Made from the drivers themselves: {MADE}
"""
WORDS = f"""\
What each word of the language is for, and a few terms; [language.md](language.md) has all of it together. `mindc
explain teaches` prints one of them. Made from the words that `mindc` and the editor know: {MADE}
"""
CODES = f"""\
The codes that stand in brackets at the end of a message: what each means, and what to do. `mindc explain CODE` prints
one of them, `mindc explain` lists them. Made from what `mindc` knows: {MADE}
"""

PAGES: Mapping[str, Callable[[], str]] = {
    "kinds.md": lambda: page("Kinds", KINDS, kind_articles()),
    "drivers.md": lambda: page("Drivers", DRIVERS, driver_articles()),
    "words.md": lambda: page("Words", WORDS, word_articles().values()),
    "codes.md": lambda: page("Codes", CODES, codes().values()),
}
