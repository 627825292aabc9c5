"""The editor's grammar says of every character of every example what the real grammar says."""

import json
import re
from collections.abc import Iterator
from pathlib import Path

import pytest
from lark import Token, Tree, UnexpectedInput

from mindlang.compiler.parse.shape import Start, grammar
from mindlang.explaining.kinds import words_of
from tests.language.examples import EXAMPLES
from tests.server.textmate import scopes

FOLDER = Path(__file__).parents[2] / "editors" / "vscode"
OTHERS = sorted(Path(__file__).parents[1].rglob("*.mind"))
COLOURS = json.loads((FOLDER / "syntaxes" / "mind.tmLanguage.json").read_text(encoding="utf-8"))

NOUN, VERB, WORD = "storage.type", "keyword.control", "keyword.other"
DECLARED, TITLE, PART = "entity.name.function", "entity.name.type", "variable.other"
KIND, KEY, VALUE, FUNCTION = "support.type", "variable.parameter", "variable.other.constant", "support.function"
TOKENS = {
    **dict.fromkeys(("PART", "WHOLE", "TASK"), NOUN),
    "NUMBER": "constant.numeric",
    "UNIT": "keyword.other.unit",
    "TEXT": "string.quoted.double",
    "ITS": FUNCTION,
    "LETTER": PART,
    "ENVIRONMENT": "string.unquoted",
    **dict.fromkeys(("COMPUTED", "NUMBERED", "SEVERAL", "ORDERED", "BROKEN", "GYMNASIUM"), KIND),
    **dict.fromkeys(("FROM", "TO", "BY", "ON", "OF", "WITHIN", "FACING", "AT", "ALONG"), KEY),
    **dict.fromkeys(("EXTREME", "AND", "OR", "TICK", "LEVEL", "COUNT", "LONGEST", "SUM"), WORD),
    **dict.fromkeys(("FINAL", "SOON", "HOW"), WORD),
    **dict.fromkeys(("SIGN", "SPACED", "MINUS", "SCALE", "COMPARE", "PLUS"), "keyword.operator"),
}
NAMES = {  # by the rule in which they stand, and there by their place among the names
    "header": [DECLARED],
    "phrase": [KIND],
    "argument": [KEY],
    "setting": [KEY],
    "numbered": [KEY],
    "its": [FUNCTION],
    "name": [VALUE],
    "constant": [VALUE],
    "quantity": [VALUE],
    "figure": [VALUE],
    "variable": [VALUE],
    "number": [DECLARED],
    "varies": [KEY],
    "stays": [VALUE],
    "chooses": [VALUE],
    "contains": [DECLARED],
    "draws": [DECLARED],
    "each": [DECLARED, PART],
    "needs": [FUNCTION],
}


def code_of(line: str) -> str:
    found = re.match(r'(?:"[^"]*"|[^#])*', line)
    return found[0].rstrip() if found else ""


def expected(code: str, start: Start) -> dict[int, str]:
    """The scope of each character that the grammar makes a token of, by offset; words that it filters out as well."""
    tree = grammar().parse(code, start=start)
    found = {at: scope for token, scope in _tokens(tree, "") for at in range(token.start_pos, token.end_pos)}
    kept = set(found)
    for word in _words(code):
        if word.start() not in kept and re.match(r"\w", word[0]):
            first = not code[: word.start()].strip()
            found |= dict.fromkeys(range(*word.span()), VERB if first else WORD)
    return found


def _words(code: str) -> Iterator[re.Match[str]]:
    return re.finditer(r'"[^"]*"|[\w.]+', code)


def _tokens(tree: Tree[Token], event: str) -> Iterator[tuple[Token, str]]:
    """The tokens with their scopes; in an event even a bare name is a function."""
    names = 0
    for child in tree.children:
        if isinstance(child, Tree):
            is_event = tree.data in ("event", "within", "wants") and child.data == "call"
            yield from _tokens(child, "event" if is_event else "")
        elif child.type in ("NAME", "TITLE"):
            yield child, _of_name(tree, child, names, event)
            names += 1
        else:
            is_word = tree.data == "facing" or (tree.data, child.type) == ("argument", "BY")
            yield child, WORD if is_word else TOKENS[child.type]


def _of_name(tree: Tree[Token], token: Token, number: int, event: str) -> str:
    rule = str(tree.data)
    if rule == "call":
        return FUNCTION if event or len(tree.children) > 1 else PART
    if rule in NAMES:
        return NAMES[rule][number]
    return TITLE if token.type == "TITLE" else PART


