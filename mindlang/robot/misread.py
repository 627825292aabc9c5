"""What PyYAML cannot read, and what it reads as another thing than was meant: in the user's words."""

import re
from collections.abc import Callable
from typing import NamedTuple

import yaml

from mindlang.compiler.source import Source, Span

Answer = tuple[str, Span, str, str]  # code, place, message, hint

# What the parser says, what it means, what to do.
PROBLEMS = (
    ("mapping values are not allowed", "A second colon stands here, or this line is too far in.",
     "Begin each key on a line of its own, as far in as its neighbours, with a space after its colon; "
     'put quotes around a value that has a colon: "a: b".'),
    ("sequence entries are not allowed", "A list cannot begin here.", "Write [1, 2], or each - on a line of its own."),
    ("could not find expected ':'", "A colon is missing.", "Write a word, a colon, a space and the value."),
    ("expected ',' or ']'", "This list has no end, or a comma is missing.", "Write [1, 2, 3]."),
    ("expected ',' or '}'", "This table has no end, or a comma is missing.", "Write {driver: mock, value: 0.5}."),
    ("unexpected end of stream", "A quote is opened and never closed.", "Write a quote after the text, too."),
    ("unexpected document separator", "A quote is opened and never closed.", "Write a quote after the text, too."),
    ("escape", "This is not what can stand after \\ in double quotes.",
     "Write \\\\ for a backslash, or single quotes around the text."),
    ("cannot start any token", "A value cannot begin with this character.", "Put quotes around the value."),
    ("expected <block end>, but found '<scalar>'", "Something stands after the end of a value.",
     "Put quotes around the whole value, or begin a new line."),
    ("expected <block end>, but found '<block", "This line is not as far in as its neighbours.",
     "Begin all keys of one table in the same column."),
    ("expected <block end>, but found '-'", "This line is not as far in as its neighbours.",
     "Begin all entries of one list in the same column."),
    ("expected <block end>, but found '?'", "This key is not as far in as its neighbours.",
     "Begin all keys of one table in the same column."),
    ("expected <block end>", "A bracket is closed that was never opened.", "Remove it, or open it before."),
    ("expected the node content", "A value is missing here.", "Write it, or remove the comma or bracket."),
    ("expected '<document start>'", "This does not belong to what stands before it.",
     "Begin all keys of one table in the same column."),
    ("incompatible YAML document", "This is another version of YAML.", "Remove the lines that begin with %."),
)  # fmt: skip
NUMBER_SIGN = re.compile(r"(^|\s)#.*")
MAX_SHOWN_CHARACTERS = 40
WORD = re.compile(r"[\w.]+|[^\n]")


def shortened(text: str) -> str:
    """What was written, if it is not too long for a message."""
    return text if len(text) <= MAX_SHOWN_CHARACTERS else f"{text[: MAX_SHOWN_CHARACTERS - 1]}…"


def check_tabs(source: Source) -> Answer | None:
    """The first tab of a text, which YAML takes in some places and not in others."""
    start = 0
    for line in source.text.split("\n") if "\t" in source.text else ():
        if found := re.search("\t+", NUMBER_SIGN.sub("", line)):
            tabs = re.compile("\t+").match(source.text, start + found.start())
            span = Span(source, *tabs.span()) if tabs else Span(source, start, start)
            return "yaml-tab", span, "A tab stands here.", "Write spaces: YAML counts how far in a line is."
        start += len(line) + 1
    return None


def misread(error: Exception, source: Source, at: int) -> Answer:
    """What the parser's error means; `at` is how far it came."""
    if isinstance(error, yaml.reader.ReaderError):
        message = f"The character U+{ord(source.text[error.position]):04X} cannot stand in YAML."
        return "yaml-character", Span(source, error.position, error.position + 1), message, "Remove it."
    mark = getattr(error, "problem_mark", None)
    start = min(mark.index if mark else at, len(source.text))
    problem = str(getattr(error, "problem", None) or "escape sequence")
    known = ((message, hint) for part, message, hint in PROBLEMS if part in problem)
    message, hint = next(known, (f"This is not YAML: {shortened(problem)}.", "Compare it with docs/robot-yaml.md."))
    if "no end" in message or "never closed" in message:  # it is the beginning that has to be looked at
        opened = getattr(error, "context_mark", None)
        start = opened.index if opened else start
    word = WORD.match(source.text, start)
    end = word.end() if word else start
    if "double quotes" in message:
        start, end = max(start - 1, 0), start + 1
    return "yaml-syntax", Span(source, start, end), message, hint


def _boolean(text: str) -> str:
    return "true" if text.lower() in ("yes", "on", "true") else "false"


def _seconds(text: str) -> str:
    total = 0.0
    for part in text.split(":"):
        total = 60 * total + float(part)
    return f"{total:.15g}"


