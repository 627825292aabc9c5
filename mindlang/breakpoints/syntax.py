"""What the lines of a .break file are read as, beside the syntax of conditions and events."""

from dataclasses import dataclass

from mindlang.compiler.source import Span
from mindlang.compiler.syntax import Amount, Ends, Name


@dataclass(frozen=True, slots=True)
class Transmits:
    """`SKILL influences NAME above AMOUNT`, a comparison of a condition."""

    skill: Name
    to: Name
    level: str
    amount: Amount
    span: Span


@dataclass(frozen=True, slots=True)
class Moment:
    """`stop in tick AMOUNT`"""

    tick: Amount
    span: Span


Line = Ends | Moment  # `stop on EVENT` and `stop when CONDITION` say what would end a run
