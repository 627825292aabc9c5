"""An interpreter of TextMate grammars that have `match` rules alone, as an editor would run them."""

import re
from collections.abc import Iterator
from typing import Any

Rule = dict[str, Any]


def scopes(grammar: Rule, line: str) -> list[str]:
    """The innermost scope of each character of a line; nothing where there is none."""
    found = [""] * len(line)
    _run(grammar, grammar, line, (0, len(line)), found)
    return found


def _rules(grammar: Rule, rule: Rule) -> Iterator[Rule]:
    """The `match` rules of a list of patterns, includes followed."""
    for pattern in rule["patterns"]:
        each = grammar["repository"][pattern["include"][1:]] if "include" in pattern else pattern
        yield from [each] if "match" in each else _rules(grammar, each)


def _run(grammar: Rule, rule: Rule, line: str, span: tuple[int, int], found: list[str]) -> None:
    """Leftmost match first, of several the one whose rule stands first; what lies behind the span is not seen."""
    start, end = span
    rules = list(_rules(grammar, rule))
    while matches := [(m, each) for each in rules if (m := re.compile(each["match"]).search(line[:end], start))]:
        match, best = min(matches, key=lambda each: each[0].start())
        for number, capture in {"0": best, **best.get("captures", {})}.items():
            first, last = match.span(int(number))
            if first >= 0 and "name" in capture:
                found[first:last] = [capture["name"]] * (last - first)
            if first >= 0 and number != "0" and "patterns" in capture:
                _run(grammar, capture, line, (first, last), found)
        start = match.end()
