"""The tree of a file: one small dataclass per fact, each with its span. Nothing in it is checked yet."""

from dataclasses import dataclass

from mindlang.compiler.source import Source, Span

# The words with which a line begins; the names of parts begin with a small letter, all others with a capital one.
PARTS = ("sensor", "actuator", "memory")
WHOLES = ("body", "skill", "curriculum")
NOUNS = (*PARTS, *WHOLES, "task")
VERBS = ("reads", "drives", "influences", "stays", "contains", "lasts", "ends", "rewards", "counts", "teaches")
SETTINGS = ("use", "master", "tick")


@dataclass(frozen=True, slots=True)
class Name:
    """A name as written, capitalised or not; also a noun, a kind, the key of an argument."""

    text: str
    span: Span


@dataclass(frozen=True, slots=True)
class Amount:
    """A number with its unit, as written; `1/0` is not a number (nan)."""

    number: float
    unit: str
    span: Span


@dataclass(frozen=True, slots=True)
class Numbers:
    """One amount or a list of them."""

    amounts: tuple[Amount, ...]
    span: Span


@dataclass(frozen=True, slots=True)
class Range:
    """`4 to 8` or `3 to 1 by 0.1`."""

    first: Amount
    last: Amount
    by: Amount | None
    span: Span


Value = Numbers | Range | Name


@dataclass(frozen=True, slots=True)
class Argument:
    """A key and its value."""

    key: Name
    value: Value
    span: Span


@dataclass(frozen=True, slots=True)
class Phrase:
    """A kind and its arguments; in an expression also the bare name of a reading."""

    kind: Name
    arguments: tuple[Argument, ...]
    span: Span


@dataclass(frozen=True, slots=True)
class Operator:
    """One of + - * / or, for the minus of a single value, negate."""

    symbol: str
    span: Span


Term = Amount | Phrase | Operator


@dataclass(frozen=True, slots=True)
class Expression:
    """Terms in postfix order: a flat tuple, so that no depth of nesting ever needs a deep stack."""

    terms: tuple[Term, ...]
    span: Span


@dataclass(frozen=True, slots=True)
class Reads:
    """`reads NAME`"""

    name: Name
    span: Span


@dataclass(frozen=True, slots=True)
class Drives:
    """`drives NAME [at EXPRESSION]`"""

    name: Name
    at: Expression | None
    span: Span


@dataclass(frozen=True, slots=True)
class Influences:
    """`influences NAME [at EXPRESSION]`"""

    name: Name
    at: Expression | None
    span: Span


@dataclass(frozen=True, slots=True)
class Stays:
    """`stays frozen`"""

    how: Name
    span: Span


@dataclass(frozen=True, slots=True)
class Contains:
    """`contains NAME is PHRASE`"""

    name: Name
    phrase: Phrase
    span: Span


@dataclass(frozen=True, slots=True)
class Lasts:
    """`lasts AMOUNT`"""

    amount: Amount
    span: Span


@dataclass(frozen=True, slots=True)
class Ends:
    """`ends on EVENT`"""

    event: Phrase
    span: Span


@dataclass(frozen=True, slots=True)
class Each:
    """`for each NAME in SENSOR`"""

    name: Name
    sensor: Name
    span: Span


@dataclass(frozen=True, slots=True)
class When:
    """`when LEFT < RIGHT`"""

    left: Expression
    compare: str
    right: Expression
    span: Span


@dataclass(frozen=True, slots=True)
class Rewards:
    """`rewards EXPRESSION per tick …` or, with an event, `rewards EXPRESSION on EVENT …`"""

    amount: Expression
    on: Phrase | None
    each: Each | None
    when: When | None
    span: Span


@dataclass(frozen=True, slots=True)
class Counts:
    """`counts EVENT`"""

    event: Phrase
    span: Span


@dataclass(frozen=True, slots=True)
class Teaches:
    """`teaches SKILL on TASK [under MASTER] for GENERATIONS …`"""

    skill: Name
    task: Name
    master: Name | None
    generations: Amount
    arguments: tuple[Argument, ...]
    span: Span


Fact = Reads | Drives | Influences | Stays | Contains | Lasts | Ends | Rewards | Counts | Teaches


@dataclass(frozen=True, slots=True)
class Header:
    """`NOUN NAME is PHRASE`; the phrase is missing where the line is malformed."""

    noun: Name
    name: Name
    phrase: Phrase | None
    span: Span


@dataclass(frozen=True, slots=True)
class Declaration:
    """A header and the facts below it; it is `whole` when every line below it could be read."""

    header: Header
    facts: tuple[Fact, ...]
    whole: bool = True


@dataclass(frozen=True, slots=True)
class Use:
    """`use "PATH"`"""

    path: str
    span: Span


@dataclass(frozen=True, slots=True)
class Master:
    """`master NAME`"""

    name: Name
    span: Span


@dataclass(frozen=True, slots=True)
class Tick:
    """`tick AMOUNT`"""

    amount: Amount
    span: Span


Setting = Use | Master | Tick
Line = Setting | Header | Fact


@dataclass(frozen=True, slots=True)
class File:
    """A whole source."""

    source: Source
    settings: tuple[Setting, ...]
    declarations: tuple[Declaration, ...]
