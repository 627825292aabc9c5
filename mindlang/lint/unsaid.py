"""Arguments that no line says, and the fix that says them: defaults fit a robot of size 2 and its arena of 100."""

from collections.abc import Iterable
from decimal import Decimal
from typing import Any

from mindlang.compiler.diagnostic import Fix
from mindlang.compiler.model import Part
from mindlang.compiler.splice import Splice
from mindlang.compiler.syntax import Phrase
from mindlang.lint.study import Study


def phrases_without(study: Study, noun: str, parts: Iterable[Part[Any]], argument: str) -> list[Phrase]:
    """The kinds of some parts as they are written, of those that do not say an argument."""
    phrases = (study.mind.names.table[noun][part.name].header.phrase for part in parts)
    return [each for each in phrases if each and all(said.key.text != argument for said in each.arguments)]


def saying(phrases: Iterable[Phrase], text: str) -> Fix:
    """The fix that writes an argument behind each of some kinds. It is not safe: the robot becomes another one."""
    ends = dict.fromkeys((phrase.span.source, phrase.span.end) for phrase in phrases)
    return Fix(f"Say {text}", tuple(Splice(source, end, end, f" {text}") for source, end in ends), is_safe=False)


def short(value: float, digits: int = 2) -> str:
    """A number of so many digits as the language writes it, without an exponent."""
    return f"{Decimal(f'{value:.{digits}g}'):f}"
