"""Ten thousand sources, none of them meant well: every one gets a graph or messages, and gets them soon."""

import re
import shutil
from functools import cache
from pathlib import Path
from random import Random

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from hypothesis.extra.lark import from_lark
from lark import UnexpectedInput

from benchmarks.call_count import one_in_eight
from mindlang.cli._diagnostic_printer import as_data, plain
from mindlang.compiler.compile import Compiled, compile_source, load
from mindlang.compiler.diagnostic import Findings
from mindlang.compiler.parse import parse
from mindlang.compiler.parse.build import build_line
from mindlang.compiler.parse.shape import grammar, parse_line, read_grammar
from mindlang.compiler.source import Source
from tests.draws import cases
from tests.language.examples import EXAMPLES, RIGHT, TOUR

SEEDS = [RIGHT, *EXAMPLES]
WORD = re.compile(rb"\w+|\s+|.", re.DOTALL)
MOST_CALLS = 3_000_000  # what is drawn here takes 300,000 at most: ten times as many is another order of work

relaxed = settings(max_examples=cases(500), suppress_health_check=list(HealthCheck), database=None, derandomize=True)


def sane(found: Compiled) -> None:
    """What must hold of any result: a graph or errors, and messages that can be printed."""
    of_procedures = {each.code for each in found.diagnostics} == {"faulty-procedure"}
    assert (found.graph is None) == (bool(found.diagnostics) and not of_procedures)
    for diagnostic in found.diagnostics[:20]:
        assert plain(diagnostic).isprintable() or "\n" in plain(diagnostic)
        assert as_data(diagnostic)["code"]


@pytest.fixture
def project(tmp_path: Path) -> Path:
    """A folder in which the used file of the tour is found."""
    shutil.copy(TOUR.with_name("parts.mind"), tmp_path)
    return tmp_path


def flip(data: bytes, rng: Random) -> bytes:
    at = rng.randrange(len(data))
    return data[:at] + bytes([data[at] ^ 1 << rng.randrange(8)]) + data[at + 1 :]


def delete(data: bytes, rng: Random) -> bytes:
    words = WORD.findall(data)
    del words[rng.randrange(len(words))]
    return b"".join(words)


def duplicate(data: bytes, rng: Random) -> bytes:
    words = WORD.findall(data)
    at = rng.randrange(len(words))
    return b"".join([*words[:at], words[at], b" " * rng.randrange(2), *words[at:]])


def swap_lines(data: bytes, rng: Random) -> bytes:
    lines = data.split(b"\n")
    one, other = rng.randrange(len(lines)), rng.randrange(len(lines))
    lines[one], lines[other] = lines[other], lines[one]
    return b"\n".join(lines)


def splice(data: bytes, rng: Random) -> bytes:
    other = rng.choice(SEEDS).read_bytes()
    start = rng.randrange(len(other))
    at = rng.randrange(len(data))
    return data[:at] + other[start : start + rng.randrange(200)] + data[at + rng.randrange(100) :]


def insert(data: bytes, rng: Random) -> bytes:
    at = rng.randrange(len(data))
    odd = ["\0", "(" * 99, "-" * 99, "\u202e", "9" * 999, '"', "1/0", "\r", "é", "\ufeff", "#", " at ", "\udfff", ","]
    return data[:at] + rng.choice(odd).encode("utf-8", "surrogatepass") + data[at:]


@pytest.mark.parametrize("chunk", range(4))
def test_mutations_of_the_examples(chunk: int, project: Path) -> None:
    path = project / "mutant.mind"
    for seed in range(cases(500)):
        rng = Random(1000 * chunk + seed)
        data = rng.choice(SEEDS).read_bytes()
        for _ in range(rng.randint(1, 4)):
            data = rng.choice((flip, delete, duplicate, swap_lines, splice, insert))(data, rng) or b" "
        path.write_bytes(data)
        with one_in_eight(seed, MOST_CALLS):
            sane(load(path))


@cache
def words() -> dict[str, st.SearchStrategy[str]]:
    """Names for the grammar's terminals: with those of the examples, what it makes has some meaning."""
    text = "\n".join(seed.read_text(encoding="utf-8") for seed in SEEDS)
    found = sorted(set(re.findall(r"(?<!\w)[A-Za-z][\w+]*", text)))
    return {
        "NAME": st.sampled_from([f" {word} " for word in found if word[0].islower()]),
        "TITLE": st.sampled_from([f" {word} " for word in found if word[0].isupper()]),
        "NUMBER": st.sampled_from([" 0", " 1", " 1/60", " 0.5", " 20", " 1/0"]),
        "UNIT": st.sampled_from([" s ", " deg ", " ticks ", " generations ", "% "]),
        "PART": st.sampled_from(["sensor", "actuator", "memory"]),
        "WHOLE": st.sampled_from(["body", "skill", "curriculum"]),
        "TASK": st.just("task"),
        "TEXT": st.sampled_from([' "parts.mind"', ' ""', ' "../x"', ' "/"']),
        "COMMENT": st.just(" "),
        "__IGNORE_0": st.just(" "),
    }


