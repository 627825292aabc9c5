"""Files of breakpoints in an editor: their mistakes, their form, and what may be written."""

from pathlib import Path

import pytest

from mindlang.server.completing import complete
from mindlang.server.workspace import Workspace
from tests.calling import RULES
from tests.language.examples import TOUR
from tests.server.client import editing, uri

BREAKS = TOUR.with_suffix(".break")
CASES = [  # the line with | for the cursor, what must be offered, what must not
    ("|", "stop", "reads skill tick"),
    ("stop |", "on when in", "stop"),
    ("stop in |", "tick", "on"),
    ("stop in tick |", "", ""),
    ("stop on |", "collision reach stopped fault", "moving"),
    ("stop on 3 |", "collision fault", "moving"),
    ("stop on fault |", "of", "collision"),
    ("stop on fault of |", "eyes", "mood claw"),
    ("stop on reach |", "of", "stopped"),
    ("stop on reach of |", "parcel", "eyes"),
    ("stop when |", "moving mood left_wheel Fetch least", "stop"),
    ("stop when mov|", "moving", ""),
    ("stop when moving |", "", "and"),
    ("stop when moving < 0.5 |", "and or", "stop"),
    ("stop when moving < 0.5 and |", "moving Fetch", "stop"),
    ("stop when Fetch |", "influences", "moving"),
    ("stop when Fetch influences |", "claw mood Avoid", "moving"),
    ("stop when Fetch influences claw |", "above below", "and"),
    ("stop when Fetch influences claw above 5 |", "% and or", "above"),
    ("stop when Fetch influences claw above 5% |", "and or", "%"),
    ("# stop |", "", "on"),
]


@pytest.mark.parametrize(("line", "wanted", "unwanted"), CASES, ids=[case[0] for case in CASES])
def test_offers(line: str, wanted: str, unwanted: str) -> None:
    text = f"stop on collision\n{line.replace('|', '')}\nstop in tick 3\n"
    offset = text.index("\n") + 1 + line.index("|")
    found = complete(Workspace({BREAKS: text}).view(BREAKS), BREAKS, text, offset)
    labels = {word for offer in found.offers for word in offer.label.split()}
    assert set(wanted.split()) <= labels
    assert not set(unwanted.split()) & labels
    assert wanted or unwanted or not found.offers


def test_mistakes_are_said_as_they_are_written(tmp_path: Path) -> None:
    mind, breaks = tmp_path / "rules.mind", tmp_path / "rules.break"
    mind.write_text(RULES)
    breaks.write_text("stop on colision\nstop when ball_baering > 0.6\n")
    with editing(tmp_path) as editor:
        editor.open(breaks)
        assert [each["code"] for each in editor.settle(breaks)] == ["unknown-kind", "unknown-reading"]
        editor.change(
            breaks, "stop on exhaustion\nstop on fault of feeler\nstop when Turn influences left_wheel above 1%\n"
        )
        assert [each["code"] for each in editor.settle(breaks)] == ["impossible-event"]
        editor.open(mind, RULES.replace("ball_bearing", "bearing_of_ball"))
        editor.settle(mind)
        editor.change(breaks, "stop when ball_bearing > 0.6\n")
        assert [each["code"] for each in editor.settle(breaks)] == ["unknown-reading"]


def test_without_a_mind_its_lines_are_read_and_nothing_else_is_found(tmp_path: Path) -> None:
    breaks = tmp_path / "alone.break"
    breaks.write_text("stop  when x<1#odd\nstop at collision\n")
    with editing(tmp_path) as editor:
        editor.open(breaks)
        assert [each["code"] for each in editor.settle(breaks)] == ["missing-on"]
        assert set(editor.found) == {uri(breaks)}
        place = editor.at(breaks, "x<")
        for method in ("hover", "definition", "documentHighlight", "prepareRename"):
            assert not editor.ask(f"textDocument/{method}", place)
        assert not editor.ask("textDocument/documentSymbol", {"textDocument": {"uri": uri(breaks)}})
        assert not editor.actions(breaks, "x<")


def test_it_is_formatted(tmp_path: Path) -> None:
    breaks = tmp_path / "alone.break"
    breaks.write_text("\nstop  when x<1#odd\n\n\nstop on  3 reach of ball\n")
    with editing(tmp_path) as editor:
        editor.open(breaks)
        options = {"textDocument": {"uri": uri(breaks)}, "options": {"tabSize": 2, "insertSpaces": True}}
        editor.apply({"changes": {uri(breaks): editor.ask("textDocument/formatting", options)}})
        assert editor.texts[uri(breaks)] == "stop when x < 1  #odd\n\nstop on 3 reach of ball\n"
