"""Why a line cannot be read: a common mistake, of `mistakes.toml`, or else what the grammar expected."""

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING
from unicodedata import normalize

from mindrun.kinds.registry import arguments, kinds, named_arguments

from mindlang.compiler.diagnostic import Diagnostic, a, did_you_mean, listed
from mindlang.compiler.source import Span
from mindlang.compiler.syntax import NOUNS, PARTS, SETTINGS, VERBS, WHOLES

if TYPE_CHECKING:
    from lark import UnexpectedInput

    from mindlang.compiler.parse.shape import Start

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

    said = tomllib.loads(Path(__file__).with_name("mistakes.toml").read_text(encoding="utf-8"))
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


MAX_EXPLAINED_CHARACTERS = 400  # a longer line is no common mistake, and patterns would take their time over it

_WORDS = {
    "$END": "the end of the line", "NAME": "a name in small letters", "TITLE": "a Capitalised name",
    "NUMBER": "a number", "UNIT": "a unit", "SIGN": "+ or -", "MINUS": "-", "SCALE": "* or /", "LPAR": "(",
    "RPAR": ")", "EXTREME": "least of or greatest of", "COMPARE": "< <= > or >=", "TEXT": 'a path in "quotes"',
}  # fmt: skip

STOPS = "stop when holding > 0.5, stop on collision or stop in tick 812"  # lines of a .break file

JOINTS = ("for", "to", "by", "below", "facing", "per", "when")  # after which a value comes that is no argument's


def proper(noun: str, name: str) -> str:
    """A name as the names of its noun are written."""
    return _snake(name) if noun in PARTS else _title(name)


def _snake(name: str) -> str:
    return re.sub(r"(?<=[a-z0-9])(?=[A-Z])", "_", name).lower()


def _title(name: str) -> str:
    return "".join(part[:1].upper() + part[1:] for part in name.split("_"))


def explain(error: "UnexpectedInput", code: str, line: Span, start: "Start" = "line") -> Diagnostic:
    """Why the grammar refuses the line `code`, of a mind or of a .break file, in the user's words."""
    known = common_mistakes()
    if start == "stop":
        return _no_stop(code, line) or common_mistake(known.stops, code, line) or unexpected(error, code, line, STOPS)
    found = _opening(code, line) or common_mistake(known.lines, code, line)
    return found or unexpected(error, code, line, _right(code.split()[0]))


def _right(word: str) -> str:
    """A line that begins with a word, as it should be; one of a skill where no line does."""
    lines = common_mistakes().right
    return lines.get(word, lines["skill"])


def _at(line: Span, start: int, end: int) -> Span:
    past = min(line.start + max(end, start + 1), len(line.source.text))
    return Span(line.source, line.start + start, past)


def _opening(code: str, line: Span) -> Diagnostic | None:
    """A line that does not begin with a noun, a verb or a setting."""
    known = (*NOUNS, *VERBS, *SETTINGS)
    first = re.match(r"\s*(\S+)", code)
    word = first[1] if first else ""
    if not first or word in known or re.match(rf"({'|'.join(known)})\W", word):
        return None
    here = _at(line, *first.span(1))
    message = f"A line cannot begin with {word[:40]}."
    if word.lower() in known:
        return Diagnostic("no-verb", message, here, f"Write {word.lower()}.")
    if known_word := _known_words().get(word):
        example = f", as in {_right(known_word)}" if known_word in common_mistakes().right else ""
        return Diagnostic("no-verb", message, here, f"Write {known_word}{example}.")
    if word in _keys() and re.match(r"\s*\w+(\s+[-+\d.]|\s*$)", code):
        hint = "Write it on the line of its declaration, after the kind, as in skill Avoid is mlp hidden 2."
        return Diagnostic("argument-below", f"{word} is an argument, and no fact of its own.", here, hint)
    if told := common_mistake(common_mistakes().openings, code, line):
        return told
    hint = did_you_mean(word, known) or f"A fact begins with its verb: {listed(VERBS)}."
    if not word[0].isalpha():
        hint = "A line begins with a noun such as skill, a verb such as reads, or a setting such as tick."
    return Diagnostic("no-verb", message, here, hint)


def _no_stop(code: str, line: Span) -> Diagnostic | None:
    """A line of a .break file that does not begin with stop."""
    first = re.match(r"\s*(\S+)", code)
    if not first or re.match(r"stop\b", first[1]):
        return None
    if not first[1][0].isalpha() and (told := common_mistake(common_mistakes().openings, code, line)):
        return told
    message = "A line of a .break file begins with stop."
    return Diagnostic("no-stop", message, _at(line, *first.span(1)), f"Write for example {STOPS}.")


@cache
def _known_words() -> dict[str, str]:
    """The word of the language for each that people write for one."""
    return {word: known for known, words in common_mistakes().foreign_words.items() for word in words.split()}


