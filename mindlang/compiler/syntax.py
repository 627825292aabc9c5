"""The tree of a file: one small struct per fact, each with its span. Nothing in it is checked yet."""

from collections.abc import Callable, Iterable, Iterator
from math import inf
from typing import Any, TypeVar

from msgspec import Struct
from msgspec.structs import astuple

from mindlang.compiler.source import Source, Span, comment_of

# The words with which a line begins; the names of parts begin with a small letter, all others with a capital one.
PARTS = ("sensor", "actuator", "memory")
WHOLES = ("body", "skill", "curriculum", "scene")
NOUNS = (*PARTS, *WHOLES, "task")
WORLD_VERBS = ("contains", "starts", "draws", "varies", "fails")  # what the world is, not what is to be done in it
GOAL_VERBS = ("wants", "avoids", "keeps", "then", "prefers")
VERBS_OF = {
    "skill": ("reads", "drives", "influences", "chooses", "stays", "uses", "requires", "maintains", "achieves"),
    "task": (*WORLD_VERBS, "lasts", "ends", "succeeds", "opens", "rewards", "counts", *GOAL_VERBS),
    "scene": WORLD_VERBS,
    "curriculum": ("teaches",),
}  # the verbs of the facts that may stand below a declaration, by its noun
VERBS = tuple(dict.fromkeys(verb for verbs in VERBS_OF.values() for verb in verbs))
SETTINGS = ("use", "master", "tick", "mind", "unit", "number")

L = TypeVar("L", bound=Struct)


class Name(Struct, frozen=True):
    """A name as written, capitalised or not; also a noun, a kind, the key of an argument."""

    text: str
    span: Span


class Amount(Struct, frozen=True):
    """A number with its unit, as written; `1/0` is not a number (nan). `per` is the time that a rate is for.

    Where a `name` stands for the number, `number` is its sign. When it is replaced by its number, `said` is where that
    is written; when it is for a second, `tick_seconds` becomes how long a tick is.
    """

    number: float
    unit: str
    span: Span
    per: str = ""
    name: str = ""
    said: Span | None = None
    tick_seconds: float = 0.0

    @property
    def constant(self) -> Name:
        """The number's name, with the span that it has in the text, without the sign."""
        written = self.span.text.lstrip("+- \t")
        return Name(self.name, Span(self.span.source, self.span.end - len(written), self.span.end))


class Numbers(Struct, frozen=True):
    """One amount or a list of them."""

    amounts: tuple[Amount, ...]
    span: Span


class Sums(Struct, frozen=True):
    """`10 -20 + 40 * side`: several numbers, of which some are computed."""

    sums: tuple["Expression", ...]
    span: Span


class Range(Struct, frozen=True):
    """`4 to 8` or `3 to 1 by 0.1`."""

    first: Amount
    last: Amount
    by: Amount | None
    span: Span


class Points(Struct, frozen=True):
    """`-20 10 to 5 10 to 5 0`: places one after the other, as written; a range has one number on each side."""

    points: tuple[Numbers | Sums, ...]
    by: Amount | None
    span: Span


class Text(Struct, frozen=True):
    """`"maze.txt"`: a path, without its quotes."""

    text: str
    span: Span


class AnyName(Struct, frozen=True):
    """`person or car`: several names, of things that a sensor is about alike."""

    names: tuple[Name, ...]
    span: Span


class Either(Struct, frozen=True):
    """`or 10 0 or 0 10`: what may stand instead of the value before it; a range has one number on each side."""

    options: tuple[Numbers | Sums | Range | Points | Name, ...]
    span: Span


Value = Numbers | Sums | Range | Points | Name | AnyName | Text | Either


class Argument(Struct, frozen=True):
    """A key and its value."""

    key: Name
    value: Value
    span: Span


class Phrase(Struct, frozen=True):
    """A kind and its arguments; in an expression also the bare name of a reading.

    An event may have to come soon after another: `within` so long of that.
    """

    kind: Name
    arguments: tuple[Argument, ...]
    span: Span
    within: "Within | None" = None


class Within(Struct, frozen=True):
    """`within AMOUNT of EVENT`"""

    amount: Amount
    of: Phrase
    span: Span


