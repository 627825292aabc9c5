"""What nobody should say on a websocket: each is refused, and the server goes on."""

import json
import socket
import struct

import pytest
from websockets.exceptions import ConnectionClosed, InvalidStatus
from websockets.sync.client import connect
from websockets.typing import Origin

from tests.view.serving import ANSWER_SECONDS, UPGRADE, Served, request

pytestmark = pytest.mark.usefixtures("goes_on")

MASK = b"\1\2\3\4"
POLICY, TOO_BIG, BAD_TEXT, PROTOCOL = 1008, 1009, 1007, 1002
TOKENS = [
    *(
        "",
        "x",
        b"x",
        "TOKEN ",
        " TOKEN",
        "TOKEN\0",
        "TOKEN" * 2,
        "tOKEN",
        "Ü" * 43,
        '{"say": "run", "to": 9}',
        b"TOKEN",
    ),
    "a" * 16_000,
]


@pytest.mark.parametrize("token", TOKENS)
def test_without_the_token_there_is_nothing(view: Served, token: str | bytes) -> None:
    said = (
        token.replace("TOKEN", view.token) if isinstance(token, str) else token.replace(b"TOKEN", view.token.encode())
    )
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


def frame(opcode: int, data: bytes, masked: bool = True, length: int | None = None) -> bytes:
    """A frame of a websocket, of which the length may be a lie."""
    size = len(data) if length is None else length
    long = b"" if size < 126 else struct.pack("!H", size) if size < 1 << 16 else struct.pack("!Q", size)
    short = size if size < 126 else 126 if size < 1 << 16 else 127
    sent = bytes(byte ^ MASK[i % 4] for i, byte in enumerate(data)) if masked else data
    return bytes([0x80 | opcode, short | 0x80 * masked]) + long + (MASK if masked else b"") + sent


FRAMES = {
    "too large": (frame(1, b"a" * 20_000), TOO_BIG),
    "said to be too large": (frame(1, b"", length=1 << 40), TOO_BIG),
    "no UTF-8": (frame(1, b"\xff\xfe"), BAD_TEXT),
    "not masked": (frame(1, b"{}", masked=False), PROTOCOL),
    "of an unknown kind": (frame(3, b"{}"), PROTOCOL),
    "compressed": (bytes([0xC1]) + frame(1, b"{}")[1:], PROTOCOL),
    "a ping too large": (frame(9, b"a" * 200), PROTOCOL),
    "a continuation of nothing": (frame(0, b"a"), PROTOCOL),
    "closed with no code": (frame(8, b"a"), PROTOCOL),
}


@pytest.mark.parametrize("name", FRAMES)
def test_a_broken_frame_ends_its_connection(view: Served, name: str) -> None:
    data, code = FRAMES[name]
    with socket.create_connection(("127.0.0.1", view.port), ANSWER_SECONDS) as client:
        client.sendall(request(view, "GET /rows HTTP/1.1", Origin="http://HOST", **UPGRADE))
        assert client.recv(1 << 16).startswith(b"HTTP/1.1 101 ")
        client.sendall(frame(1, view.token.encode()) + data)
        heard = b"".join(iter(lambda: client.recv(1 << 16), b""))
    assert struct.pack("!H", code) in heard[heard.rindex(b"\x88") :]


SPAN = {"from": 0, "to": 10}
NUMBERS = [-1, 1 << 32, 1 << 64, 10**400, 1.5, 1e308, True, None, "1", [], {}]
TEXTS = [
    *("", "null", "[]", "1", '"rows"', "{", "NaN", '{"say": "rows", "from": NaN, "to": 1}', "{}" * 2, "[" * 15_000),
    *('{"say": 1e999}', '{"say": "rows"', "\0", "\ufeff{}", b'{"say": "run", "to": 9}', '{"say": ' + "1" * 5000 + "}"),
]
CHANGE = {"say": "change", "tick": 1, "what": "reading", "column": [1, 2], "value": 0}
WRONG: dict[str, list[tuple[dict[str, object], list[object]]]] = {  # messages in which a key has a wrong value
    "say": [({}, [None, ["rows"], "rows\0", "__class__", "about", "a" * 9000])],
    "from": [({"say": "rows", **SPAN}, NUMBERS)],
    "to": [({"say": "rows", **SPAN}, NUMBERS), ({"say": "run"}, NUMBERS)],
    "every": [({"say": "rows", **SPAN}, [0, *NUMBERS])],
    "fork": [({"say": "rows", **SPAN}, [1, 16, 17, *NUMBERS])],
    "ask": [({"say": "rows", **SPAN}, NUMBERS)],
    "columns": [
        ({"say": "columns", **SPAN}, [*NUMBERS, [[0, 999]], [[2, 0]], [[0, -1]], [[0]], [[0, 0]] * 65]),
        ({"say": "columns", **SPAN}, [[[1, number]] for number in [*NUMBERS, 4096]]),
    ],
    "tick": [({"say": "why", "actuator": 0}, [0, 1 << 31, *NUMBERS]), (CHANGE, [0, 5000, *NUMBERS])],
    "actuator": [({"say": "why", "tick": 1}, [99, *NUMBERS])],
    "value": [(CHANGE, [1.5, *NUMBERS])],
    "lasts": [(CHANGE, [0, *NUMBERS])],
    "what": [(CHANGE, ["code", None, [], {}, "__init__"])],
    "column": [
        (CHANGE, [*NUMBERS, [0, 0], [1, 0], [1, 999]]),
        (CHANGE | {"what": "influence"}, [[0, 0], [1, 2], [1, 999]]),
        (CHANGE | {"what": "memory"}, [[0, 0], [1, 2], [1, 999]]),
    ],
    **{name: [({"say": "rows", **SPAN}, [1])] for name in ("extra", "__proto__", "<img onerror=x()>", "\u202e")},
}
MESSAGES = [
    *TEXTS,
    *(json.dumps({**message, key: value}) for key in WRONG for message, values in WRONG[key] for value in values),
]


@pytest.mark.parametrize("said", MESSAGES, ids=[*map(str, range(len(MESSAGES)))])
def test_a_message_that_is_none_is_refused(view: Served, said: str | bytes) -> None:
    with view.viewer() as viewer:
        viewer.hear("about")
        viewer.connection.send(said)
        assert set(viewer.hear("refused")) == {"say", "why", "of", "ask"}