ODD = """\
rewards -1/2 * -(p - 0.5) + change of thrust beyond 20 % over 10 ticks - 1 per tick for each p in eyes when p<=3 # for
  rewards (holding) on visit of patch size 4 when a.b >= progress toward on_top
use "a#b.mind"  # "quoted"
task   A+B_2+C in arena size 100\t#in
drives left_wheel at 1
influences A+B at 2*(1-front_feeler)
skill X is procedure from module.function
contains in_box is item size 3 to 1 by 0.1 away -4 to 40
teaches A on B under C+D for 1500 generations mutated 20% from scratch patience 3 generations with subskills
sensor when_near is range_finder at -90 +45 90 deg range 12 dead_zone 1%
memory on is cell decay 1/3
lasts 100 s
wants 10 delivery of red to nest within 400 s
wants visit of patch size 4 within 5 s of reach of red within long
then wants collision
avoids 3 collision
avoids battery < 5%
keeps near > 10% and ahead < limit after 5 s
keeps near > far
then keeps near > 0.5 for 2 s
prefers soon
prefers little change of thrust beyond 20% over 10 ticks
rewards 100 / 3 * (least of (count of reach of red when time <= 900) 4) / 4 at the end when (count of collision) < 3
rewards (longest when a > 1/2 and b < 2) * (count when near > 1%) - (sum of forward when near > 1) at the end
tick 1/60 s
stays frozen
chooses one
requires battery > 5% or in_dock > 1/2
maintains 1 - near > least of left right
sensor unsafe is broken a.Go+Dock
influences Stop over throttle and a.b at 1 when x > 2 cuts below 5%
influences Stop over throttle
contains cat is walker seeks robot range far
contains foe is box flees robot thrust 1/2
counts collision
use "a.mind" as a.b
mind 1
unit 8.5 cm
number sight is -12 deg
number other is -sight
sensor target is computed at to_a * near_a + to_b * (1 - near_a)
sensor ahead is reading 1 of proximity
sensor eyes is range_finder at 0 -side 20 deg range sight dead_zone 1%
sensor battery is battery drain 0.003 per s charge 1% per tick
skill A is like walls.B
task T in Rocks
task T is like walls.R
scene R is arena size 60 40
reads a for b.c
drives a for b.c
influences A for C+D
sensor aN is bearing of xN where N is 1 to 10
influences StepN at 1 when a < 2 where N is 1 to 10
teaches GoN on B for few where N is 0 to 9
influences A at 1 when ahead < 20% and b > 3 or c.d < 1 otherwise 0 cuts below 5%
influences A when a < -b
influences A cuts below limit
drives w at least of a b (1 - c) - greatest of 1 c
starts at 0 -0 facing 90 deg
starts facing -east
rewards least of its reward 0 (x - 1) its reward per tick when least of its end x > its reward
ends when greatest of x its end > 0
varies thrust of left_wheel 60 to 90
varies size of Robot low to 90%
fails left_wheel 1% per s
ends when battery < 5% and x > 2
succeeds on 5 delivery of red to red_bin
succeeds when battery > 1
rewards 50 on success when a < 1 or b > 2
contains wall is wall from -20 10 to 5 10 thickness 1
contains m is map from "maze.txt" cell 4
contains w is walker along 0 0 to 10 0 to 10 10 speed low
contains i is item size low to high by step count n
contains i is item at side 4 when -side > 0 and far < 2 or far > b
contains i is item size 2 at 5 -4 or -5 +far or +side 0 count 2
contains w is walker along 0 0 to 10 0 or 0 5 to 10 5 from anywhere
contains w is walker within ring when far > 1/2
contains w is walker within -5 -4 to 5 0 speed low
rewards 5 on delivery of a.key to home within 5 s of reach of button by foe when x > 2
ends on 3 collision within soon of visit of patch size 4
counts success within 2.5 s of its end
opens within on reach of within within 3 ticks of leave of within
teaches A on B until 3 reach of ball within 2 s of collision for at most 9 generations
teaches A on B for 9 generations patience 2 generations needs 5 reach of ball within low of leave of b
draws side from -14 14
draws far from 2 to low
teaches A on B for few from C population 3
lasts long"""


STOPS = """\
stop on collision
stop on 3 delivery of red to home  # the third
  stop on fault of front_eye
stop on visit of patch size 4
stop when holding > 0.5 and Avoid influences left_wheel above 70%
stop when walls.A+B influences Go below limit or -(a - b) * c < least of a 1 (1 - c)
stop when a.b >= 1/2 and Go influences walls.mood above 5 %
stop on 2 delivery of red within 9 ticks of collision
stop in tick 812
stop in tick late"""


def check(line: str, start: Start = "line") -> int:
    """Hold a line against the grammar; how many of its characters are of a token. UnexpectedInput where it is none."""
    code = code_of(line)
    coloured = scopes(COLOURS, line)
    wanted = expected(code, start) if code else {}
    for at, scope in wanted.items():
        assert f"{coloured[at]}.".startswith(f"{scope}."), (line, line[at:], coloured[at], scope)
    for at in range(len(code), len(line)):
        assert line[at].isspace() or coloured[at].startswith("comment"), line
    return len(wanted)


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.stem)
def test_every_token_of_every_example(path: Path) -> None:
    lines = path.read_text(encoding="utf-8").splitlines()
    assert sum(check(line) for line in lines) > sum(len(code_of(line).replace(" ", "")) for line in lines) * 0.9


@pytest.mark.parametrize("line", ODD.split("\n"))
def test_odd_lines(line: str) -> None:
    assert check(line)


@pytest.mark.parametrize("line", STOPS.split("\n"))
def test_breakpoints(line: str) -> None:
    assert check(line, "stop")


def test_every_readable_line_of_the_tests() -> None:
    read = 0
    for line in dict.fromkeys(line for path in OTHERS for line in path.read_text(encoding="utf-8").split("\n")):
        try:
            read += bool(check(line.rstrip("\r")))
        except UnexpectedInput:
            continue
    assert read > 150


def test_a_wrong_colour_is_found() -> None:
    colourless = {**COLOURS, "patterns": COLOURS["patterns"][1:]}
    assert scopes(colourless, "tick 1/60 s  # slow")[-1] != scopes(COLOURS, "tick 1/60 s  # slow")[-1]


def test_a_line_that_is_being_written_has_its_colours() -> None:
    for word in (*words_of("Nouns"), *words_of("Settings"), *words_of("Verbs"), "stop"):
        assert scopes(COLOURS, f"  {word}")[2].split(".")[0] in ("storage", "keyword"), word
        assert scopes(COLOURS, f"  {word} ")[2]


def test_the_words_of_the_language_are_explained() -> None:
    from mindlang.compiler import syntax

    assert set(words_of("Nouns")) == set(syntax.NOUNS)
    assert set(words_of("Verbs")) == set(syntax.VERBS)
    assert set(words_of("Settings")) == set(syntax.SETTINGS)
