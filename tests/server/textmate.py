"""An interpreter of TextMate grammars that have `match` rules alone, as an editor would run them."""

import json
import re
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from typing import Any

Rule = dict[str, Any]


class Grammar:
    """A grammar read from its file."""

    def __init__(self, path: Path) -> None:
        self.data: Rule = json.loads(path.read_text(encoding="utf-8"))

    def scopes(self, line: str) -> list[str]:
        """The innermost scope of each character of a line; nothing where there is none."""
        found = [""] * len(line)
        self._run(self.data, line, 0, len(line), found)
        return found

    def rules(self, rule: Rule) -> Iterator[Rule]:
        """The `match` rules of a list of patterns, includes followed."""
        for pattern in rule["patterns"]:
            each = self.data["repository"][pattern["include"][1:]] if "include" in pattern else pattern
            assert "begin" not in each
            if "match" in each:
                yield each
            else:
                yield from self.rules(each)

    def _run(self, rule: Rule, line: str, start: int, end: int, found: list[str]) -> None:
        """Leftmost match first, of several the one whose rule stands first; what lies behind `end` is not seen."""
        rules = list(self.rules(rule))
        while start < end:
            matches = [(match, each) for each in rules if (match := _pattern(each["match"]).search(line[:end], start))]
            if not matches:
                return
            match, best = min(matches, key=lambda each: each[0].start())
            assert match.end() > match.start(), f"an empty match of {best['match']}"
            self._paint(match, best, line, found)
            start = match.end()

    def _paint(self, match: re.Match[str], rule: Rule, line: str, found: list[str]) -> None:
        if "name" in rule:
            found[match.start() : match.end()] = [rule["name"]] * (match.end() - match.start())
        for number, capture in rule.get("captures", {}).items():
            first, last = match.span(int(number))
            if first < 0:
                continue
            if "name" in capture:
                found[first:last] = [capture["name"]] * (last - first)
            if "patterns" in capture:
                self._run(capture, line, first, last, found)


@cache
def _pattern(text: str) -> re.Pattern[str]:
    return re.compile(text)
