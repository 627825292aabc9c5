"""Several who see the same run: who may change it, what they hear, and how one who does not listen is dropped."""

import asyncio
import json
import socket
from contextlib import suppress
from pathlib import Path
from threading import Event
from typing import Any

import numpy as np
import pytest
from mindrun.engine.changes import change_of
from mindrun.errors import MindError
from mindrun.sim.trace import trace
from websockets.exceptions import ConnectionClosed
from websockets.frames import Frame, Opcode

from mindlang.view import server
from mindlang.view.messages import AskChange, AskRows
from mindlang.view.rows import MAX_FRAME_BYTES
from mindlang.view.server import SECURITY
from mindlang.view.session import ViewSession
from mindlang.view.viewed import Viewed
from tests.view.serving import (
    ANSWER_SECONDS,
    UPGRADE,
    Served,
    ViewingClient,
    prepared,
    request,
    served,
    simulated,
    unpacked,
)

CHANGE = {"say": "change", "tick": 200, "what": "reading", "value": 0.25, "lasts": 300}


def rows(viewer: ViewingClient, about: dict[str, Any], fork: int = 0, to: int = 5000) -> tuple[Any, Any]:
    """Both blocks of all rows that are known."""
    data = viewer.frame(say="rows", **{"from": 0, "to": to}, fork=fork)
    return unpacked(data, about["doubles"], about["singles"])[3:]


def test_only_the_first_may_change_and_all_see_it(path: Path) -> None:
    with served(simulated(path)) as view, view.viewer() as first, view.viewer() as second:
        about, other = first.hear("about"), second.hear("about")
        assert (about["edits"], other["edits"]) == (True, False)
        assert {**about, "edits": False} == other
        column = about["nodes"][0]["columns"][0]
        second.say(**CHANGE, column=column)
        assert "somebody else" in second.hear("refused")["why"]
        first.run(1200)
        first.say(**CHANGE, column=column)
        for viewer in (first, second):
            told = viewer.hear("fork")
            assert (told["fork"], told["of"], told["tick"]) == (1, 0, 200)
            assert told["text"] == "ball_bearing is 0.25 in ticks 200 to 499"
        first.run(1200, fork=1)
        changed, before = rows(first, about, fork=1)[0], rows(first, about)[0]
        assert np.array_equal(changed[:200], before[:200], equal_nan=True)
        assert not np.array_equal(changed[:300], before[:300], equal_nan=True)


def test_a_fork_is_the_run_with_that_change(view: Served, path: Path) -> None:
    with view.viewer() as viewer:
        about = viewer.hear("about")
        viewer.run(1200)
        viewer.say(**CHANGE, column=about["nodes"][0]["columns"][0])
        viewer.run(1200, fork=viewer.hear("fork")["fork"])
        seen = rows(viewer, about, fork=1)[0][1:, :3]
    setup = prepared(path, "Chase")
    change = change_of(setup.ready.policy.graph, "reading", "ball_bearing", [[0.25]], 200, 499)
    moments = [*trace(setup.rollout(), 3, changes=change).moments]
    assert seen.tobytes() == np.array([moment.body[:3] for moment in moments]).tobytes()


def test_a_change_that_cannot_be_made_is_refused_with_what_to_do(path: Path) -> None:
    viewed = simulated(path)

    def failing(change: AskChange) -> tuple[Viewed, str]:
        raise MindError("this cannot be", "do that")

    viewed.forked = failing
    with served(viewed) as view, view.viewer() as viewer:
        viewer.say(**CHANGE, column=viewer.hear("about")["nodes"][0]["columns"][0])
        assert viewer.hear("refused")["why"] == "this cannot be; do that"


def test_who_comes_when_the_first_has_left_may_change(path: Path) -> None:
    with served(simulated(path)) as view:
        with view.viewer() as first:
            assert first.hear("about")["edits"]
        edits = False
        while not edits:  # the server hears of a closed connection a little later
            with view.viewer() as next_one:
                edits = next_one.hear("about")["edits"]


def test_one_who_comes_late_hears_what_has_happened(view: Served) -> None:
    with view.viewer() as first:
        first.run(1200)
    with view.viewer() as late:
        about, ticks = late.hear("about"), late.hear("ticks")
    assert (ticks["known"], ticks["over"]) == (1200, True)
    assert {about["events"][event]["text"] for _, event in ticks["happened"]} >= {"reach of ball"}
    assert all(0 < tick <= 1200 for tick, _ in ticks["happened"])


