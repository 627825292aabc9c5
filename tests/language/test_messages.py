"""Every mistake gets one message: `wrong/NAME.mind` has one mistake, `wrong/NAME.txt` is what mindc says of it.

After a change of words: UPDATE=1 pytest tests/language/test_messages.py, and read the difference.
"""

import os
from pathlib import Path

import pytest

from mindlang.cli._diagnostic_printer import plain
from mindlang.compiler.compile import compile_source, load
from mindlang.compiler.diagnostic import Diagnostic, Findings
from mindlang.compiler.parse import parse
from mindlang.compiler.parse.explain import common_mistakes
from mindlang.compiler.source import Source

HERE = Path(__file__).parent
CASES = sorted((HERE / "wrong").glob("*.mind"))
KNOWN = common_mistakes()


def test_one_message_for_one_mistake(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(HERE / "wrong")
    for path in CASES:
        compiled = load(path.name)
        said = "\n".join(plain(diagnostic) for diagnostic in compiled.diagnostics)
        expected = path.with_suffix(".txt")
        if os.environ.get("UPDATE"):
            expected.write_text(said, encoding="utf-8")
        assert said == expected.read_text(encoding="utf-8"), path.name
        assert compiled.graph is None, path.name
        assert [bool(diagnostic.hint) for diagnostic in compiled.diagnostics] == [True], path.name


def test_the_program_that_the_cases_change_is_right() -> None:
    assert load(HERE / "right.mind").diagnostics == ()


def said_of(text: str) -> tuple[Diagnostic, ...]:
    """What is said of lines as they are read."""
    findings = Findings()
    parse(Source("example", text), findings)
    return findings.diagnostics


def test_the_example_of_a_mistake_is_explained_by_it() -> None:
    for mistake in (*KNOWN.openings, *KNOWN.lines):
        found = said_of(mistake.example)
        assert [diagnostic.code for diagnostic in found] == [mistake.code], mistake.example
        assert found[0].hint, mistake.example
        assert "{" not in found[0].message + found[0].hint


def test_the_lines_that_hints_show_can_be_read() -> None:
    for lines in KNOWN.right.values():
        for line in lines.split(", or "):
            assert {each.code for each in said_of(f"skill Above is rule\n{line}")} <= {"homeless-fact"}, line


def test_what_people_write_for_a_word_is_answered_by_it() -> None:
    for known, words in KNOWN.foreign_words.items():
        for word in words.split():
            assert [(found.code, known in found.hint) for found in said_of(f"{word} something")] == [("no-verb", True)]


def test_no_word_of_the_language_is_one_that_people_write_for_another() -> None:
    assert {word for words in KNOWN.foreign_words.values() for word in words.split()} & set(KNOWN.right) == set()


def test_all_bad_lines_are_reported_in_one_go_and_without_echoes() -> None:
    text = (HERE / "right.mind").read_text(encoding="utf-8")
    text = (
        text.replace("sensor eyes is", "sensor eyes")
        .replace("  lasts 1000", "  last 1000")
        .replace("drives l", "drive l")
    )
    findings = Findings()
    parse(Source("right.mind", text), findings)
    assert [(diagnostic.code, diagnostic.span and diagnostic.span.line) for diagnostic in findings.diagnostics] == [
        ("missing-is", 8),
        ("no-verb", 14),
        ("no-verb", 24),
    ]


def test_what_stands_in_an_unread_line_is_not_said_to_be_missing() -> None:
    text = (HERE / "right.mind").read_text(encoding="utf-8")
    text = text.replace("skill Seek is", "behaviour Seek is").replace("actuator left", "motor left")
    compiled = compile_source(Source("right.mind", text))
    assert [(found.code, found.span and found.span.line) for found in compiled.diagnostics] == [
        ("no-verb", 5),
        ("no-verb", 12),
    ]


@pytest.mark.parametrize("line", ["\x0b", "\x0c ", "\u00a0", "\u2003\u3000", "\x85", "\u200b"])
def test_a_line_of_odd_blanks_alone_is_told(line: str) -> None:
    findings = Findings()
    parse(Source("blank", f"tick 1/60 s\n{line}\n"), findings)
    assert len(findings.diagnostics) == 1
    assert findings.diagnostics[0].hint
