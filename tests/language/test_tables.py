"""What the tables of docs/language.md show as a part of the language is one: each stands in a line in which nothing is
wrong, or below with the reason why it is none.
"""

import re
from collections.abc import Iterator
from typing import NamedTuple

import pytest

from tests.language.examples import ROOT, compiled

PAGE = (ROOT / "docs" / "language.md").read_text(encoding="utf-8")
NO_LINES = {  # of which each is still found in a table
    "neutral": "an argument: its value is said where it stands",
    "width": "an argument of mlp, which Eq. 5 says",
    "range": "an argument, which stands with a value beside it",
    "dead_zone": "an argument",
    "ahead": "an argument of floor",
    "at": "an argument of floor",
    "proximity": "the name of a sensor in the examples",
    "neat": "a kind that is not there yet",
    "convolution": "a kind that is not there yet",
    "mindrun report": "a command",
}
KINDS = {  # of each noun, behind which an argument may stand that its table shows alone
    "actuator": ["wheel side left"],
    "sensor": ["range_finder at 0 deg"],
    "curriculum": ["restarting"],
    "skill": ["mlp"],
}
FACTS = {"curriculum": "  {}"}
REQUIRED = {  # what every declaration of a noun must say, in its line or below
    "actuator": " neutral 0.5",
    "skill": "\n  reads feeler\n  drives left_wheel",
    "task": "\n  lasts 9 ticks",
}
BODIES = ["disc", "car"]  # of which no actuator is for both
AROUND = """tick 1/60 s
master Collect
body Robot is disc
actuator left_wheel is wheel side left neutral 0.5
actuator right_wheel is wheel side right neutral 0.5
sensor feeler is range_finder at 0 deg

skill Collect is mlp
  reads feeler
  drives left_wheel
  drives right_wheel

task Collect in plain
  contains ball is item size 2
  contains home is zone
  lasts 100 ticks
  rewards 1 on reach of ball

"""


class Shown(NamedTuple):
    """What a row of a table shows as code, and the noun of its row."""

    noun: str
    code: str


def rows() -> Iterator[list[str]]:
    """The cells of each row that is no head of a table."""
    for head, table in re.findall(r"^(\|.*\|)\n\|[-|]+\|\n((?:\|.*\|\n)+)", PAGE, re.MULTILINE):
        for line in table.splitlines():
            yield [head.strip("| ").partition(" ")[0], *line.strip("|").split("|")]


def shown() -> list[Shown]:
    """All of it. In a table whose head says of what it is, the first cell is no noun but code."""
    found = []
    for head, first, *rest in rows():
        cells = rest if head == "noun" else [first, *rest]
        noun = first.strip(" `") if head == "noun" else head
        found += [Shown(noun, code) for cell in cells for code in re.findall("`([^`]+)`", cell)]
    return list(dict.fromkeys(found))


def lines(noun: str, code: str) -> Iterator[str]:
    """The lines in which such code may stand: a phrase of its noun, an argument of a kind, a fact below one."""
    said = code.removesuffix(" …").replace("at …", "at 0").replace("SENSOR", "feeler")
    said = said.replace("module.function", "examples.made")
    said = re.sub(r"\bX\b", "home" if "inside" in said else "ball", said)
    link = "in" if noun == "task" else "is"
    for phrase in (said, *(f"{kind} {said}" for kind in KINDS.get(noun, []))):
        yield f"{noun} {'Own' if noun in ('body', 'skill', 'scene', 'task', 'curriculum') else 'own'} {link} {phrase}"
    if noun in FACTS:
        yield FACTS[noun].format(said)


def mistakes(noun: str, line: str) -> list[str]:
    """What is wrong in a line of a mind that has all that it may speak of, on each of the bodies."""
    return min((_mistakes(noun, line, AROUND.replace("disc", body)) for body in BODIES), key=len)


def _mistakes(noun: str, line: str, around: str) -> list[str]:
    before = re.sub("body .*\n", "", around) if noun == "body" else around
    before += "curriculum Whole is genetic\n" * line.startswith(" ")
    text = before + line + REQUIRED.get(noun, "") + "\n"
    number = before.count("\n") + 1
    found = [each for each in compiled(text).diagnostics if each.severity == "error"]
    return [each.message for each in found if each.span is None or each.span.line == number]


@pytest.mark.parametrize("each", [each for each in shown() if each.code not in NO_LINES], ids=lambda each: each.code)
def test_a_table_shows_lines_of_the_language(each: Shown) -> None:
    found = {line: mistakes(each.noun, line) for line in lines(*each)}
    assert [line for line, wrong in found.items() if not wrong], found


def test_what_is_no_line_is_still_shown() -> None:
    assert {each.code for each in shown()} >= NO_LINES.keys()


@pytest.mark.parametrize(
    ("noun", "code"),
    [
        ("body", "disk size 2"),
        ("actuator", "wheel side left thrust 80 deg"),
        ("actuator", "noise 2 deg"),
        ("sensor", "range_finder at … deg rnge 12"),
        ("sensor", "bearing of Y"),
        ("memory", "cell decay 2"),
        ("skill", "neat"),
        ("scene", "arena sise 100"),
        ("task", "plane"),
        ("curriculum", "teaches Collect on Collect for 20 s"),
        ("curriculum", "founders many"),
    ],
)
def test_what_is_wrong_in_a_table_would_be_seen(noun: str, code: str) -> None:
    assert all(mistakes(noun, line) for line in lines(noun, code))
