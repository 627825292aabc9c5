"""What nobody should ask or say: it is refused, and the run goes on."""

import json

import pytest
from websockets.exceptions import ConnectionClosed, InvalidStatus
from websockets.sync.client import connect
from websockets.typing import Origin

from tests.view.serving import ANSWER_SECONDS, UPGRADE, Served, request

pytestmark = pytest.mark.usefixtures("goes_on")

POLICY, TOO_BIG = 1008, 1009  # codes with which a websocket closes
SPAN = {"from": 0, "to": 10}
CHANGE = {"say": "change", "tick": 1, "what": "reading", "column": [1, 2], "value": 0}
WRONG = [
    *("", "null", "[]", "{", '{"say": "rows", "from": NaN, "to": 1}', '{"x": ' + "[" * 15_000),
    *map(
        json.dumps,
        [
            {"say": "about"},
            {"say": "rows", **SPAN, "extra": 1},
            {"say": "rows", **SPAN, "to": 1 << 32},
            {"say": "rows", **SPAN, "every": 0},
            {"say": "rows", **SPAN, "fork": 1},
            {"say": "columns", **SPAN, "columns": [[0, 999]]},
            {"say": "columns", **SPAN, "columns": [[0, 0]] * 65},
            {"say": "why", "tick": 1 << 31, "actuator": 0},
            {"say": "why", "tick": 1, "actuator": 99},
            {**CHANGE, "value": 1.5},
            {**CHANGE, "tick": 5000},
            {**CHANGE, "column": [0, 0]},
            {**CHANGE, "what": "influence"},
            {"say": "champion", "run": 0, "attempt": 1, "generation": 1, "seed": str(1 << 64)},
        ],
    ),
]


@pytest.mark.parametrize("said", WRONG, ids=map(str, range(len(WRONG))))
def test_a_wrong_message_is_refused(view: Served, said: str) -> None:
    with view.viewer() as viewer:
        viewer.hear("about")
        viewer.connection.send(said)
        assert set(viewer.hear("refused")) == {"say", "why", "of", "ask"}


def test_who_asks_is_told_which_question_is_refused(view: Served) -> None:
    with view.viewer() as viewer:
        viewer.say(say="columns", **SPAN, columns=[[0, 999]], ask=7)
        found = viewer.hear("refused")
        assert (found["of"], found["ask"], found["why"]) == ("columns", 7, "there is no column 999 in block 0")


def test_a_message_too_large_ends_its_connection(view: Served) -> None:
    with view.viewer() as viewer:
        viewer.connection.send("a" * 20_000)
        with pytest.raises(ConnectionClosed) as closed:
            viewer.hear("nothing")
    assert closed.value.rcvd is not None
    assert closed.value.rcvd.code == TOO_BIG


@pytest.mark.parametrize("token", ["", "x", "TOKEN ", b"TOKEN", '{"say": "run", "to": 9}'])
def test_without_the_token_there_is_nothing(view: Served, token: str | bytes) -> None:
    said = token if isinstance(token, bytes) else token.replace("TOKEN", view.token)
    with view.viewer(said) as viewer, pytest.raises(ConnectionClosed) as closed:
        viewer.connection.recv(ANSWER_SECONDS)
    assert closed.value.rcvd is not None
    assert closed.value.rcvd.code == POLICY


def test_a_token_in_the_address_is_none(view: Served) -> None:
    """It would stand in histories and logs."""
    address, origin = f"ws://{view.host}/rows?token={view.token}", Origin(f"http://{view.host}")
    with pytest.raises(InvalidStatus) as refused, connect(address, origin=origin):
        pass
    assert refused.value.response.status_code == 404


@pytest.mark.parametrize("of", ["/", "/rows"])
@pytest.mark.parametrize("host", [None, "evil.example:PORT", "127.0.0.1", "HOST.evil.example", "0.0.0.0:PORT"])
def test_another_host_is_refused(view: Served, host: str | None, of: str) -> None:
    """A site whose name leads here (DNS rebinding) gets nothing, whatever else it says."""
    own = {"Origin": "http://HOST", **(UPGRADE if of == "/rows" else {})}
    assert view.status(request(view, f"GET {of} HTTP/1.1", host, **own)) == 403


@pytest.mark.parametrize("origin", [None, "null", "http://evil.example", "https://HOST", "http://localhost:PORT"])
def test_a_websocket_of_another_origin_is_refused(view: Served, origin: str | None) -> None:
    headers = UPGRADE if origin is None else {**UPGRADE, "Origin": origin}
    assert view.status(request(view, "GET /rows HTTP/1.1", **headers)) == 403


@pytest.mark.parametrize("of", ["/index.html", "/../pyproject.toml", "/%2e%2e/etc/passwd", "/rows/", "/?x"])
def test_no_other_file_is_there(view: Served, of: str) -> None:
    assert view.status(request(view, f"GET {of} HTTP/1.1")) == 404


def test_nothing_but_get(view: Served) -> None:
    assert view.status(request(view, "DELETE / HTTP/1.1")) == 405