class Term(Struct, frozen=True):
    """A word and its operand, as `mindrun.numbers.expression` has them, but for names: a reading is not a place yet.

    As it is written, an expression has operators alone as such terms; `resolve` makes one of all else.
    """

    word: str
    operand: Any
    span: Span


class Expression(Struct, frozen=True):
    """Terms in postfix order: a flat tuple, so that no depth of nesting ever needs a deep stack."""

    terms: tuple["Amount | Phrase | Term | Tally", ...]
    span: Span

    @property
    def formula(self) -> tuple[tuple[str, Any], ...]:
        """The words and operands of its resolved terms."""
        return tuple((term.word, term.operand) for term in of_form(self.terms, Term))

    def found(self, word: str) -> list[Term]:
        """The resolved terms of a word, such as reading, also in the conditions of its tallies."""
        resolved = of_form(self.terms, Term)
        tallies = ((term.operand.when, term.operand.value) for term in resolved if term.word == "tally")
        nested = (each for inner in expressions_in(*tallies) for each in inner.found(word))
        return [*(term for term in resolved if term.word == word), *nested]


class Comparison(Struct, frozen=True):
    """`LEFT < RIGHT`"""

    left: Expression
    compare: str
    right: Expression
    span: Span


class Tally(Struct, frozen=True):
    """`(count of EVENT …)`, `(count when CONDITION)`, `(longest when CONDITION)` or `(sum of EXPRESSION …)`, of a run.

    Once it is resolved its `event` is one, and no longer a phrase.
    """

    word: Name
    event: Any
    when: "When | None"
    value: "Expression | None"
    span: Span

    interval = (0.0, inf)


class Transmits(Struct, frozen=True):
    """`SKILL influences NAME above AMOUNT`, a comparison of what stops a run."""

    skill: Name
    to: Name
    level: str
    amount: Amount
    span: Span


class When(Struct, frozen=True):
    """`when A < B and C > D or …`: one of the alternatives holds, each of which is comparisons that all hold."""

    alternatives: tuple[tuple[Comparison, ...], ...]
    span: Span

    @property
    def formula(self) -> tuple[tuple[str, Any], ...]:
        """The words and operands of its resolved terms: comparisons joined by `and`, and these by `or`."""
        found: list[tuple[str, Any]] = []
        for number, all_ in enumerate(self.alternatives):
            for place, each in enumerate(of_form(all_, Comparison)):
                found += [*each.left.formula, *each.right.formula, (each.compare, 0)]
                found += [("and", 0)] if place else []
            found += [("or", 0)] if number else []
        return tuple(found)


class Gate(Struct, frozen=True):
    """`when CONDITION [otherwise EXPRESSION]`"""

    when: When
    otherwise: Expression | None
    span: Span


class Reads(Struct, frozen=True):
    """`reads NAME [for NAME]`; the second is the input of the skill that this one is like."""

    name: Name
    stands_for: Name | None
    span: Span


class Sends(Struct, frozen=True):
    """The common part of `drives` and `influences`: to whom something is sent, which value, and when.

    With `for NAME`, to whom a skill sends instead of that, which the skill sends to that this one is like.
    """

    name: Name
    at: Expression | None
    gate: Gate | None
    span: Span
    stands_for: Name | None = None


class Drives(Sends, frozen=True):
    """`drives NAME [at EXPRESSION] [when CONDITION …]`, or `drives NAME for NAME`"""


class Influences(Sends, frozen=True):
    """`influences NAME [over NAME [and NAME …]] [at EXPRESSION] [when CONDITION …] [cuts below AMOUNT]`.

    Or `influences NAME for NAME`, of a skill that is like another.
    """

    cuts: Amount | None = None
    over: tuple[Name, ...] | None = None


class Chooses(Struct, frozen=True):
    """`chooses one`"""

    how: Name
    span: Span


class Stays(Struct, frozen=True):
    """`stays frozen`"""

    how: Name
    span: Span


class Uses(Struct, frozen=True):
    """`uses "PATH"`: a file of the procedure"""

    file: Text
    span: Span


class Promise(When, frozen=True):
    """A condition that a skill promises: that it requires, maintains or achieves."""


class Requires(Promise, frozen=True):
    """`requires CONDITION`"""


class Maintains(Promise, frozen=True):
    """`maintains CONDITION`"""