@cache
def _keys() -> frozenset[str]:
    """The arguments of what is declared."""
    nouns = (*NOUNS, "content")
    return frozenset(argument.key for noun in nouns for cls in kinds(noun).values() for argument in arguments(cls))


def common_mistake(mistakes: Sequence[Mistake], code: str, line: Span) -> Diagnostic | None:
    """The first of the mistakes that the line makes, in words; None where it makes none of them."""
    if len(code.strip()) > MAX_EXPLAINED_CHARACTERS:
        return None
    for mistake in mistakes:
        if found := re.search(mistake.pattern, code):
            groups = {name: text or "" for name, text in found.groupdict().items()}
            words = {**groups, **_computed_fields(groups, code)}
            start, end = found.span("noun" if found["here"] is None else "here")
            message, hint = (text.format(**words) for text in (mistake.message, mistake.hint))
            return Diagnostic(mistake.code, message, _at(line, start, end), hint)
    return None


def _computed_fields(groups: Mapping[str, str], code: str) -> dict[str, str]:
    """The fields of a message that are computed from the groups that a pattern found."""
    here, noun, first = groups["here"], groups.get("noun", ""), (code.split() or [""])[0]
    registered = kinds("content" if noun == "contains" else noun)
    kind = registered.get(groups.get("kind", ""))
    digits = "".join(str(int(c)) for c in here if c.isdecimal())
    has_exponent = re.fullmatch(r"[0-9.]+[eE][-+]?[0-9]", here)
    return {
        "a_noun": a(noun),
        "snake": _snake(here),
        "title": _title(here),
        "lower": here.lower(),
        "plain": normalize("NFKC", here).replace("⁄", "/"),
        "digits": digits,
        "written": f"{float(here):.10f}".rstrip("0").rstrip(".") if has_exponent else digits,
        "tight": "".join(here.split()),
        "bare": here.strip("\"'`“”„‘’«» "),
        "joined": re.sub(r"\W+", "_", here) if here[:1].islower() else _title(re.sub(r"\W+", "_", here)),
        "kinds": listed(sorted(registered)) if registered else "",
        "takes": _taken(kind),
        "line": _right(re.split(r"\W", first)[0]),
        "noun_line": _right(noun),
    }


def _taken(kind: type | None) -> str:
    """The arguments that a kind takes, in words."""
    if kind is None:
        return "arguments by name"
    return listed(each.key for each in named_arguments(kind)) if named_arguments(kind) else "no arguments"


def _without_value(key: str, code: str, here: Span) -> Diagnostic:
    """A line that ends in a word after which a value should stand, if its kind has an argument of that name."""
    noun, kind = code.split()[0], re.search(r"\b(?:is|in) ([a-z]\w*)", code)
    cls = kinds("content" if noun == "contains" else noun).get(kind[1]) if kind else None
    if kind and cls and key not in {each.key for each in arguments(cls)}:
        takes = listed([each.key for each in named_arguments(cls)] or ["no arguments"], "and")
        message = f"{kind[1]} has no argument called {key}."
        return Diagnostic("unknown-argument", message, here, f"{kind[1]} takes {takes}.")
    known = {argument.key for cls in kinds("curriculum").values() for argument in arguments(cls)}
    if noun == "teaches" and key not in known and (meant := did_you_mean(key, known)):
        return Diagnostic("unknown-argument", f"A lesson has no argument called {key}.", here, meant)
    hint = f"Write its value after {key}, or leave {key} out."
    return Diagnostic("missing-value", f"After {key} a value is missing.", here, hint)


def unexpected(error: "UnexpectedInput", code: str, line: Span, example: str) -> Diagnostic:
    """Where the line is not as the grammar has it; `example` is such a line as it should be."""
    from lark import UnexpectedToken

    if isinstance(error, UnexpectedToken):
        expected, token = set(error.expected), error.token
        start, end = (len(code), len(code)) if token.type == "$END" else (token.start_pos, token.end_pos)
    else:
        expected, start = set(getattr(error, "allowed", ())), error.pos_in_stream or 0
        word = re.compile(r"\w+|.").match(code, start)
        end = word.end() if word else start
    key = re.search(r"(?<=\s)([a-z]\w*)\s*$", code[:start])
    if key and key[1] not in JOINTS and not code[start:end] and {"NAME", "NUMBER"} <= expected:
        return _without_value(key[1], code, _at(line, *key.span(1)))
    expected -= {"SPACED", *(("SIGN", "MINUS") if "NUMBER" in expected else ())}
    words = [_WORDS[name] for name in _WORDS if name in expected]
    words += sorted(name.lower() for name in expected - set(_WORDS) if name.isalpha() and name.isupper())
    here = code[start:end]
    message = f"{here[:40]} cannot stand here." if here else "The line ends too early."
    comes = f"Here comes {listed(words or ['the end of the line'])}. " if len(words) < 4 else ""
    hint = f"{comes}Such a line is for example {example}."
    return Diagnostic("malformed-line", message, _at(line, start, end), hint)
