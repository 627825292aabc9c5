"""Selects the lint rules for each file, by the command line and `mind.toml`.

A `mind.toml` is for the files in its folder and below, where no other one is nearer.

What is wrong in it is a diagnostic on its line, and does not count.
"""

import os
import re
import tomllib
from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass, field
from fnmatch import fnmatchcase
from pathlib import Path
from typing import Any

from mindrun.errors import reason
from mindrun.files.regular_files import read_regular

from mindlang.compiler.diagnostic import ERRORS, Diagnostic, did_you_mean, listed
from mindlang.compiler.source import MAX_SOURCE_BYTES, Source, Span, decode_source
from mindlang.files import folders_above, name_from_here
from mindlang.lint.rules import all_rules

SETTINGS_NAME = "mind.toml"
SECTION, PER_FILE = "lint", "per-file-ignores"
KEYS = ("select", "ignore", PER_FILE)
EXAMPLE_CODES = '["untaught-skill"]'


@dataclass(frozen=True, slots=True)
class LintSettings:
    """Rules that are held (all where none is said), those that are not, and by patterns of paths those not held there.

    `wrong` is what is wrong in the file of settings; what is wrong in it does not count.
    """

    folder: Path = Path()
    select: tuple[str, ...] = ()
    ignore: tuple[str, ...] = ()
    per_file: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    wrong: tuple[Diagnostic, ...] = ()

    def codes(self, path: Path, select: Collection[str] = (), ignore: Collection[str] = ()) -> list[str]:
        """The rules that are held in a file: what a command line selects replaces both lists, what it ignores adds."""
        left_out = {*ignore, *(() if select else self.ignore), *self._ignored_in(path)}
        return [code for code in (select or self.select or all_rules()) if code not in left_out]

    def _ignored_in(self, path: Path) -> Iterator[str]:
        """The codes ignored in a file; a pattern fits its path from the folder of the settings, or its name alone."""
        name = path.relative_to(self.folder).as_posix() if path.is_relative_to(self.folder) else path.name
        for pattern, codes in self.per_file.items():
            if fnmatchcase(name, pattern) or fnmatchcase(path.name, pattern):
                yield from codes


def settings_of(path: Path) -> LintSettings:
    """The settings that count for a file, those of the nearest `mind.toml`; its path is absolute."""
    found = (folder / SETTINGS_NAME for folder in folders_above(path))
    return next((_read(each) for each in found if os.access(each, os.F_OK) and each.is_file()), LintSettings())


def why_no_rule(code: str) -> tuple[str, str] | None:
    """Why a code cannot be selected or ignored, and what may have been meant; None where it can."""
    if code in all_rules():
        return None
    if f"\n## {code}\n" in ERRORS.read_text(encoding="utf-8"):
        return f"{code} is an error, not a rule: errors are always reported.", ""
    return f"There is no rule called {code}.", did_you_mean(code, all_rules()) or "mindc explain lists them."


def _read(path: Path) -> LintSettings:
    name = name_from_here(path)
    try:
        source = Source(name, decode_source(read_regular(path, MAX_SOURCE_BYTES + 1)), path.parent)
    except (OSError, ValueError) as error:
        message = f"{name} cannot be read: {reason(error)}."
        return LintSettings(wrong=(Diagnostic("unreadable-settings", message, None, "It is a text in TOML."),))
    return _Reading(source).settings()


@dataclass(slots=True)
class _Reading:
    """One file of settings, read from its beginning to its end; `at` is how far."""

    source: Source
    at: int = 0
    wrong: list[Diagnostic] = field(default_factory=list)

    def settings(self) -> LintSettings:
        """The settings that the file has, and the diagnostics of what is wrong in it."""
        try:
            said = tomllib.loads(self.source.text)
        except (tomllib.TOMLDecodeError, RecursionError) as error:
            self._no_toml(error)
            said = {}
        for name in (name for name in said if name != SECTION):
            self._unknown(name, (SECTION,), "section")
        found = self._keys(said.get(SECTION, {}))
        in_order = sorted(self.wrong, key=lambda each: each.span.start if each.span else 0)
        return LintSettings(self.source.folder, **found, wrong=tuple(in_order))

    def _keys(self, lint: Any) -> dict[str, Any]:
        found: dict[str, Any] = {}
        if not isinstance(lint, dict):
            self._refuse("wrong-setting", SECTION, f"{SECTION} is a section.", f"Write [{SECTION}].")
            return found
        for key, value in lint.items():
            match key:
                case "select" | "ignore":
                    found[key] = self._rules(key, value)
                case "per-file-ignores" if isinstance(value, dict):
                    found["per_file"] = {pattern: self._rules(pattern, codes) for pattern, codes in value.items()}
                case "per-file-ignores":
                    hint = f'Write [{SECTION}.{PER_FILE}], and below it "drafts/*" = {EXAMPLE_CODES}.'
                    self._refuse("wrong-setting", key, f"{key} is a section of patterns.", hint)
                case _:
                    self._unknown(key, KEYS, "setting")
        return found

    def _rules(self, key: str, value: object) -> tuple[str, ...]:
        if not isinstance(value, list) or not all(isinstance(code, str) for code in value):
            written = key if key in KEYS else f'"{key}"'
            self._refuse("wrong-setting", key, f"{key} is a list of codes.", f"Write {written} = {EXAMPLE_CODES}.")
            return ()
        if key == "select" and not value:
            self._refuse("wrong-setting", key, "select names no rule.", "Leave it out: then all rules are held.")
        for code in value:
            if why := why_no_rule(code):
                self._refuse("unknown-rule", code, *why)
        return tuple(code for code in value if code in all_rules())

    def _unknown(self, word: str, known: tuple[str, ...], what: str) -> None:
        hint = did_you_mean(word, known) or f"There {'is only' if len(known) == 1 else 'are'} {listed(known, 'and')}."
        self._refuse("unknown-setting", word, f"There is no {what} called {word}.", hint)

    def _refuse(self, code: str, word: str, message: str, hint: str) -> None:
        self.wrong.append(Diagnostic(code, message, self._place(word), hint))

    def _place(self, word: str) -> Span:
        """Where a word stands, behind what was found before: TOML's values are in the order of the text, mostly."""
        places = _places(self.source.text, word)
        start = next((place for place in places if place >= self.at), next(iter(places), 0))
        self.at = start + len(word)
        return Span(self.source, start, self.at)

    def _no_toml(self, error: Exception) -> None:
        """Tell of a text that is no TOML; the place stands at the end of Python's message only."""
        why, _, place = str(error).partition(" (at ")
        numbers = [int(number) for number in re.findall(r"\d+", place)]
        starts = [0, *(found.end() for found in re.finditer("\n", self.source.text))]
        end = len(self.source.text)
        start = min(starts[numbers[0] - 1] + numbers[1] - 1, end) if len(numbers) == 2 else max(0, end - 1)
        span = Span(self.source, start, min(start + 1, end))
        message = f"This is no TOML: {why[:1].lower()}{why[1:]}."
        self.wrong.append(Diagnostic("unreadable-settings", message, span, "Mend the line."))


def _places(text: str, word: str) -> list[int]:
    """The offsets at which a word stands by itself in a text, not in a comment."""
    found = (each.start() for each in re.finditer(rf"(?<![\w-]){re.escape(word)}(?![\w-])", text))
    return [place for place in found if "#" not in text[text.rfind("\n", 0, place) + 1 : place]]
