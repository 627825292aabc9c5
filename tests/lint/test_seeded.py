"""Mistakes seeded into good programs: each is reported on its line, nearly always."""

import re
from collections.abc import Callable
from random import Random

import pytest

from mindlang.compiler.compile import compile_source
from mindlang.compiler.source import Source
from mindlang.compiler.syntax import NOUNS, VERBS
from mindlang.lint.lint import lint
from tests.language.examples import COLLECT, EXAMPLES

CASES, SHARE = 200, 0.99
PROGRAMS = [path for path in EXAMPLES if path.name in ("collect.mind", "braitenberg.mind")]
VERB = re.compile(rf"^(\s+)({'|'.join(VERBS)}) ")

Seed = Callable[[str, Random], str | None]  # a line with a mistake in it; None where this mistake cannot be made there


def forgotten_verb(line: str, rng: Random) -> str | None:
    return VERB.sub(r"\1", line) if VERB.match(line) else None


def misspelt_verb(line: str, rng: Random) -> str | None:
    found = VERB.match(line)
    return line.replace(found[2], misspelt(found[2], rng), 1) if found else None


def misspelt_noun(line: str, rng: Random) -> str | None:
    noun = line.split(" ")[0]
    return line.replace(noun, misspelt(noun, rng), 1) if noun in NOUNS else None


def misspelt_name(line: str, rng: Random) -> str | None:
    found = re.match(r"\s+(reads|drives|influences|teaches) (\S+)", line)
    return line.replace(f" {found[2]}", f" {misspelt(found[2], rng)}", 1) if found else None


def misspelt_kind(line: str, rng: Random) -> str | None:
    found = re.match(r"\w+ \S+ (is|in) (\w+)", line)
    return f"{line[: found.start(2)]}{misspelt(found[2], rng)}{line[found.end(2) :]}" if found else None


def missing_is(line: str, rng: Random) -> str | None:
    return re.sub(r"^(\w+ \S+) (is|in) ", r"\1 ", line) if re.match(r"\w+ \S+ (is|in) ", line) else None


def comma(line: str, rng: Random) -> str | None:
    found = re.search(r"\d( )\d", line)
    return f"{line[: found.start(1)]}, {line[found.end(1) :]}" if found else None


def colon(line: str, rng: Random) -> str | None:
    return f"{line}:" if line.split(" ")[0] in NOUNS and "#" not in line else None


def equals(line: str, rng: Random) -> str | None:
    found = re.search(r" \w+( )\d", line) if line.split(" ")[0] in NOUNS else None
    return f"{line[: found.start(1)]}={line[found.end(1) :]}" if found else None


def two_facts(line: str, rng: Random) -> str | None:
    return f"{line} reads pulse" if re.match(r"\s+reads \w+$", line) else None


def twice(line: str, rng: Random) -> str | None:
    return f"{line}\n{line}" if re.match(r"\s+(reads|drives|influences) ", line) else None


def wrong_unit(line: str, rng: Random) -> str | None:
    return (
        line.replace(" deg", " s", 1) if " deg" in line else line.replace(" ticks", " deg") if "lasts" in line else None
    )


def no_unit(line: str, rng: Random) -> str | None:
    return re.sub(r" (deg|generations)\b", "", line) if re.search(r" (deg|generations)\b", line) else None


def no_neutral(line: str, rng: Random) -> str | None:
    return re.sub(r" neutral \S+", "", line) if " neutral " in line else None


def unknown_argument(line: str, rng: Random) -> str | None:
    return f"{line} colour 3" if re.match(r"(sensor|actuator|body) ", line) and "#" not in line else None


def wrong_case(line: str, rng: Random) -> str | None:
    found = re.match(r"(\w+) ([a-zA-Z]\S*) (is|in) ", line)
    return line.replace(f" {found[2]} ", f" {found[2][0].swapcase()}{found[2][1:]} ", 1) if found else None


SEEDS: tuple[Seed, ...] = (
    forgotten_verb, misspelt_verb, misspelt_noun, misspelt_name, misspelt_kind, missing_is, comma, colon, equals,
    two_facts, twice, wrong_unit, no_unit, no_neutral, unknown_argument, wrong_case,
)  # fmt: skip


def misspelt(word: str, rng: Random) -> str:
    """A word with a letter doubled, left out, changed or moved."""
    at = rng.randrange(1, len(word)) if len(word) > 1 else 0
    match rng.randrange(4):
        case 0:
            return word[:at] + word[at] + word[at:]
        case 1 if len(word) > 3:
            return word[:at] + word[at + 1 :]
        case 2:
            return f"{word[:at]}q{word[at + 1 :]}"
    return f"{word}x"


def seeded(seed: int) -> tuple[str, str, int]:
    """The name of a mistake, a program with it, and the line on which it stands, counted from 1."""
    rng = Random(seed)
    while True:
        text = rng.choice(PROGRAMS).read_text(encoding="utf-8")
        lines = text.split("\n")
        number, seed_ = rng.randrange(len(lines)), rng.choice(SEEDS)
        bad = seed_(lines[number], rng) if lines[number] and not lines[number].lstrip().startswith("#") else None
        if bad is not None and bad != lines[number]:
            at = number + 1 + bad.count("\n")
            return seed_.__name__, "\n".join([*lines[:number], bad, *lines[number + 1 :]]), at


def reported(text: str) -> set[int]:
    """The lines on which something is found."""
    found = lint(compile_source(Source(COLLECT.name, text, COLLECT.parent)))
    return {each.span.line for each in found if each.span}


def missed(seeds: range) -> list[str]:
    """The mistakes that are not reported where they stand."""
    cases = (seeded(seed) for seed in seeds)
    return [f"{name}: {text.splitlines()[at - 1]}" for name, text, at in cases if at not in reported(text)]


@pytest.mark.parametrize("chunk", range(2))
def test_mistakes_are_reported_where_they_stand(chunk: int) -> None:
    size = CASES // 2
    found = missed(range(chunk * size, (chunk + 1) * size))
    assert len(found) <= size * (1 - SHARE), found


def test_the_programs_are_good() -> None:
    for path in PROGRAMS:
        assert not reported(path.read_text(encoding="utf-8")), path
