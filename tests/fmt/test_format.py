"""The formatter sets spaces and blank lines, and nothing else: idempotent, with the same meaning and comments."""

import re
from pathlib import Path
from random import Random
from typing import Any

import pytest
from msgspec import Struct
from msgspec.structs import astuple

from mindlang.compiler.comparison import mind_differences
from mindlang.compiler.compile import compile_source
from mindlang.compiler.diagnostic import Findings
from mindlang.compiler.format import formatted
from mindlang.compiler.parse import parse
from mindlang.compiler.source import Source, Span
from tests.draws import cases as cases_drawn
from tests.language.examples import EXAMPLES, RIGHT

TEXTS = [path.read_text(encoding="utf-8") for path in (RIGHT, *EXAMPLES)]
CASES = Path(__file__).with_name("cases.txt")


def meaning(text: str) -> Any:
    """What a text says, without its places; None where a line of it cannot be read."""
    findings = Findings()
    file = parse(Source("text", text), findings)
    return None if findings.diagnostics else plain((file.settings, file.declarations))


def plain(node: Any) -> Any:
    if isinstance(node, tuple):
        return tuple(map(plain, node))
    if isinstance(node, Struct):
        return (type(node).__name__, *(plain(value) for value in astuple(node) if not isinstance(value, Span)))
    return repr(node)


def comments(text: str) -> list[str]:
    return [found.strip() for found in re.findall(r"^(?:\"[^\"]*\"|[^#\n])*(#.*)$", text, flags=re.M)]


def holds(text: str) -> None:
    """What must hold of any text."""
    tidy = formatted(text)
    assert formatted(tidy) == tidy
    assert meaning(tidy) == meaning(text)
    assert comments(tidy) == comments(text)
    assert not re.search(r"[ \t]\r?$", tidy, flags=re.M)
    assert "\n\n\n" not in tidy.replace("\r", "")


@pytest.mark.parametrize("text", TEXTS, ids=[path.name for path in (RIGHT, *EXAMPLES)])
def test_the_examples_are_tidy(text: str) -> None:
    assert formatted(text) == text


def untidy(line: str, rng: Random) -> str:
    """A line with other spaces between its words, before and behind them."""
    code, mark, comment = line.partition("#")
    words = [rng.choice((" ", "  ", "\t ")).join(code.split())]
    indent = " \t"[: rng.randrange(3)] if code.strip() or line[:1].isspace() else ""
    indent = indent or " " * (not code.strip() and line[:1].isspace())
    end = rng.choice(("", " ", "\t"))
    return f"{indent}{words[0]}{rng.choice(('', ' ', chr(9))) if code.strip() else ''}{mark}{comment}{end}"


def test_spaces_are_restored() -> None:
    rng = Random(1)
    for _ in range(cases_drawn(500)):
        text, end = rng.choice(TEXTS), rng.choice(("\n", "\r\n"))
        lines = [untidy(line, rng) for line in text.removesuffix("\n").split("\n")]
        assert formatted(end.join(lines)) == text.replace("\n", end)


def test_whatever_it_is_given() -> None:
    rng = Random(1)
    for _ in range(cases_drawn(750)):
        holds(spoilt(rng))


def spoilt(rng: Random) -> str:
    """An example of which some lines are others, gone, or elsewhere."""
    lines = rng.choice(TEXTS).split("\n")
    for _ in range(rng.randrange(1, 9)):
        at = rng.randrange(len(lines))
        match rng.randrange(6):
            case 0:
                lines.insert(at, rng.choice(("", "  ", "# a comment", "   # in", "\t#", "#")))
            case 1:
                del lines[at]
            case 2:
                lines[at] = f"\t{lines[at]}  # end"
            case 3:
                lines[at] = lines[at].replace(" ", "", 1)
            case 4:
                lines[at] = re.sub(r" ([-+*/<>]) ", r"\1", lines[at])
            case 5:
                lines[at], lines[0] = lines[0], lines[at]
        lines = lines or [""]
    return "\n".join(lines)


def cases() -> list[tuple[str, str, str]]:
    """Title, before and after."""
    _, *blocks = re.split(r"^==== (.*)\n", CASES.read_text(encoding="utf-8"), flags=re.M)
    pairs = (block.partition("---->\n") for block in blocks[1::2])
    return [
        (title, before, after.rstrip("\n") + "\n") for title, (before, _, after) in zip(blocks[::2], pairs, strict=True)
    ]


@pytest.mark.parametrize(("title", "before", "after"), cases(), ids=lambda text: text[:40] if " " in text else "")
def test_cases(title: str, before: str, after: str) -> None:
    assert formatted(before) == after
    holds(before)


def test_nothing_is_nothing() -> None:
    assert formatted("") == formatted("\n\n") == formatted(" \r\n") == ""


GLUED = """
tick 1/60s
master Go
body Robot is disc
actuator left_wheel is wheel side left neutral 0.5
sensor eye is range_finder at 0deg
skill Go is mlp
  reads eye
  drives left_wheel
task Course in arena
  lasts 20ticks
  rewards forward*2 per tick when eye >0.5
curriculum School is genetic
  teaches Go on Course for 10generations
"""


def test_blanks_alone_make_no_difference() -> None:
    """What is glued means what it means with its blanks: in the graph, in a diff, and in a message."""
    glued, spaced = (compile_source(Source("test.mind", text)) for text in (GLUED, formatted(GLUED)))
    assert glued.mind, glued.diagnostics
    assert spaced.mind
    assert glued.graph == spaced.graph
    assert not mind_differences(glued.mind, spaced.mind)
    bad = [f"{blanks}] {'9' * 397}\n" for blanks in ("", "  ")]  # a longer line is no common mistake
    codes = [compile_source(Source("test.mind", text)).diagnostics[0].code for text in bad]
    assert codes == ["braces", "braces"]
