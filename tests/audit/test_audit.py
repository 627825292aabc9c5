"""`mindc audit`: planted mistakes are found at their line, a clean task is silent, the workers change nothing."""

import json
from pathlib import Path
from typing import Any

import pytest

from benchmarks.audit import CLEAN, PLANTED, mind
from tests.calling import Call

ONE_OF_A_KIND = ("forward pays", "one way pays", "moving costs", "none is paid", "none feels it")


def audited(mindc: Call, folder: Path, lines: str, *options: str | int) -> tuple[int, dict[str, Any]]:
    """How an audit of a task of these lines ended, and what it found."""
    file = folder / "lamp.mind"
    file.write_text(mind(lines), encoding="utf-8")
    said = mindc("audit", file, "--json", *options)
    return said.code, json.loads(said.out)["tasks"][0]


@pytest.mark.parametrize("name", ONE_OF_A_KIND)
def test_a_planted_mistake_is_found_at_its_line(mindc: Call, tmp_path: Path, name: str) -> None:
    code, words, lines = PLANTED[name]
    ended, found = audited(mindc, tmp_path, lines)
    text = (tmp_path / "lamp.mind").read_text(encoding="utf-8").split("\n")
    assert ended == 1
    assert any(each["code"] == code and words in text[each["line"] - 1] for each in found["findings"])


@pytest.mark.parametrize("name", ["progress", "both ways", "one is enough"])
def test_a_clean_task_is_silent(mindc: Call, tmp_path: Path, name: str) -> None:
    ended, found = audited(mindc, tmp_path, CLEAN[name])
    assert (ended, found["findings"]) == (0, [])


def test_lines_add_up_and_workers_change_nothing(mindc: Call, tmp_path: Path) -> None:
    lines = PLANTED["forward pays"][2]
    one, two = (audited(mindc, tmp_path, lines, "--workers", n, "--search", 1)[1] for n in (1, 2))
    assert one == two
    still = next(each for each in one["policies"] if each["group"] == "still")
    assert still["score"] == 0
    assert any(each["group"] == "found" for each in one["policies"])
    assert max(each["score"] for each in one["policies"]) <= sum(each["most"] for each in one["lines"])


def test_a_loophole_is_written_with_its_bundle(mindc: Call, tmp_path: Path) -> None:
    hole, page = tmp_path / "hole.rec", tmp_path / "hole.html"
    (tmp_path / "lamp.mind").write_text(mind(PLANTED["forward pays"][2]), encoding="utf-8")
    assert mindc("audit", tmp_path / "lamp.mind", "--replay", hole).code == 1
    assert mindc("view", hole, hole.with_suffix(".bundle"), "--export", page).code == 0


def test_what_pays_nothing_is_refused(mindc: Call, tmp_path: Path) -> None:
    (tmp_path / "lamp.mind").write_text(mind("counts reach of lamp"), encoding="utf-8")
    assert mindc("audit", tmp_path / "lamp.mind", "Seek").code == 2