class Achieves(Promise, frozen=True):
    """`achieves CONDITION`"""


class Contains(Struct, frozen=True):
    """`contains NAME is PHRASE [under SKILL] [when CONDITION]`"""

    name: Name
    phrase: Phrase
    when: When | None
    span: Span
    master: Name | None = None


class Starts(Struct, frozen=True):
    """`starts [at X Y] [facing ANGLE]`"""

    place: tuple[Amount, Amount] | None
    facing: Amount | None
    span: Span


class Draws(Struct, frozen=True):
    """`draws NAME from NUMBERS`, or from a range"""

    name: Name
    of: Numbers | Range | Points
    span: Span


class Varies(Struct, frozen=True):
    """`varies ARGUMENT of NAME LOW to HIGH`"""

    argument: Name
    of: Name
    low: Amount
    high: Amount
    span: Span


class Fails(Struct, frozen=True):
    """`fails NAME RATE`"""

    name: Name
    rate: Amount
    span: Span


class Lasts(Struct, frozen=True):
    """`lasts AMOUNT`"""

    amount: Amount
    span: Span


class Outcome(Struct, frozen=True):
    """The cause of an end or of an opening: `on [TIMES] EVENT` or `when CONDITION`"""

    times: Amount | None
    event: Phrase | None
    when: When | None
    span: Span


class Ends(Outcome, frozen=True):
    """`ends OUTCOME`"""


class Succeeds(Outcome, frozen=True):
    """`succeeds OUTCOME`"""


class Opens(Outcome, frozen=True):
    """`opens NAME OUTCOME`"""

    name: Name | None = None


class Each(Struct, frozen=True):
    """`for each NAME in SENSOR`"""

    name: Name
    sensor: Name
    span: Span


class Rewards(Struct, frozen=True):
    """`rewards EXPRESSION per tick …` or, with an event, `rewards EXPRESSION on EVENT …`"""

    amount: Expression
    on: Phrase | None
    each: Each | None
    when: When | None
    span: Span
    final: Name | None = None


class Counts(Struct, frozen=True):
    """`counts EVENT`"""

    event: Phrase
    span: Span


class Deadline(Struct, frozen=True):
    """`within AMOUNT`, or `after AMOUNT`, of a goal"""

    amount: Amount
    span: Span


class Lasting(Deadline, frozen=True):
    """`for AMOUNT`"""


class Wants(Struct, frozen=True):
    """`wants [TIMES] EVENT [within AMOUNT]`, a goal"""

    times: Amount | None
    event: Phrase
    time: Deadline | None
    span: Span
    then: bool = False


class Avoids(Outcome, frozen=True):
    """`avoids [TIMES] EVENT` or `avoids CONDITION`, a goal"""

    time = None
    then = False


class Keeps(Struct, frozen=True):
    """`keeps CONDITION [after AMOUNT]` or `keeps CONDITION for AMOUNT`, a goal"""

    when: When
    time: Deadline | None
    span: Span
    then: bool = False

    times = None


class Prefers(Struct, frozen=True):
    """`prefers soon`, `prefers little EXPRESSION` or `prefers much EXPRESSION`"""

    how: Name
    amount: Expression | None
    span: Span


Goal = Wants | Avoids | Keeps


class Needs(Struct, frozen=True):
    """`needs MEASURE > NUMBER` or `needs NUMBER EVENT`, of a lesson; `until` likewise."""

    measure: Name | None
    compare: str | None
    above: Amount
    event: Phrase | None
    span: Span


class Teaches(Struct, frozen=True):
    """`teaches SKILL on TASK [under MASTER] [until NEED] for [at most] GENERATIONS …`"""

    skill: Name
    task: Name
    master: Name | None
    generations: Amount
    arguments: tuple[Argument, ...]
    needs: tuple[Needs, ...]
    span: Span
    until: Needs | None = None


Fact = (
    Reads | Drives | Influences | Chooses | Stays | Uses | Promise | Contains | Starts | Draws | Varies | Fails | Lasts
    | Ends | Succeeds | Opens | Rewards | Counts | Teaches | Wants | Avoids | Keeps
    | Prefers
)  # fmt: skip