def _all_digits(text: str) -> str:
    """The digits of a number with an exponent, behind a colon, where they are not too many."""
    number = float(text.replace("_", ""))
    digits = f"{number:.12f}".rstrip("0").rstrip(".")
    return f": {digits}" if len(digits) <= 20 and (number == 0 or 1e-9 <= abs(number) <= 1e15) else ""


def _decimal(text: str) -> str:
    """What digits of another base may stand for."""
    base = 2 if "b" in text else 8
    digits = re.sub("^[-+]?0[ob]?", "", text).replace("_", "")
    decimal = digits.lstrip("0") or "0"
    try:
        value = f"{int(digits, base)}" if len(digits) < 30 else decimal
    except ValueError:
        return decimal
    if value == decimal or text.lstrip("+-")[1:2] in "ob":
        return value
    return f"{decimal}, or {value} where base {base} is meant"


def _whole(text: str) -> str:
    """A number with digits before its point, and behind it."""
    sign = "-" if text[0] == "-" else ""
    whole, _, part = text.lstrip("+-").partition(".")
    return f"{sign}{whole or '0'}{'.' * bool(part)}{part}"


def _text(text: str) -> str:
    return text


class Surprise(NamedTuple):
    """What YAML takes for something else; message and hint have `text` as written, and what it is `meant` as."""

    pattern: re.Pattern[str]
    code: str
    message: str
    hint: str
    meant: Callable[[str], str] = _text


QUOTES = 'Where a word is meant, write it in quotes: "{text}".'
VERSIONS = "To YAML {text} is a number or a word: its versions differ."
BASE = "To YAML {text} is a number of base %s or 10: its versions differ."
WHOLE = (
    Surprise(
        re.compile(r"(?i:yes|no|on|off)|True|TRUE|False|FALSE"),
        "yaml-boolean", "To YAML {text} is {meant}, and not a word.", "Write {meant}. " + QUOTES, _boolean,
    ),
    Surprise(
        re.compile(r"~|null|Null|NULL"), "yaml-null", "To YAML {text} is nothing.", "Leave the line out. " + QUOTES
    ),
    Surprise(
        re.compile(r"[-+]?[0-9]{1,9}(:[0-5]?[0-9]){1,9}(\.[0-9]{0,9})?"),
        "yaml-clock", "To YAML {text} is the number {meant}, as minutes and seconds are.",
        "Write a time in seconds: {meant} s. " + QUOTES, _seconds,
    ),
    Surprise(
        re.compile(r"[0-9]{4}-[0-9]{1,2}-[0-9]{1,2}([Tt \t].*)?"),
        "yaml-date", "To YAML {text} is a date.", 'Write it in quotes: "{text}".',
    ),
)  # fmt: skip
NUMBERS = (
    Surprise(
        re.compile(r"[-+]?[0-9][0-9_]*(\.[0-9_]*)?[eE][-+]?[0-9]{1,9}|[-+]?\.[0-9_]+[eE][-+]?[0-9]{1,9}"),
        "yaml-exponent", VERSIONS, "Write all digits{meant}.", _all_digits,
    ),
    Surprise(re.compile(r"[-+]?0b[0-9_]+"), "yaml-base", BASE % 2, "Write {meant}.", _decimal),
    Surprise(re.compile(r"[-+]?0o?[0-9_]+"), "yaml-base", BASE % 8, "Write {meant}.", _decimal),
    Surprise(
        re.compile(r"[-+]?(0x[0-9a-fA-F_]*_[0-9a-fA-F_]*|[0-9][0-9_]*_[0-9_]*(\.[0-9_]*)?)"),
        "yaml-underscore", VERSIONS, "Write {meant}.", lambda text: text.replace("_", ""),
    ),
    Surprise(
        re.compile(r"[-+]?\.(inf|Inf|INF)|\.(nan|NaN|NAN)"), "yaml-infinite",
        "To YAML {text} is no number that can be measured or sent.", "Write a number with digits.",
    ),
    Surprise(
        re.compile(r"[-+]?\.[0-9]+|[-+]?[0-9]+\.|\+[0-9]+(\.[0-9]+)?"),
        "yaml-number", "{text} is not how a number is written here.", "Write {meant}.", _whole,
    ),
)  # fmt: skip


def surprise(text: str) -> tuple[str, str, str] | None:
    """Code, message and hint of a text without quotes that YAML takes for something else: `no` is false, 12:30 is 750.

    None of it is taken.
    """
    words = text.split() if text[:1] in "+-.0123456789" else []
    for said, table in ((text, WHOLE), *((word, NUMBERS) for word in words)):
        for row in table:
            if row.pattern.fullmatch(said):
                parts = {"text": said, "meant": row.meant(said)}
                return row.code, row.message.format(**parts), row.hint.format(**parts)
    return None
