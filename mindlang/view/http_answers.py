"""Requests over HTTP: who may ask for what, and what every answer says to the browser about itself."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from http import HTTPStatus
from pathlib import Path

from websockets.asyncio.server import ServerConnection
from websockets.datastructures import Headers
from websockets.http11 import Request, Response

FOLDER = Path(__file__).parent / "page"
WEBSOCKET_PATH = "/rows"
FILES: Mapping[str, tuple[str, str]] = {  # paths, their files, and what is in them
    "/": ("index.html", "text/html; charset=utf-8"),
    "/view.js": ("view.js", "text/javascript; charset=utf-8"),
    "/view.css": ("view.css", "text/css; charset=utf-8"),
}
SECURITY: Mapping[str, str] = {
    "Content-Security-Policy": "default-src 'none'; script-src 'self'; style-src 'self'; connect-src 'self'; "
    "img-src 'self' data:; base-uri 'none'; form-action 'none'; frame-ancestors 'none'",
    "X-Content-Type-Options": "nosniff",
    "Referrer-Policy": "no-referrer",
    "Cache-Control": "no-store",
    "Cross-Origin-Opener-Policy": "same-origin",
    "Cross-Origin-Resource-Policy": "same-origin",
}


@dataclass(frozen=True, slots=True)
class HttpAnswers:
    """Of a server on a port of this machine. A browser that another site has led here says another host or origin."""

    port: int

    @property
    def hosts(self) -> tuple[str, ...]:
        """What this server is called, and nothing else: a name that leads here is another site's."""
        return f"127.0.0.1:{self.port}", f"localhost:{self.port}"

    def to_request(self, connection: ServerConnection, request: Request) -> Response | None:
        """A file, or why not; None where the websocket may be opened."""
        hosts = request.headers.get_all("Host")
        if len(hosts) != 1 or hosts[0] not in self.hosts:
            return _refusal(HTTPStatus.FORBIDDEN)
        if request.method != "GET":
            return _refusal(HTTPStatus.METHOD_NOT_ALLOWED, Allow="GET")
        if request.path == WEBSOCKET_PATH:
            own = request.headers.get_all("Origin") == [f"http://{hosts[0]}"]
            return None if own else _refusal(HTTPStatus.FORBIDDEN)
        return _file(*FILES[request.path]) if request.path in FILES else _refusal(HTTPStatus.NOT_FOUND)

    def secured(self, connection: ServerConnection, request: Request, response: Response) -> None:
        """Tell the browser what the answer may do: run what comes from here, and nothing else."""
        for name, value in SECURITY.items():
            response.headers[name] = value


def _file(name: str, content: str) -> Response:
    try:
        body = (FOLDER / name).read_bytes()
    except OSError:
        return _refusal(HTTPStatus.NOT_FOUND)
    return _response(HTTPStatus.OK, body, content)


def _refusal(status: HTTPStatus, **headers: str) -> Response:
    return _response(status, f"{status.phrase}\n".encode(), "text/plain; charset=utf-8", **headers)


def _response(status: HTTPStatus, body: bytes, content: str, **headers: str) -> Response:
    told = {"Content-Type": content, "Content-Length": str(len(body)), "Connection": "close", **headers}
    return Response(status.value, status.phrase, Headers(told), body)
