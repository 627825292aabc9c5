"""`mindc view --export`: a run as one file."""

import base64
import json
import re
import zlib
from html.parser import HTMLParser
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from mindlang.compiler.compile import load
from mindlang.run.recorded_run import record_run
from mindlang.run.setup import set_up
from mindlang.view import export, session, viewed
from tests.calling import Call


class Page(HTMLParser):
    """The scripts of a page by their id, and all that it asks a browser to fetch."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.scripts: dict[str, str] = {}
        self.fetched: list[str] = []
        self.policy = ""
        self._open: str | None = None
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        of = dict(attrs)
        self._open = of.get("id") or "" if tag == "script" else None
        self.fetched += [str(of[name]) for name in ("src", "href") if name in of]
        if of.get("http-equiv") == "Content-Security-Policy":
            self.policy = of["content"] or ""

    def handle_endtag(self, tag: str) -> None:
        self._open = None

    def handle_data(self, data: str) -> None:
        if self._open is not None:
            self.scripts[self._open] = self.scripts.get(self._open, "") + data


def columns(data: dict[str, Any], text: str) -> tuple[np.ndarray, np.ndarray]:
    """Doubles and singles [ticks, columns], as the page reads them."""
    rows, plain = data["rows"], zlib.decompress(base64.b64decode(text))
    found, at = [], 0
    for kind, count in (("<u8", data["about"]["doubles"]), ("<u4", data["about"]["singles"])):
        size = np.dtype(kind).itemsize
        for _ in range(count):
            found.append(restored(plain[at : at + size * rows], kind))
            at += size * rows
    assert at == len(plain)
    wide = data["about"]["doubles"]
    return np.array(found[:wide]).T.view("<f8"), np.array(found[wide:]).T.view("<f4")


def restored(data: bytes, kind: str) -> np.ndarray:
    """A column from its differences."""
    bits = np.frombuffer(data, np.uint8).reshape(np.dtype(kind).itemsize, -1).T.copy().view(kind)[:, 0]
    return np.bitwise_xor.accumulate(bits)


def page_of(mindc: Call, rules: Path, tmp_path: Path) -> Page:
    path = tmp_path / "run.html"
    said = mindc("view", rules, "--task", "Chase", "--seed", 3, "--export", path)
    assert said.code == 0
    assert "1,200 ticks" in said.err
    return Page(path.read_text("utf-8"))


def test_every_value_is_in_the_file_to_the_bit(mindc: Call, rules: Path, tmp_path: Path) -> None:
    page = page_of(mindc, rules, tmp_path)
    data = json.loads(page.scripts["recording"])
    doubles, singles = columns(data, page.scripts["rows"])
    setup = set_up(str(rules), load(rules), "Chase", None)
    run = record_run(setup, setup.rollout(), 3)
    groups = data["about"]["columns"]

    def group(name: str) -> np.ndarray:
        block, first, count = groups[name]
        return (doubles, singles)[block][:, first : first + count]

    assert np.array_equal(group("robot"), run.body)
    assert np.array_equal(group("rewards")[1:], run.lines)
    for name, expected in (("readings", run.readings), ("influence", run.influence), ("commands", run.commands)):
        assert np.array_equal(group(name)[1:], expected), name
    assert (data["ticks"]["known"], data["ticks"]["over"]) == (1200, True)


def test_it_asks_for_nothing_and_runs_nothing_else(mindc: Call, rules: Path, tmp_path: Path) -> None:
    page = page_of(mindc, rules, tmp_path)
    assert [address for address in page.fetched if not address.startswith("data:")] == []
    assert page.policy.startswith("default-src 'none'; script-src 'sha256-")
    assert "unsafe" not in page.policy


def test_no_name_is_a_tag() -> None:
    text = export._inert({"name": "</script><img src=x onerror=alert(1)><!--"})
    assert "<" not in text
    assert json.loads(text)["name"] == "</script><img src=x onerror=alert(1)><!--"


def test_the_script_ends_where_it_ends() -> None:
    assert not re.search(r"</script|<!--", (export.PAGE / "view.js").read_text("utf-8"), re.IGNORECASE)


@given(column=arrays(np.float64, st.integers(1, 30), elements=st.floats()))
def test_differences_give_the_column_back(column: np.ndarray) -> None:
    again = restored(export._differences(column, "<u8"), "<u8")
    assert again.tobytes() == column.tobytes()


def test_what_no_page_can_hold_is_refused(
    mindc: Call, rules: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(export, "MAX_EXPORTED_BYTES", 1000)
    said = mindc("view", rules, "--task", "Chase", "--export", tmp_path / "run.html")
    assert said.code == 2
    assert "leave --export out" in said.err
    assert not (tmp_path / "run.html").exists()


def test_a_run_that_broke_off_is_not_written(
    mindc: Call, rules: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(viewed, "MAX_KEPT_BYTES", 1000)
    said = mindc("view", rules, "--task", "Chase", "--seed", 3, "--export", tmp_path / "run.html")
    assert said.code == 1
    assert "nothing is written" in said.err
    assert not (tmp_path / "run.html").exists()


def test_all_that_happened_is_in_the_file(
    mindc: Call, rules: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(session, "MAX_HAPPENED", 1)
    data = json.loads(page_of(mindc, rules, tmp_path).scripts["recording"])
    setup = set_up(str(rules), load(rules), "Chase", None)
    run = record_run(setup, setup.rollout(), 3)
    counted = sum(event < run.events.shape[1] for _, event in data["ticks"]["happened"])
    assert counted == np.count_nonzero(np.diff(run.events, axis=0, prepend=0)) > 1
