"""Malformed lines explained: a table of common mistakes, and what was expected where none of them fits."""

import re
from dataclasses import dataclass
from typing import TYPE_CHECKING

from mindlang.diagnostic import Diagnostic, did_you_mean, listed
from mindlang.source import Span

if TYPE_CHECKING:
    from lark import UnexpectedInput

PARTS = ("sensor", "actuator", "memory")
WHOLES = ("body", "skill", "curriculum")
NOUNS = (*PARTS, *WHOLES, "task")
VERBS = ("reads", "drives", "influences", "contains", "lasts", "ends", "rewards", "counts", "teaches")
LONG = 1000  # a longer line is no common mistake, and patterns would take their time over it
SETTINGS = ("use", "master", "tick")


@dataclass(frozen=True, slots=True)
class Mistake:
    """A malformed line: the first pattern found explains it. `here` is what to point at; `example` is one such line."""

    code: str
    pattern: str
    message: str
    hint: str
    example: str


_PART, _WHOLE, _VERB = ("|".join(words) for words in (PARTS, WHOLES, VERBS))

MISTAKES = (
    Mistake(
        "odd-space",
        r"(?P<here>[^\S \t])",
        "This is not an ordinary space.",
        "Replace it by a space; it often comes along when text is copied from a page.",
        "reads\u00a0moving",
    ),
    Mistake(
        "quoted-path",
        r"""^\s*use\s+(?P<here>[^"\s].*|'.*)$""",
        "The path of a file stands in quotes.",
        'Write use "file.mind".',
        "use other.mind",
    ),
    Mistake(
        "comma",
        r"(?P<here>[,;])",
        "A list has no commas or semicolons.",
        "Separate values by spaces.",
        "sensor eyes is range_finder at 0, 90 deg",
    ),
    Mistake(
        "comparison",
        r"(?P<here>==|!=|=<|=>|≤|≥|<>)",
        "{here} is not a comparison of the language.",
        "Compare with < <= > or >=; readings are real numbers, which are hardly ever equal.",
        "rewards 1 per tick when holding == 1",
    ),
    Mistake(
        "equals-sign",
        r"(?P<here>(?<![<>])=)",
        "An argument has no equals sign.",
        "Write size 4, not size = 4.",
        "body Robot is disc size=2",
    ),
    Mistake(
        "power",
        r"(?P<here>\*\*|\^)",
        "There are no powers, only + - * and /.",
        "Multiply: x * x.",
        "rewards p ** 2 per tick",
    ),
    Mistake("colon", r"(?P<here>:)", "A line has no colon.", "Leave it out.", "skill Avoid is mlp hidden 2:"),
    Mistake(
        "braces",
        r"(?P<here>[][{}])",
        "The language has no braces and no brackets.",
        "One fact stands on each line; a list is written with spaces between its values.",
        "sensor eyes is range_finder at [0 90] deg",
    ),
    Mistake(
        "quotes",
        r"""^\s*(?!use\b).*?(?P<here>["'`]+)""",
        "Names stand without quotes.",
        "Leave the quotes out.",
        "reads 'moving'",
    ),
    Mistake(
        "odd-character",
        r"(?P<here>[^\w\s.%()+*/<>=\"-])",
        "The character {here} is no part of the language.",
        "Remove it.",
        "reads moving!",
    ),
    Mistake(
        "small-name",
        rf"^\s*(?P<noun>{_PART})\s+(?P<here>[A-Z][\w+]*)",
        "The name of {a_noun} begins with a small letter.",
        "Write {snake}.",
        "sensor ObjectBearing is bearing of object",
    ),
    Mistake(
        "capital-name",
        rf"^\s*(?P<noun>{_WHOLE}|task)\s+(?P<here>[a-z][\w]*)\s+(?:is|in)\b",
        "The name of {a_noun} begins with a capital letter.",
        "Write {title}.",
        "skill avoid is mlp",
    ),
    Mistake(
        "small-name",
        r"^\s*(?P<noun>reads|drives|contains)\s+(?P<here>[A-Z][\w+]*)",
        "What a line {noun} has a name that begins with a small letter.",
        "Did you mean {snake}?",
        "reads Moving",
    ),
    Mistake(
        "capital-name",
        r"^\s*(?P<noun>influences|teaches|master)\s+(?P<here>[a-z]\w*)",
        "The name of a skill begins with a capital letter.",
        "Did you mean {title}?",
        "influences avoid",
    ),
    Mistake(
        "task-in",
        r"^\s*task\s+[A-Z][\w+]*\s+(?P<here>is)\b",
        "A task is in a scene.",
        "Write in instead of is: task Avoid in arena size 100.",
        "task Avoid is arena",
    ),
    Mistake(
        "missing-in",
        r"^\s*task\s+(?P<here>[A-Z][\w+]*)(?!\s*\+|\s+in\b)\b",
        "After the name of a task comes in and its scene.",
        "Write task {here} in arena size 100, or in plain.",
        "task Avoid arena",
    ),
    Mistake(
        "missing-is",
        rf"^\s*(?P<noun>{_PART}|{_WHOLE})\s+(?P<here>[\w+.]+)\b(?![+.]|\s+is\b)",
        "After the name of {a_noun} comes is and its kind.",
        "Write {noun} {here} is KIND.",
        "skill Avoid mlp hidden 2",
    ),
    Mistake(
        "missing-is",
        r"^\s*contains\s+(?P<here>[\w.]+)\b(?!\.|\s+is\b)",
        "After the name of a thing comes is and its kind.",
        "Write contains {here} is item, zone, obstacle or power.",
        "contains rock obstacle",
    ),
    Mistake(
        "missing-on",
        r"^\s*(?P<here>ends)\b(?!\s+on\b)",
        "A task ends on an event.",
        "Write ends on collision.",
        "ends collision",
    ),
    Mistake(
        "missing-for",
        r"^\s*teaches\s+(?P<here>[A-Z][\w+]*\s+on\s+[A-Z][\w+]*)(?!.*\bfor\b)",
        "A lesson says for how long.",
        "Write teaches {here} for 1000 generations.",
        "teaches Avoid on Avoid",
    ),
    Mistake(
        "missing-task",
        r"^\s*teaches\s+(?P<here>[A-Z][\w+]*)\b(?!\+|\s+on\b)",
        "A lesson says on which task.",
        "Write teaches {here} on TASK for 1000 generations.",
        "teaches Avoid for 100 generations",
    ),
    Mistake(
        "unknown-unit",
        r"\d\s*(?P<here>(?:sec|secs|second|seconds|ms|min|minutes|hz|degree|degrees|rad|percent|tick|generation)\b|°)",
        "{here} is not a unit of the language.",
        "The units are s, ticks, generations, deg and %.",
        "sensor pulse is sine period 2 seconds",
    ),
    Mistake(
        "two-facts",
        rf"^\s*\w+\s.*?(?<=\s)(?P<here>{_VERB})(?=\s)",
        "Two facts stand on one line.",
        "Begin a new line before {here}.",
        "reads moving drives left_wheel",
    ),
    Mistake(
        "when-given",
        r"^\s*rewards\s+(?P<here>(?:(?!\s+(?:per|on)\b).)+)$",
        "A reward says when it is given.",
        "Add per tick, or on and an event.",
        "rewards 0.01 * forward",
    ),
    Mistake(
        "parenthesis",
        r"^(?P<here>[^()]*\((?:[^()]|\([^()]*\))*)$",
        "A parenthesis is not closed.",
        "Add ).",
        "drives claw at (holding + 1",
    ),
)