@cache
def from_grammar(start: str) -> st.SearchStrategy[str]:
    """Sources, or single lines, as the grammar makes them, with spaces between its own words."""
    ends = {"_NL": st.just("\n")} if start == "start" else {}
    made = from_lark(read_grammar(table=False), start=start, explicit=words() | ends)
    return made.map(
        lambda text: text.replace("pertick", "per tick ").replace("foreach", "for each").replace("endson", "ends on")
    )


PROGRAMS = st.deferred(lambda: from_grammar("start"))
LINES = st.deferred(lambda: from_grammar("line"))


@relaxed
@given(PROGRAMS)
def test_programs_from_the_grammar(text: str) -> None:
    with one_in_eight(len(text), MOST_CALLS):
        sane(compile_source(Source("fuzz.mind", text, Path(__file__).parent)))


@relaxed
@given(st.lists(LINES, min_size=1, max_size=3))
def test_lines_from_the_grammar_below_a_right_program(lines: list[str]) -> None:
    text = RIGHT.read_text(encoding="utf-8") + "\n".join(lines)
    with one_in_eight(len(text), MOST_CALLS):
        sane(compile_source(Source("fuzz.mind", text, Path(__file__).parent)))


def read_whole(text: str) -> bool:
    """Whether the grammar takes the text as one file."""
    try:
        grammar().parse(text + "\n", start="start")
    except UnexpectedInput:
        return False
    return True


@settings(relaxed, max_examples=cases(400))
@given(st.lists(LINES | st.sampled_from(RIGHT.read_text(encoding="utf-8").split("\n")), max_size=4))
def test_line_by_line_is_the_same_language_as_the_whole_file(lines: list[str]) -> None:
    text = "\n".join(lines)
    findings = Findings()
    parse(Source("fuzz.mind", text), findings)
    unread = [each for each in findings.diagnostics if not each.code.startswith("family-")]  # which can be read
    assert read_whole(text) == (not unread)


@pytest.mark.parametrize("seed", range(cases(300)))
def test_mutants_are_the_same_language_too(seed: int) -> None:
    rng = Random(seed)
    data = rng.choice((delete, duplicate, swap_lines))(RIGHT.read_bytes(), rng)
    text, findings = data.decode(), Findings()
    parse(Source("fuzz.mind", text), findings)
    assert read_whole(text) == (not findings.diagnostics)


NUMBER = re.compile(r"(?<![\w.])\d+(\.\d+)?(?![\w.])")
TINY, HUGE = "0." + "0" * 322 + "5", "17" + "0" * 306


@pytest.mark.parametrize("size", [TINY, HUGE], ids=["tiny", "huge"])
def test_a_number_of_any_size_stands_anywhere(size: str) -> None:
    text = TOUR.read_text(encoding="utf-8")
    for number in NUMBER.finditer(text):
        sane(compile_source(Source("fuzz.mind", text[: number.start()] + size + text[number.end() :])))


@pytest.mark.parametrize(
    ("example", "said"), [("tour/tour", "number broken is 1/0"), ("soccer/soccer", "number broken is nothing")]
)
def test_a_number_that_is_declared_wrongly_stands_anywhere(example: str, said: str) -> None:
    path = TOUR.parents[1] / f"{example}.mind"
    text = path.read_text(encoding="utf-8")
    for number in NUMBER.finditer(text):
        broken = f"{text[: number.start()]}broken{text[number.end() :]}\n{said}\n"
        sane(compile_source(Source("fuzz.mind", broken, path.parent)))


ODD = ' \t .+-*/%()<>=_09azAZ"é٣ǅ,'
WORDS = "s deg 10s 5_ a.b sensor.x s.x 1.5.2 1/2/3 2e3 Go+ +Go on at to"


def same_as_lark(code: str) -> None:
    """What the shape of a line makes of it is what Lark makes of the line itself."""
    source = Source("line", f"?? {code}")
    try:
        expected = repr(build_line(grammar().parse(code, start="line"), source, 3))
    except UnexpectedInput:
        with pytest.raises(UnexpectedInput):
            parse_line(code, source, 3)
    else:
        assert repr(parse_line(code, source, 3)) == expected


@settings(relaxed, max_examples=cases(300))
@given(LINES)
def test_lines_of_one_shape_have_one_tree(code: str) -> None:
    same_as_lark(code)


@pytest.mark.parametrize("chunk", range(3))
def test_mutants_of_one_shape_have_one_tree(chunk: int) -> None:
    lines = [line.partition("#")[0] for seed in SEEDS for line in seed.read_text(encoding="utf-8").split("\n")]
    rng = Random(chunk)
    for code in rng.choices([line for line in lines if line.strip()], k=cases(1500)):
        for _ in range(rng.randrange(4)):
            at = rng.randrange(len(code) + 1)
            code = code[:at] + rng.choice([*ODD, *WORDS.split()]) + code[at + rng.randrange(3) :]
        same_as_lark(code)


def test_what_is_broken_in_a_mind_without_skills_is_reported() -> None:
    sane(compile_source(Source("fuzz.mind", "sensor east is broken No\n")))
