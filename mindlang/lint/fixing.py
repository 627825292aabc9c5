"""Fixes made: splices of the source, as many as do not overlap, until none is left."""

from bisect import bisect_right, insort
from collections.abc import Callable, Iterable

from mindlang.compiler.diagnostic import Diagnostic
from mindlang.compiler.source import Source
from mindlang.compiler.splice import Splice, spliced

MAX_FIX_ROUNDS = 100  # a fix may make room for another
MAX_FIXED_CHARACTERS = 4 << 20  # that are looked at in all rounds: what is left of a long file is for the next time


def fixed(source: Source, look: Callable[[Source], Iterable[Diagnostic]]) -> tuple[Source, int]:
    """A source with all safe fixes made of what `look` finds in it, and how many those were."""
    from dataclasses import replace

    made = 0
    for _ in range(min(MAX_FIX_ROUNDS, MAX_FIXED_CHARACTERS // max(len(source.text), 1) + 1)):
        splices, number = _first(source, look(source))
        if not number:
            break
        source = replace(source, text=spliced(source, splices))
        made += number
    return source, made


def _first(source: Source, found: Iterable[Diagnostic]) -> tuple[list[Splice], int]:
    """The splices of the fixes that keep clear of one another."""
    chosen: list[Splice] = []  # in order
    number = 0
    for fix in (each.fix for each in found if each.fix and each.fix.is_safe):
        own = [splice for splice in fix.splices if splice.source is source]
        if len(own) == len(fix.splices) and not any(_touches(splice, chosen) for splice in own):
            for splice in own:
                insort(chosen, splice, key=_start)
            number += 1
    return chosen, number


def _touches(splice: Splice, chosen: list[Splice]) -> bool:
    """Whether a splice meets one of those that are chosen, which are in order and clear of one another."""
    place = bisect_right(chosen, splice.end, key=_start)
    return place > 0 and chosen[place - 1].end >= splice.start


def _start(splice: Splice) -> int:
    return splice.start
