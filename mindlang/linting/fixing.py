"""Fixes made: splices of the source, as many as do not overlap, until none is left."""

from collections.abc import Callable, Iterable

from mindlang.diagnostic import Diagnostic
from mindlang.source import Source
from mindlang.splice import Splice, spliced

ROUNDS = 100  # a fix may make room for another


def fixed(source: Source, look: Callable[[Source], Iterable[Diagnostic]]) -> tuple[Source, int]:
    """A source with all safe fixes made of what `look` finds in it, and how many those were."""
    from dataclasses import replace

    made = 0
    for _ in range(ROUNDS):
        splices, number = _first(source, look(source))
        if not number:
            break
        source = replace(source, text=spliced(source, splices))
        made += number
    return source, made


def _first(source: Source, found: Iterable[Diagnostic]) -> tuple[list[Splice], int]:
    """The splices of the fixes that keep clear of one another."""
    chosen: list[Splice] = []
    number = 0
    for fix in (each.fix for each in found if each.fix and each.fix.is_safe):
        own = [splice for splice in fix.splices if splice.source is source]
        if len(own) == len(fix.splices) and not any(_touch(a, b) for a in own for b in chosen):
            chosen += own
            number += 1
    return chosen, number


def _touch(a: Splice, b: Splice) -> bool:
    return a.start <= b.end and b.start <= a.end
