"""Common malformed lines and what to say of them, of `mistakes.toml`."""

import re
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from pathlib import Path

from mindlang.compiler.syntax import NOUNS, PARTS, SETTINGS, VERBS, WHOLES

_PART = re.compile(r"\(\?&(\w+)\)")


@dataclass(frozen=True, slots=True)
class Mistake:
    """A malformed line: the first pattern found explains it. `example` is one such line."""

    code: str
    pattern: str
    message: str
    hint: str
    example: str


@dataclass(frozen=True, slots=True)
class CommonMistakes:
    """Mistakes in `openings` of lines, in `lines` of a mind and of a .break file (`stops`).

    `right` is a line as it should be for each word with which one begins, `foreign_words` what people write for one.
    """

    openings: tuple[Mistake, ...]
    lines: tuple[Mistake, ...]
    stops: tuple[Mistake, ...]
    right: Mapping[str, str]
    foreign_words: Mapping[str, str]


@cache
def common_mistakes() -> CommonMistakes:
    """The common mistakes, read from `mistakes.toml` once."""
    import tomllib

    said = tomllib.loads(Path(__file__).with_suffix(".toml").read_text(encoding="utf-8"))
    words = {"noun": NOUNS, "part": PARTS, "whole": WHOLES, "verb": VERBS, "setting": SETTINGS}
    parts = said["parts"] | {name: "|".join(of) for name, of in words.items()}

    def whole(pattern: str) -> str:
        return _PART.sub(lambda found: whole(parts[found[1]]), pattern)

    openings, lines, stops = (
        tuple(Mistake(**row | {"pattern": whole(row["pattern"])}) for row in said[of])
        for of in ("openings", "mistakes", "stops")
    )
    stops += tuple(each for each in lines if each.code != "two-facts")  # what a skill influences is part of one
    return CommonMistakes(openings, lines, stops, said["lines"], said["foreign_words"])
