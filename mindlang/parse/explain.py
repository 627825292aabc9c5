"""Why a line cannot be read: a common mistake, or else what the grammar expected."""

import re
from typing import TYPE_CHECKING

from mindlang.diagnostic import Diagnostic, a, did_you_mean, listed
from mindlang.parse.mistakes import MISTAKES
from mindlang.source import Span
from mindlang.syntax import NOUNS, PARTS, SETTINGS, VERBS

if TYPE_CHECKING:
    from lark import UnexpectedInput

LONG = 1000  # a longer line is no common mistake, and patterns would take their time over it

_WORDS = {
    "$END": "the end of the line", "NAME": "a name in small letters", "TITLE": "a Capitalised name",
    "NUMBER": "a number", "UNIT": "a unit", "SIGN": "+ or -", "MINUS": "-", "SCALE": "* or /", "LPAR": "(",
    "RPAR": ")", "COMPARE": "< <= > or >=", "TEXT": 'a path in "quotes"',
}  # fmt: skip


def proper(noun: str, name: str) -> str:
    """A name as the names of its noun are written."""
    return _snake(name) if noun in PARTS else _title(name)


def _snake(name: str) -> str:
    return re.sub(r"(?<=[a-z0-9])(?=[A-Z])", "_", name).lower()


def _title(name: str) -> str:
    return "".join(part[:1].upper() + part[1:] for part in name.split("_"))


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
                "a_noun": a(noun),
                "snake": _snake(groups["here"]),
                "title": _title(groups["here"]),
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
    if "NUMBER" in expected:
        expected -= {"SIGN", "MINUS"}
    words = [_WORDS[name] for name in _WORDS if name in expected]
    words += sorted(name.lower() for name in expected - set(_WORDS) if name.isalpha() and name.isupper())
    here = code[start:end]
    message = f"{here[:40]} cannot stand here." if here else "The line ends too early."
    return Diagnostic(
        "malformed-line", message, _at(line, start, end), f"Here comes {listed(words or ['the end of the line'])}."
    )
