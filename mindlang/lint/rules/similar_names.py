"""Two names that can hardly be told apart.

They differ only in case, in underscores, or in characters that look alike, such as 0 and O or 1 and l. One day somebody
writes one and means the other, and everything compiles.
"""

import re

from mindlang.compiler.diagnostic import Label
from mindlang.compiler.references import introductions
from mindlang.compiler.syntax import Name
from mindlang.lint.study import Finding, Found, Study

ALIKE = str.maketrans("0O1I\u0430\u0435\u043e\u0440\u0441\u0445\u0443\u03bf", "oollaeopcxyo")
GOOD = "sensor eye_1 is range_finder at 0 deg\nsensor eye_2 is range_finder at 30 deg\n"
BAD = (
    "sensor front_eye is range_finder at 0 deg\nsensor fronteye is range_finder at 30 deg\n",
    "sensor eye0 is range_finder at 0 deg\nsensor eyeO is range_finder at 30 deg\n",
)


def check(study: Study) -> Found:
    """Names of one noun that look the same as one before them: those that others see come before the main file's."""
    seen: dict[tuple[str, str], Name] = {}
    for mention in introductions([*study.mind.files[1:], study.mind.files[0]]):
        name = mention.name
        firsts = [seen.setdefault((mention.noun, look), name) for look in _looks(name.text)]
        for first in [first for first in firsts if first.text != name.text][:1]:
            label = Label(first.span, f"{first.text} is declared here")
            hint = "Give one of the two another name: mindc edit rename."
            yield Finding(name.span, f"{name.text} looks almost like {first.text}.", hint, (label,))


def _looks(name: str) -> tuple[str, str]:
    """A name without case and without what only sets its words apart, and the same without look-alikes."""
    joined = re.sub(r"(?<!\d)_|_(?!\d)", "", name)
    return joined.casefold(), joined.translate(ALIKE).casefold()
