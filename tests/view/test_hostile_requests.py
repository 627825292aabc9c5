"""What nobody should ask: each request is refused with its status, and the server goes on."""

import socket

import pytest

from tests.view.serving import ANSWER_SECONDS, UPGRADE, Served, request

pytestmark = pytest.mark.usefixtures("goes_on")


HOSTS = [
    *(None, "", " ", "evil.example", "evil.example:PORT", "127.0.0.1", "localhost", "127.0.0.1:1", "127.0.0.1:PORT0"),
    *("HOST.evil.example", "evil.HOST", "HOST:PORT", "HOST, HOST", "HOST/", "HOST@evil.example", "user@HOST"),
    *(
        "0.0.0.0:PORT",
        "[::1]:PORT",
        "127.1:PORT",
        "2130706433:PORT",
        "127.0.0.2:PORT",
        "LOCALHOST:PORT",
        "localhost.:PORT",
    ),
    *("127.0.0.1.nip.io:PORT", "[::ffff:127.0.0.1]:PORT", "localhost\u00a0:PORT"),
]


@pytest.mark.parametrize("of", ["/", "/rows"])
@pytest.mark.parametrize("host", HOSTS)
def test_another_host_is_refused(view: Served, host: str | None, of: str) -> None:
    """A site whose name leads here (DNS rebinding) gets nothing, whatever else it says."""
    own = {"Origin": "http://HOST", **(UPGRADE if of == "/rows" else {})}
    assert view.status(request(view, f"GET {of} HTTP/1.1", host, **own)) == 403


def test_two_hosts_are_refused(view: Served) -> None:
    twice = request(view).replace(b"Host:", f"Host: {view.host}\r\nHost:".encode())
    assert view.status(twice) == 403


ORIGINS = [
    *(None, "", "null", "http://evil.example", "https://HOST", "http://HOST/", "HOST", "http://HOST.evil.example"),
    *(
        "http://localhost:PORT",
        "http://127.0.0.1",
        "http://127.0.0.1:1",
        "http://HOST http://HOST",
        "file://",
        "http://HOST#",
    ),
    *("chrome-extension://HOST", "http://user@HOST", "http://HOST:80", "HTTP://HOST"),
]


@pytest.mark.parametrize("origin", ORIGINS)
def test_a_websocket_of_another_origin_is_refused(view: Served, origin: str | None) -> None:
    headers = UPGRADE if origin is None else {**UPGRADE, "Origin": origin}
    assert view.status(request(view, "GET /rows HTTP/1.1", **headers)) == 403


@pytest.mark.parametrize("host", ["127.0.0.1", "localhost"])
def test_the_own_origin_is_not(view: Served, host: str) -> None:
    headers = {**UPGRADE, "Origin": f"http://{host}:PORT"}
    with socket.create_connection(("127.0.0.1", view.port), ANSWER_SECONDS) as client:
        client.sendall(request(view, "GET /rows HTTP/1.1", f"{host}:PORT", **headers))
        assert client.recv(1 << 16).startswith(b"HTTP/1.1 101 ")


PATHS = [
    *(
        "/index.html",
        "/..",
        "/../pyproject.toml",
        "/%2e%2e/%2e%2e/etc/passwd",
        "//",
        "//evil.example/",
        "/view.js/",
        "/?x",
    ),
    *(
        "/view.js?v=1",
        "/.",
        "/page/index.html",
        "/rows/",
        "/ROWS",
        "http://evil.example/",
        "*",
        "/view.js%00.css",
        "\\",
        "/#x",
    ),
    *("/..;/", "/view.css\t", "/etc/passwd", "/favicon.ico", "/__init__.py", "/.git/config", "/" + "a" * 4000),
]


@pytest.mark.parametrize("of", PATHS)
def test_no_other_file_is_there(view: Served, of: str) -> None:
    assert view.status(request(view, f"GET {of} HTTP/1.1")) == 404


@pytest.mark.parametrize(
    "method", ["POST", "PUT", "DELETE", "OPTIONS", "HEAD", "TRACE", "CONNECT", "PATCH", "get", "PRI"]
)
@pytest.mark.parametrize("of", ["/", "/rows"])
def test_nothing_but_get(view: Served, method: str, of: str) -> None:
    assert view.status(request(view, f"{method} {of} HTTP/1.1", Origin="http://HOST", **UPGRADE)) == 405


BROKEN = {
    "no request": b"\0" * 100,
    "a TLS hello": bytes.fromhex("16030100c8010000c40303") + b"x" * 190,
    "two words": b"GET /\r\n\r\n",
    "HTTP/2": b"PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n",
    "HTTP/3.0": b"GET / HTTP/3.0\r\nHost: HOST\r\n\r\n",
    "a path that is no ASCII": "GET /ü HTTP/1.1\r\nHost: HOST\r\n\r\n".encode(),
    "a header without a colon": b"GET / HTTP/1.1\r\nHost HOST\r\n\r\n",
    "a header with a space": b"GET / HTTP/1.1\r\nHost : HOST\r\n\r\n",
    "a folded header": b"GET / HTTP/1.1\r\nX: a\r\n b\r\nHost: HOST\r\n\r\n",
    "a NUL in a header": b"GET / HTTP/1.1\r\nHost: HOST\r\nX: a\0b\r\n\r\n",
    "a body": b"GET / HTTP/1.1\r\nHost: HOST\r\nContent-Length: 5\r\n\r\nhello",
    "a length that is none": b"GET / HTTP/1.1\r\nHost: HOST\r\nContent-Length: -1\r\n\r\n",
    "chunks": b"GET / HTTP/1.1\r\nHost: HOST\r\nTransfer-Encoding: chunked\r\n\r\n0\r\n\r\n",
}


@pytest.mark.parametrize("name", BROKEN)
def test_what_is_no_request_gets_no_answer(view: Served, name: str) -> None:
    assert view.raw(BROKEN[name].replace(b"HOST", view.host.encode())) == b""


@pytest.mark.parametrize(
    ("data", "status"),
    [
        (b"GET /" + b"a" * 20_000 + b" HTTP/1.1\r\n\r\n", 414),
        (b"GET / HTTP/1.1\r\nX: " + b"a" * 20_000 + b"\r\n\r\n", 431),
        (b"GET / HTTP/1.1\r\n" + b"X: a\r\n" * 1000 + b"\r\n", 431),
    ],
    ids=["path", "header", "headers"],
)
def test_what_is_too_long_is_refused(view: Served, data: bytes, status: int) -> None:
    assert view.status(data) == status


@pytest.mark.parametrize(
    ("without", "status"),
    [("Upgrade", 426), ("Connection", 426), ("Sec-WebSocket-Key", 400), ("Sec-WebSocket-Version", 400)],
)
def test_half_a_handshake_is_refused(view: Served, without: str, status: int) -> None:
    headers = {name: UPGRADE[name] for name in UPGRADE if name != without}
    assert view.status(request(view, "GET /rows HTTP/1.1", Origin="http://HOST", **headers)) == status


@pytest.mark.parametrize(("name", "value"), [("Sec-WebSocket-Version", "8"), ("Sec-WebSocket-Key", "short")])
def test_another_websocket_is_refused(view: Served, name: str, value: str) -> None:
    headers = {**UPGRADE, "Origin": "http://HOST", name: value}
    assert view.status(request(view, "GET /rows HTTP/1.1", **headers)) in (400, 426)
