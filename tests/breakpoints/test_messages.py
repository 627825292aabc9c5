"""Every mistake gets one message: `wrong/NAME.break` has one, `wrong/NAME.txt` is what mindc says of it.

Those in `wrong_recording/` are about what a robot has recorded.

After a change of words: UPDATE=1 pytest tests/breakpoints/test_messages.py, and read the difference.
"""

import os
from dataclasses import replace
from pathlib import Path

import pytest

from mindlang.breakpoints.breakpoint import Happens, Holds, Reaches, RobotEvent
from mindlang.breakpoints.resolve import BreakpointFile, breakpoints_of, load_breakpoints
from mindlang.cli._diagnostic_printer import plain
from mindlang.compiler.diagnostic import Findings
from mindlang.compiler.parse import MAX_UNREADABLE_LINES, parse_stops
from mindlang.compiler.parse.explain import Mistake, common_mistakes
from mindlang.compiler.source import Source
from tests.breakpoints.subjects import subject

CASES = sorted(Path(__file__).parent.glob("wrong*/*.break"))
KNOWN = common_mistakes()


def read(text: str, has_task: bool = True) -> BreakpointFile:
    return breakpoints_of(Source("a.break", text), subject(has_task=has_task))


@pytest.mark.parametrize("path", CASES, ids=lambda path: path.stem)
def test_one_message_for_one_mistake(path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(path.parent)
    found = load_breakpoints(path.name, subject(has_task=path.parent.name == "wrong"))
    said = "\n".join(plain(diagnostic) for diagnostic in found.diagnostics)
    expected = path.with_suffix(".txt")
    if os.environ.get("UPDATE"):
        expected.write_text(said, encoding="utf-8")
    assert said == expected.read_text(encoding="utf-8")
    assert len(found.diagnostics) == 1
    assert found.diagnostics[0].hint


@pytest.mark.parametrize("mistake", sorted({*KNOWN.stops} - {*KNOWN.lines}, key=repr), ids=lambda each: each.code)
def test_the_example_of_a_mistake_is_explained_by_it(mistake: Mistake) -> None:
    findings = Findings()
    parse_stops(Source("example", mistake.example), findings)
    assert [diagnostic.code for diagnostic in findings.diagnostics] == [mistake.code]


def test_all_bad_lines_are_reported_in_their_order_and_the_others_are_read() -> None:
    found = read("stop when holdin > 1\nstop on collision\nhalt\nstop in tick 0\n")
    lines = [(each.code, each.span and each.span.line) for each in found.diagnostics]
    assert lines == [("unknown-reading", 1), ("no-stop", 3), ("out-of-range", 4)]
    assert [each.line for each in found.breakpoints] == [2]


def test_every_form_of_line_is_read() -> None:
    found = read(
        "# what to look at\n"
        "stop when least of holding mood < 20% and left > 1/2 or Seek influences left above 0.5  # both\n"
        "\n"
        "  stop on 3 reach of ball\n"
        "stop on collision\n"
        "stop in tick 812"
    )
    assert found.diagnostics == ()
    holds, third, whenever, tick = (each.cause for each in found.breakpoints)
    assert isinstance(holds, Holds)
    assert [name for name, _ in holds.named] == ["holding", "mood", "left", "Seek influences left"]
    assert isinstance(third, Happens)
    assert isinstance(whenever, Happens)
    assert (third.times, whenever.times, tick) == (3, 0, Reaches(812))
    assert [each.line for each in found.breakpoints] == [2, 4, 5, 6]


def test_of_a_recording_there_are_no_events() -> None:
    found = read("stop when holding > 0.5\nstop on collision\nstop in tick 100000", has_task=False)
    assert [each.code for each in found.diagnostics] == ["impossible-event"]
    assert len(found.breakpoints) == 2


def test_a_file_of_something_else_is_not_read_to_its_end() -> None:
    found = read("stop on collision\n" + "halt\n" * (MAX_UNREADABLE_LINES + 2))
    assert len(found.breakpoints) == 1
    assert len(found.diagnostics) == MAX_UNREADABLE_LINES + 2
    assert found.diagnostics[-1].code == "too-many-mistakes"
    assert [each.code for each in read("1\n- stop on collision\nstopp\n").diagnostics] == [
        "no-stop",
        "list-dash",
        "no-stop",
    ]


def test_of_a_recording_there_are_the_events_of_the_robot() -> None:
    found = read("stop on stopped\nstop on 3 fault\nstop on fault of eyes", has_task=False)
    assert found.diagnostics == ()
    assert [each.cause for each in found.breakpoints] == [
        Happens(RobotEvent("stopped"), 0),
        Happens(RobotEvent("fault"), 3),
        Happens(RobotEvent("fault", "eyes"), 0),
    ]


def test_a_robot_without_sensors_has_no_fault_of_one() -> None:
    blind = replace(subject(has_task=False), sensors=())
    (found,) = breakpoints_of(Source("a.break", "stop on fault of eyes"), blind).diagnostics
    assert (found.code, found.hint) == ("unknown-sensor", "No sensor of this robot is wired.")


@pytest.mark.parametrize("text", ["\x0b", "stop \u200bon collision", "stop when " + "(" * 99, "stop " + "x" * 9999])
def test_whatever_a_line_is_it_gets_its_message(text: str) -> None:
    found = read(text)
    assert len(found.diagnostics) == 1
    assert found.diagnostics[0].hint
