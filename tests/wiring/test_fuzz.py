"""YAML that is not meant well: every text gets a wiring or messages, and gets them soon."""

from functools import cache
from itertools import pairwise
from pathlib import Path
from random import Random

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from mindrun.graph.graph import Graph

from benchmarks.call_count import CallCount, one_in_eight
from mindlang.cli._diagnostic_printer import as_data, plain
from mindlang.compiler.compile import load
from mindlang.compiler.source import Source
from mindlang.robot.read import surprise
from mindlang.robot.wire import Checked, check_wiring, load_wiring
from tests.draws import cases
from tests.language.test_fuzz import delete, duplicate, flip, swap_lines

HERE = Path(__file__).parent
SEEDS = [HERE / "right.yaml", *sorted((HERE / "wrong").glob("*.yaml"))]
MOST_CALLS = 300_000  # a mutant takes 30,000 at most: ten times as many is another order of work
MOST_CALLS_A_LETTER = 60  # of a long text, whose work is to grow as it does
ODD = ["\0", "[" * 99, "{a: " * 9, "&a ", "*a", "!!python/name:os.system ", "<<: ", "\t", "\r", "é", "\ufeff", "\u2028"]
ODD += [
    '"',
    "'",
    "|\n",
    "? ",
    "- ",
    ": ",
    "#",
    "%",
    "---\n",
    "...\n",
    "1e999",
    "9" * 400,
    "0x",
    "\x85",
    "\U0010ffff",
    "@",
    "~",
]
ODD += [
    '"\\UFFFFFFFF"',
    '"\\ud800"',
    "1/0",
    "-" * 99,
    "12:30:45",
    ".nan",
    "\u202e",
    "0x" + "f" * 99,
    "1_" * 50,
    "%YAML 1.9\n",
]
BOMBS = {
    "laughs": "a: &a [x,x]\n" + "".join(f"{b}: &{b} [*{a},*{a},*{a},*{a}]\n" for a, b in pairwise("abcdefghij")),
    "nested lists": "[" * 50_000,
    "nested tables": "a: {b: " * 8_000,
    "nested lines": "".join(" " * i + "b:\n" for i in range(350)),
    "questions": "? " * 25_000,
    "dashes": "- " * 25_000,
    "anchors": "- &a x\n" * 2_500,
    "keys": "".join(f"k{i}: 1\n" for i in range(2_500)),
    "same key": "k: 1\n" * 2_500,
    "one word": "x" * 60_000,
    "one quote": '"' + "x " * 30_000,
    "one comment": "#" * 60_000,
    "empty lines": "\n" * 25_000,
    "digits": "robot: " + "9" * 60_000,
    "underscores": "robot: 1" + "_" * 60_000,
    "hexadecimal": "robot: 0x" + "f" * 60_000,
    "clock": "robot: 1" + ":1" * 30_000,
    "merges": "<<: [{a: 1}]\n" * 800,
    "unknown sensors": "robot: a\nsensors:\n" + "".join(f"  s{i}: {{driver: mok}}\n" for i in range(300)),
    "escapes": 'robot: "' + "\\x41" * 5_000 + '"',
}  # fmt: skip


@cache
def graph() -> Graph:
    found = load(HERE / "right.mind").graph
    assert found
    return found


def sane(checked: Checked) -> None:
    """What must hold of any result."""
    assert (checked.wiring is None) == bool(checked.diagnostics)
    for diagnostic in checked.diagnostics[:20]:
        assert plain(diagnostic).isprintable() or "\n" in plain(diagnostic)
        assert as_data(diagnostic)["hint"]


@pytest.mark.parametrize("name", BOMBS)
def test_bombs_are_refused_soon(name: str) -> None:
    with CallCount(MOST_CALLS + MOST_CALLS_A_LETTER * len(BOMBS[name])):
        checked = check_wiring(Source("bomb.yaml", BOMBS[name]), graph())
    assert checked.wiring is None
    sane(checked)


def insert(data: bytes, rng: Random) -> bytes:
    at = rng.randrange(len(data))
    return data[:at] + rng.choice(ODD).encode("utf-8", "surrogatepass") + data[at:]


def splice(data: bytes, rng: Random) -> bytes:
    other = rng.choice(SEEDS).read_bytes()
    start, at = rng.randrange(len(other)), rng.randrange(len(data))
    return data[:at] + other[start : start + rng.randrange(200)] + data[at + rng.randrange(100) :]


@pytest.mark.parametrize("chunk", range(4))
def test_mutations_of_the_examples(chunk: int, tmp_path: Path) -> None:
    path = tmp_path / "mutant.yaml"
    for seed in range(cases(250)):
        rng = Random(1000 * chunk + seed)
        data = rng.choice(SEEDS).read_bytes()
        for _ in range(rng.randint(1, 4)):
            data = rng.choice((flip, delete, duplicate, swap_lines, splice, insert))(data, rng) or b" "
        path.write_bytes(data)
        with one_in_eight(seed, MOST_CALLS):
            sane(load_wiring(path, graph()))


@settings(max_examples=cases(400), suppress_health_check=list(HealthCheck), database=None, derandomize=True)
@given(
    st.lists(
        st.sampled_from([*ODD, *(HERE / "right.yaml").read_text().split("\n"), " ", "\n", "robot: a\n"]), max_size=12
    )
)
def test_pieces_in_any_order(pieces: list[str]) -> None:
    sane(check_wiring(Source("pieces.yaml", "\n".join(pieces)), graph()))


@settings(max_examples=cases(400), database=None, derandomize=True)
@given(st.text(max_size=12) | st.from_regex(r"[-+]?[0-9_.:eox]{1,12}", fullmatch=True))
def test_any_word_is_surprising_or_not(text: str) -> None:
    found = surprise(text)
    assert found is None or all(found)


SURPRISES = """
yes no On OFF True FALSE ~ null 1e3 -1.5E-3 12:30 1:2:3 017 0o17 0b11 1_000 .5 5. +5 .inf -.INF .nan 2026-01-02
"""
PLAIN = "true false 0 -1 0.5 0x0f 20% 1/60 paper /dev/video0 a:b y n o x-1 1.2.3 e3 Oslo nobody"


@pytest.mark.parametrize("word", SURPRISES.split())
def test_what_versions_of_yaml_read_differently_is_refused(word: str) -> None:
    assert surprise(word)


@pytest.mark.parametrize("word", PLAIN.split())
def test_what_all_read_the_same_is_taken(word: str) -> None:
    assert surprise(word) is None