_WORDS = {
    "$END": "the end of the line", "NAME": "a name in small letters", "TITLE": "a Capitalised name",
    "NUMBER": "a number", "UNIT": "a unit", "SIGN": "+ or -", "MINUS": "-", "SCALE": "* or /", "LPAR": "(",
    "RPAR": ")", "COMPARE": "< <= > or >=", "TEXT": 'a path in "quotes"',
}  # fmt: skip


def explain(error: "UnexpectedInput", code: str, line: Span) -> Diagnostic:
    """Why the grammar refuses the line `code`, in the user's words."""
    return _opening(code, line) or _common(code, line) or _unexpected(error, code, line)


def _at(line: Span, start: int, end: int) -> Span:
    return Span(line.source, line.start + start, line.start + max(end, start + 1))


def _opening(code: str, line: Span) -> Diagnostic | None:
    """A line that does not begin with a noun, a verb or a setting."""
    known = (*NOUNS, *VERBS, *SETTINGS)
    first = re.match(r"\s*(\S+)", code)
    word = first[1] if first else ""
    if not first or word in known or re.match(rf"({'|'.join(known)})\W", word):
        return None
    if not word[0].isalpha():
        hint = "A line begins with a noun such as skill, a verb such as reads, or a setting such as tick."
    elif word.lower() in known:
        hint = f"Write {word.lower()}."
    else:
        hint = did_you_mean(word, known) or f"A fact begins with its verb: {listed(VERBS)}."
    return Diagnostic("no-verb", f"A line cannot begin with {word[:40]}.", _at(line, *first.span(1)), hint)


def _common(code: str, line: Span) -> Diagnostic | None:
    if len(code) > LONG:
        return None
    for mistake in MISTAKES:
        if found := re.search(mistake.pattern, code):
            groups = {name: text or "" for name, text in found.groupdict().items()}
            noun = groups.get("noun", "")
            words = {
                **groups,
                "a_noun": f"an {noun}" if noun == "actuator" else f"a {noun}",
                "snake": re.sub(r"(?<=[a-z0-9])(?=[A-Z])", "_", groups["here"]).lower(),
                "title": "".join(part[:1].upper() + part[1:] for part in groups["here"].split("_")),
            }
            return Diagnostic(
                mistake.code,
                mistake.message.format(**words),
                _at(line, *found.span("here")),
                mistake.hint.format(**words),
            )
    return None


def _unexpected(error: "UnexpectedInput", code: str, line: Span) -> Diagnostic:
    from lark import UnexpectedToken

    if isinstance(error, UnexpectedToken):
        expected, token = set(error.expected), error.token
        start, end = (len(code), len(code)) if token.type == "$END" else (token.start_pos, token.end_pos)
    else:
        expected, start = set(getattr(error, "allowed", ())), error.pos_in_stream or 0
        word = re.compile(r"\w+|.").match(code, start)
        end = word.end() if word else start
    words = [_WORDS[name] for name in _WORDS if name in expected]
    words += sorted(name.lower() for name in expected - set(_WORDS) if name.isalpha() and name.isupper())
    here = code[start:end]
    message = f"{here[:40]} cannot stand here." if here else "The line ends too early."
    return Diagnostic(
        "malformed-line", message, _at(line, start, end), f"Here comes {listed(words or ['the end of the line'])}."
    )