class Header(Struct, frozen=True):
    """`NOUN NAME is PHRASE`; the phrase is missing where the line is malformed, or is that of another declaration.

    `like` is the skill, scene or task that this one is like, `inside` the scene of a task by its name, and `at` the
    value of a sensor that is computed, where its `gate` is open.
    """

    noun: Name
    name: Name
    phrase: Phrase | None
    span: Span
    like: Name | None = None
    inside: Name | None = None
    at: Expression | None = None
    gate: Gate | None = None

    @property
    def is_read(self) -> bool:
        """True if the part behind its name could be read."""
        return bool(self.phrase or self.like or self.inside)


class Declaration(Struct, frozen=True):
    """A header and the facts below it; it is `whole` when every line below it could be read."""

    header: Header
    facts: tuple[Fact, ...]
    whole: bool = True

    @property
    def comment(self) -> str:
        """The documentation of a declaration: the comments right above it, and the one behind its first line."""
        return comment_of(self.header.span)


class Use(Struct, frozen=True):
    """`use "PATH" [as NAME]`; the span is that of the path."""

    path: str
    span: Span
    alias: Name | None = None


class Master(Struct, frozen=True):
    """`master NAME`"""

    name: Name
    span: Span


class Tick(Struct, frozen=True):
    """`tick AMOUNT`"""

    amount: Amount
    span: Span


class Version(Struct, frozen=True):
    """`mind NUMBER`: for which language the file was written"""

    amount: Amount
    span: Span


class Unit(Struct, frozen=True):
    """`unit AMOUNT`: how long a unit of the world is on a robot"""

    amount: Amount
    span: Span


class Number(Struct, frozen=True):
    """`number NAME is AMOUNT`"""

    name: Name
    amount: Amount
    span: Span


class Stop(Outcome, frozen=True):
    """A line of a .break file: `stop OUTCOME` or `stop in tick TICK`."""

    tick: Tick | None = None


Setting = Use | Master | Tick | Version | Unit | Number
Line = Setting | Header | Fact


class Family(Struct, frozen=True):
    """`where LETTER is AMOUNT to AMOUNT`: the numbers that stand for the letter at the end of names."""

    letter: Name
    first: Amount
    last: Amount
    span: Span


class Repeated(Struct, frozen=True):
    """A line that stands for several, one for each number of its family."""

    line: Header | Fact
    family: Family
    span: Span


class File(Struct, frozen=True):
    """A whole source; a declaration or a fact that stands for several is written out, and `families` is where it is."""

    source: Source
    settings: tuple[Setting, ...]
    declarations: tuple[Declaration, ...]
    families: tuple[Span, ...] = ()


def verb_of(fact: Fact | Sends) -> str:
    """The word with which the line of a fact begins."""
    return type(fact).__name__.lower()


def of_form(lines: Iterable[Any], form: type[L]) -> list[L]:
    """The facts or settings that are of one class."""
    return [line for line in lines if isinstance(line, form)]


def walk_tree(node: Any) -> Iterator[Any]:
    """A node of a tree and all that it is made of, down to words and spans."""
    yield node
    if isinstance(node, Struct):
        node = astuple(node)
    if isinstance(node, tuple):
        for part in node:
            yield from walk_tree(part)


def expressions_in(*nodes: Any) -> Iterator[Expression]:
    """The expressions in some lines or parts of lines, such as conditions."""
    for node in nodes:
        match node:
            case Expression():
                yield node
                yield from expressions_in(*((each.when, each.value) for each in of_form(node.terms, Tally)))
            case Header(at=at, gate=gate):
                yield from expressions_in(at, gate)
            case Contains(phrase=phrase, when=when):
                yield from (each for of in phrase.arguments if isinstance(of.value, Sums) for each in of.value.sums)
                yield from expressions_in(when)
            case Sends() | Gate() | Outcome() | When() | Comparison() | Rewards() | Keeps() | Prefers():
                yield from expressions_in(*astuple(node))
            case tuple():
                yield from expressions_in(*node)


def rebuilt(node: Any, change: Callable[[Any], Any]) -> Any:
    """A tree with `change` applied from the top down; it goes on into the nodes that `change` returns as they were."""
    new = change(node)
    if new is not node:
        return new
    match node:
        case tuple():
            return tuple(rebuilt(part, change) for part in node)
        case Struct():
            return type(node)(*(rebuilt(part, change) for part in astuple(node)))
    return node
