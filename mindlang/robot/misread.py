"""Explains what PyYAML could not read: a diagnostic in the user's words, with a span."""

import re

import yaml

from mindlang.compiler.source import Source, Span
from mindlang.robot.nodes import shortened

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
    ("unknown escape character", "This is not what can stand after \\ in double quotes.",
     "Write \\\\ for a backslash, or single quotes around the text."),
    ("escape sequence", "This is not what can stand after \\ in double quotes.",
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


def odd_line(source: Source) -> Answer | None:
    """The first tab of a text, which YAML takes in some places and not in others."""
    if "\t" not in source.text:
        return None
    start = 0
    for line in source.text.split("\n"):
        at = NUMBER_SIGN.sub("", line).find("\t")
        if at >= 0:
            tabs = len(line[at:]) - len(line[at:].lstrip("\t"))
            span = Span(source, start + at, start + at + tabs)
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
    end = _end(source.text, start)
    if "double quotes" in message:
        start, end = max(start - 1, 0), start + 1
    return "yaml-syntax", Span(source, start, end), message, hint


def _end(text: str, start: int) -> int:
    """The end of the word that begins here."""
    found = re.compile(r"[\w.]+|[^\n]").match(text, start)
    return found.end() if found else start