@pytest.mark.parametrize("of", ["/", "/rows", "/nothing"])
def test_every_answer_says_what_the_browser_may_do(view: Served, of: str) -> None:
    answer = view.raw(request(view, f"GET {of} HTTP/1.1", Origin="http://HOST")).decode().split("\r\n\r\n")[0]
    for name, value in SECURITY.items():
        assert f"{name}: {value}" in answer
    assert "Server:" not in answer


def test_too_many_viewers_are_sent_away(path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(server, "MAX_VIEWERS", 1)
    with served(simulated(path)) as view, view.viewer() as first:
        first.hear("about")
        with view.viewer() as second, pytest.raises(ConnectionClosed) as closed:
            second.connection.recv(ANSWER_SECONDS)
        assert closed.value.rcvd is not None
        assert closed.value.rcvd.code == 1013
        first.run(10)


def test_those_who_say_nothing_keep_no_viewer_out(path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Of too many the oldest are closed, but no viewer is."""
    monkeypatch.setattr(server, "MAX_PENDING", 3)
    monkeypatch.setattr(server, "OPEN_SECONDS", 600.0)
    with served(simulated(path)) as view, view.viewer() as first:
        first.hear("about")
        silent = [socket.create_connection(("127.0.0.1", view.port), ANSWER_SECONDS) for _ in range(5)]
        assert [one.recv(1) for one in silent[:2]] == [b"", b""]
        with view.viewer() as second:
            second.hear("about")
        assert silent[2].recv(1) == b""
        first.run(10)
        for one in silent:
            one.close()


def test_one_who_never_ends_a_request_is_closed(path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(server, "OPEN_SECONDS", 0.1)
    with served(simulated(path)) as view:
        assert view.raw(b"GET ") == b""


def test_one_who_never_says_a_token_is_closed(path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(server, "TOKEN_SECONDS", 0.1)
    with served(simulated(path)) as view:
        heard = view.raw(request(view, "GET /rows HTTP/1.1", Origin="http://HOST", **UPGRADE))
    assert heard.endswith((1008).to_bytes(2, "big"))


def test_one_who_does_not_read_is_dropped_and_no_other_waits(path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(server, "SEND_SECONDS", 0.2)
    with served(simulated(path)) as view, view.viewer() as reader:
        reader.run(1200)
        with socket.socket() as deaf:
            deaf.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
            deaf.settimeout(ANSWER_SECONDS)
            deaf.connect(("127.0.0.1", view.port))
            deaf.sendall(request(view, "GET /rows HTTP/1.1", Origin="http://HOST", **UPGRADE))
            assert deaf.recv(16).startswith(b"HTTP/1.1 101")
            deaf.sendall(Frame(Opcode.TEXT, view.token.encode()).serialize(mask=True))
            question = json.dumps({"say": "rows", "from": 0, "to": 1200}).encode()
            asked = Frame(Opcode.TEXT, question).serialize(mask=True)
            with suppress(ConnectionResetError, BrokenPipeError):
                while True:
                    deaf.sendall(asked)
                    assert reader.frame(say="rows", **{"from": 0, "to": 1})


def test_a_frame_is_no_larger_than_it_may_be(path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("mindlang.view.rows.MAX_FRAME_BYTES", 10_000)
    with served(simulated(path)) as view, view.viewer() as viewer:
        about = viewer.hear("about")
        viewer.run(1200)
        data = viewer.frame(say="rows", **{"from": 100, "to": 1201})
        ticks = unpacked(data, about["doubles"], about["singles"])[2]
        assert 9_000 < len(data) <= 10_000 < MAX_FRAME_BYTES
        assert ticks[0] == 100
        columns = viewer.frame(say="columns", columns=[[0, 0], [1, 2]], **{"from": 0, "to": 1201})
        assert 9_000 < len(columns) <= 10_000


def test_no_answer_computes_for_long(path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Six edges a row: of more rows, others come with another answer."""
    monkeypatch.setattr("mindlang.view.viewed.MAX_COMPUTED_EDGES", 60)
    with served(simulated(path)) as view, view.viewer() as viewer:
        about = viewer.hear("about")
        assert len(about["edges"]) == 6
        viewer.run(1200)
        data = viewer.frame(say="rows", **{"from": 0, "to": 1201})
        assert len(unpacked(data, about["doubles"], about["singles"])[2]) == 10
        flow = about["columns"]["flow"][1]
        assert len(viewer.frame(say="columns", columns=[[1, flow]], **{"from": 0, "to": 99})) == 24 + 10 * 8


def test_columns_are_those_of_the_rows(view: Served) -> None:
    with view.viewer() as viewer:
        about = viewer.hear("about")
        viewer.run(1200)
        flow = about["columns"]["flow"][1]
        data = viewer.frame(say="columns", columns=[[0, 1], [1, flow], [1, 2]], **{"from": 5, "to": 900, "every": 9})
        doubles, singles = rows(viewer, about)
    values = np.frombuffer(data[24:], "<f8").reshape(3, -1)
    assert np.array_equal(values, [doubles[5:900:9, 1], singles[5:900:9, flow], singles[5:900:9, 2]])


def test_events_come_in_parts_where_they_are_many(path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("mindlang.view.session.MAX_HAPPENED", 1)
    monkeypatch.setattr(server, "MAX_HAPPENED", 1)
    viewed = simulated(path)
    while not viewed.over:
        viewed.grow()
    heard: list[list[int]] = []
    with served(viewed) as view, view.viewer() as viewer:
        while len(heard) < len(viewed.happened):
            heard += (told := viewer.hear("ticks"))["happened"]
            assert len(told["happened"]) <= 1
    assert [*map(tuple, heard)] == viewed.happened
    assert len(heard) > 1


def test_forks_are_bounded(path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("mindlang.view.messages.MAX_FORKS", 1)
    with served(simulated(path)) as view, view.viewer() as viewer:
        column = viewer.hear("about")["nodes"][0]["columns"][0]
        viewer.say(**CHANGE, column=column)
        viewer.hear("fork")
        viewer.say(**CHANGE, column=column)
        assert "forks" in viewer.hear("refused")["why"]


def test_rows_are_bounded_over_a_run_and_its_forks(path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A fork as long as the run is more than may be kept, though neither is by itself."""
    viewed = simulated(path)
    while not viewed.over:
        viewed.grow()
    limit = viewed.blocks.kept_bytes * 5 // 4
    monkeypatch.setattr("mindlang.view.viewed.MAX_KEPT_BYTES", limit)
    session = ViewSession(viewed)
    with served(viewed, session=session) as view, view.viewer() as viewer:
        assert viewer.hear("ticks")["failed"] is None
        viewer.say(**CHANGE, column=viewed.about["nodes"][0]["columns"][0])
        told = viewer.run(1200, fork=viewer.hear("fork")["fork"])
    assert told["failed"].endswith("GiB of rows, of a run and its forks together, are not kept")
    assert 0 < told["known"] < 1200
    first, fork = session.forks
    assert limit < first.blocks.kept_bytes + fork.blocks.kept_bytes < 2 * first.blocks.kept_bytes


def test_a_question_is_about_the_run_that_was_seen_when_it_was_asked(path: Path) -> None:
    """Another run is seen before it is its turn: that one has no fork."""
    session, held = ViewSession(simulated(path)), Event()
    session.forks.append(simulated(path))

    async def asked() -> bytes | dict[str, Any] | None:
        session._answerer.submit(held.wait)
        asking = asyncio.create_task(session.answer(AskRows(first=0, below=10, fork=1, ask=7), edits=False))
        await asyncio.sleep(0)
        session._show(simulated(path))
        held.set()
        return await asking

    answer, columns = asyncio.run(asked()), session.forks[0].columns
    assert isinstance(answer, bytes)
    assert unpacked(answer, columns.width(0), columns.width(1))[:2] == (1, 7)


@pytest.mark.parametrize(
    ("asked", "of", "ask"),
    [
        ({"say": "rows", "from": 0, "to": 5, "fork": 9, "ask": 7}, "rows", 7),
        ({"say": "columns", "columns": [[0, 999]], "from": 0, "to": 5, "ask": 8}, "columns", 8),
        ({"say": "columns", "columns": [], "from": 0, "to": 5, "ask": 9}, "columns", 9),
        ({"say": "why", "tick": 99_999, "actuator": 0}, "why", None),
        ({"say": "nothing", "ask": "x"}, None, None),
    ],
)
def test_a_refusal_says_which_question_it_answers(view: Served, asked: Any, of: str | None, ask: int | None) -> None:
    with view.viewer() as viewer:
        viewer.say(**asked)
        refused = viewer.hear("refused")
    assert (refused["of"], refused["ask"]) == (of, ask)


def test_hostile_texts_are_spelt_out_and_short(path: Path) -> None:
    viewed = simulated(path)
    viewed.about = {**viewed.about, "title": "<img src=x onerror=alert(1)>"}
    data = json.dumps(ViewSession(viewed).about(edits=True))
    assert "<img src=x onerror=alert(1)>" in data  # as text, which the page shows as text
    assert data.isascii()
