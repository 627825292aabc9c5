"""Which fixes are made together: those that keep clear of one another; the others after another look."""

import pytest

from mindlang.compiler.diagnostic import Diagnostic, Fix
from mindlang.compiler.source import Source, Splice
from mindlang.lint.lint import apply_safe_fixes

TEXT = "abcdef"


def looks(*spans: tuple[int, int, str], safe: bool = True) -> tuple[str, int, int]:
    """The text, the number of fixes and of looks, where the first look finds fixes at these spans and then nothing."""
    looked = 0

    def look(source: Source) -> list[Diagnostic]:
        nonlocal looked
        looked += 1
        if looked > 1:
            return []
        splices = [Splice(source, start, end, text) for start, end, text in spans]
        return [Diagnostic("x", "y", fix=Fix("z", (splice,), safe)) for splice in splices]

    source, made = apply_safe_fixes(Source("a.mind", TEXT), look)
    return source.text, made, looked


def test_those_that_keep_clear_are_made_at_once() -> None:
    assert looks((0, 1, "A"), (3, 4, "D")) == ("AbcDef", 2, 2)


@pytest.mark.parametrize("other", [(1, 2, "B"), (0, 1, "X"), (0, 0, "X"), (1, 1, "X"), (0, 2, "X")])
def test_one_that_touches_another_waits(other: tuple[int, int, str]) -> None:
    """Also one that begins where the other ends: what is between them may be what both are about."""
    assert looks((0, 1, "A"), other) == ("Abcdef", 1, 2)
    assert looks((3, 4, "D"), (2, 3, "C")) == ("abcDef", 1, 2)


def test_unsafe_ones_are_not_made() -> None:
    assert looks((0, 1, "A"), safe=False) == (TEXT, 0, 1)


def test_fixes_that_never_end_are_given_up() -> None:
    source, made = apply_safe_fixes(
        Source("a.mind", ""), lambda source: [Diagnostic("x", "y", fix=Fix("z", (Splice(source, 0, 0, "a"),)))]
    )
    assert 50 <= made <= 200
    assert source.text == "a" * made
