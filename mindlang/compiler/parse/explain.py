"""Why a line cannot be read: a common mistake, or else what the grammar expected."""

import re
from collections.abc import Mapping, Sequence
from functools import cache
from typing import TYPE_CHECKING
from unicodedata import normalize

from mindrun.kinds.registry import arguments, kinds, named_arguments

from mindlang.compiler.diagnostic import Diagnostic, a, did_you_mean, listed
from mindlang.compiler.parse.mistakes import MISTAKES, OPENINGS, STOP_MISTAKES, Mistake
from mindlang.compiler.source import Span
from mindlang.compiler.syntax import NOUNS, PARTS, SETTINGS, VERBS

if TYPE_CHECKING:
    from lark import UnexpectedInput

    from mindlang.compiler.parse.shape import Start

MAX_EXPLAINED_CHARACTERS = 400  # a longer line is no common mistake, and patterns would take their time over it

_WORDS = {
    "$END": "the end of the line", "NAME": "a name in small letters", "TITLE": "a Capitalised name",
    "NUMBER": "a number", "UNIT": "a unit", "SIGN": "+ or -", "MINUS": "-", "SCALE": "* or /", "LPAR": "(",
    "RPAR": ")", "EXTREME": "least of or greatest of", "COMPARE": "< <= > or >=", "TEXT": 'a path in "quotes"',
}  # fmt: skip

# A line as it should be, for each word with which one begins.
LINES = {
    "sensor": "sensor eyes is range_finder at 0 90 deg",
    "actuator": "actuator left_wheel is wheel side left neutral 0.5",
    "memory": "memory mood is cell decay 0.95",
    "body": "body Robot is disc size 2",
    "skill": "skill Avoid is mlp hidden 2",
    "curriculum": "curriculum Lessons is genetic population 100",
    "task": "task Avoid in arena size 100",
    "reads": "reads eyes",
    "drives": "drives left_wheel",
    "influences": "influences Avoid, or influences Avoid at 0.5 when ahead < 20%",
    "stays": "stays frozen",
    "uses": 'uses "policy.pt"',
    "requires": "requires battery > 5%",
    "maintains": "maintains near < 90%",
    "achieves": "achieves in_dock > 50%",
    "scene": "scene Rocks is arena size 100",
    "contains": "contains rock is obstacle count 10",
    "starts": "starts at 0 0 facing 90 deg",
    "draws": "draws side from 0 1, or draws speed from 2 to 6",
    "varies": "varies thrust of left_wheel 60 to 90",
    "fails": "fails left_wheel 1% per s",
    "lasts": "lasts 10000 ticks",
    "ends": "ends on collision, or ends when battery < 5%",
    "succeeds": "succeeds on 5 delivery of ball",
    "opens": "opens gate on 2 delivery of key, or opens gate when battery < 5%",
    "rewards": "rewards 10 on reach of ball, or rewards forward per tick",
    "counts": "counts collision",
    "teaches": "teaches Avoid on Avoid for 1000 generations",
    "use": 'use "parts.mind"',
    "master": "master Avoid",
    "tick": "tick 1/60 s",
    "mind": "mind 1",
    "unit": "unit 8.5 cm",
    "number": "number sight is 12",
}

STOPS = "stop when holding > 0.5, stop on collision or stop in tick 812"  # lines of a .break file

JOINTS = ("for", "to", "by", "below", "facing", "per", "when")  # after which a value comes that is no argument's

# What people write for a word of the language.
FOREIGN_WORDS = {
    "skill": "behaviour behavior node network policy agent module function def class fn brain controller neuron layer",
    "actuator": "motor wheel output_device effector servo gripper joint",
    "sensor": "camera lidar range_finder input_device detector",
    "memory": "state variable var let",
    "body": "robot chassis vehicle",
    "task": "environment env world level arena game episode",
    "curriculum": "lesson lessons school training learner trainer teacher optimizer optimiser",
    "reads": "senses sees input inputs perceives observes gets takes subscribes",
    "drives": "controls output outputs moves sets actuates commands writes publishes",
    "influences": "activates calls runs triggers invokes excites inhibits subskill subskills child children",
    "stays frozen": "frozen freeze freezes fixed",
    "requires": "precondition expects assumes",
    "maintains": "invariant ensures guarantees keeps",
    "achieves": "postcondition promises leaves",
    "contains": "has includes holds object thing spawn",
    "lasts": "duration time length timeout max_steps steps limit",
    "ends on": "stops stop terminates terminate finishes done",
    "rewards": "reward scores score points gives fitness",
    "rewards with a negative number": "penalises penalizes penalty punishes costs cost loss",
    "counts": "measures metric metrics logs records",
    "number": "const constant define",
    "teaches": "trains train learns learn optimises optimizes",
    "tick": "dt timestep time_step step framerate fps rate frequency hz",
    "master": "root main top start entry",
    'use "file.mind"': "import include from require load using",
}


def proper(noun: str, name: str) -> str:
    """A name as the names of its noun are written."""
    return _snake(name) if noun in PARTS else _title(name)


def _snake(name: str) -> str:
    return re.sub(r"(?<=[a-z0-9])(?=[A-Z])", "_", name).lower()


def _title(name: str) -> str:
    return "".join(part[:1].upper() + part[1:] for part in name.split("_"))


def explain(error: "UnexpectedInput", code: str, line: Span, start: "Start" = "line") -> Diagnostic:
    """Why the grammar refuses the line `code`, of a mind or of a .break file, in the user's words."""
    if start == "stop":
        return _no_stop(code, line) or common_mistake(STOP_MISTAKES, code, line) or unexpected(error, code, line, STOPS)
    return (
        _opening(code, line)
        or common_mistake(MISTAKES, code, line)
        or unexpected(error, code, line, LINES.get(code.split()[0], LINES["skill"]))
    )


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
    if word in _known_words():
        known_word = _known_words()[word]
        example = f", as in {LINES[known_word]}" if known_word in LINES else ""
        return Diagnostic("no-verb", message, here, f"Write {known_word}{example}.")
    if word in _keys() and re.match(r"\s*\w+(\s+[-+\d.]|\s*$)", code):
        hint = "Write it on the line of its declaration, after the kind, as in skill Avoid is mlp hidden 2."
        return Diagnostic("argument-below", f"{word} is an argument, and no fact of its own.", here, hint)
    if told := common_mistake(OPENINGS, code, line):
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
    if not first[1][0].isalpha() and (told := common_mistake(OPENINGS, code, line)):
        return told
    message = "A line of a .break file begins with stop."
    return Diagnostic("no-stop", message, _at(line, *first.span(1)), f"Write for example {STOPS}.")


@cache
def _known_words() -> dict[str, str]:
    """The word of the language for each word of `FOREIGN_WORDS`."""
    return {word: known for known, words in FOREIGN_WORDS.items() for word in words.split()}


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
        "line": LINES.get(re.split(r"\W", first)[0], LINES["skill"]),
        "noun_line": LINES.get(noun, LINES["skill"]),
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
