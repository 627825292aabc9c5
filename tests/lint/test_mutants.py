"""Sources that nobody meant, through lint and fmt: findings or none, soon, and never anything else."""

import os
from pathlib import Path
from random import Random
from typing import NamedTuple

import pytest

from benchmarks.call_count import one_in_eight
from mindlang.cli._diagnostic_printer import plain
from mindlang.compiler.compile import compile_source
from mindlang.compiler.format import formatted
from mindlang.compiler.source import Source, decode_source
from mindlang.lint.lint import lint
from tests.fmt.test_format import comments, meaning
from tests.language.test_fuzz import SEEDS, delete, duplicate, flip, insert, splice, swap_lines

OFTEN, SELDOM = 100_000, 160  # in the slow suite, and in the other
MOST_CALLS = 3_000_000  # a mutant takes 300,000 at most: ten times as many is another order of work
HERE = Path(__file__).parent


class Tally(NamedTuple):
    """How many sources compiled, and how many could be read."""

    compiled: int
    read: int


def mutants(seeds: range) -> Tally:
    """Hold so many mutants of the examples; what may be among them is in `tests.language.test_fuzz`."""
    compiled = read = 0
    for seed in seeds:
        rng = Random(seed)
        data = rng.choice(SEEDS).read_bytes()
        for _ in range(rng.randint(1, 4)):
            data = rng.choice((flip, delete, duplicate, swap_lines, splice, insert))(data, rng) or b" "
        try:
            text = decode_source(data)
        except ValueError:
            continue
        with one_in_eight(seed, MOST_CALLS):
            compiled += linted(text)
            read += tidied(text)
    return Tally(compiled, read)


def linted(text: str) -> bool:
    """Whether a text compiles; it does or has errors, and every finding can be printed and stands in the text."""
    found = compile_source(Source("mutant.mind", text, HERE))
    said = lint(found)
    assert (found.graph is None) == any(each.severity == "error" for each in said)
    for each in said[:20]:
        assert each.message
        assert each.span is None or 0 <= each.span.start <= each.span.end <= len(each.span.source.text)
        assert all(line.isprintable() for line in plain(each).split("\n"))
    return found.graph is not None


def tidied(text: str) -> bool:
    """Whether a text can be read; then it is the same when it is tidy, and tidy when it is tidied."""
    tidy = formatted(text)
    if (means := meaning(text)) is None:
        return False
    assert formatted(tidy) == tidy, text
    assert meaning(tidy) == means, text
    assert comments(tidy) == comments(text)
    return True


def test_mutants() -> None:
    tally = mutants(range(SELDOM))
    assert tally.read > SELDOM / 20, "hardly any could be read"


@pytest.mark.slow
@pytest.mark.parametrize("chunk", range(20))
def test_many_mutants(chunk: int) -> None:
    size = int(os.environ.get("MUTANTS", OFTEN)) // 20
    tally = mutants(range(10**6 + chunk * size, 10**6 + (chunk + 1) * size))
    assert tally.compiled
