"""The server of a view: a page and its websocket from one port of this machine, for whoever has the token."""

import asyncio
import hmac
import json
import os
import secrets
import webbrowser
from asyncio import BaseTransport
from collections.abc import Callable, Mapping
from concurrent.futures import Future
from contextlib import suppress
from dataclasses import dataclass, field
from functools import partial
from http import HTTPStatus
from pathlib import Path
from threading import Thread
from typing import Any, cast

from mindrun.errors import MindError
from websockets.asyncio.server import Server, ServerConnection, serve
from websockets.datastructures import Headers
from websockets.exceptions import ConnectionClosed
from websockets.frames import CloseCode
from websockets.http11 import Request, Response

from mindlang.view.learning import MAX_GENERATIONS
from mindlang.view.messages import MAX_MESSAGE_BYTES, RefusedError, error_text, message, refusal
from mindlang.view.session import MAX_HAPPENED, ViewSession
from mindlang.view.viewed import Viewed

LOOPBACK = "127.0.0.1"
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
MAX_VIEWERS, MAX_PENDING = 16, 64
MAX_QUEUED_FRAMES = 4  # of what one viewer has said and nobody has read
OPEN_SECONDS, TOKEN_SECONDS, SEND_SECONDS, CLOSE_SECONDS = 5.0, 5.0, 10.0, 0.5


class PortError(MindError):
    """A port of this machine at which nothing can be served."""


class PendingConnection(ServerConnection):
    """A connection that has not sent the token yet; above MAX_PENDING of those the oldest is closed."""

    def __init__(self, pending: list[ServerConnection], *given: Any, **options: Any) -> None:
        super().__init__(*given, **options)
        self._pending = pending

    def connection_made(self, transport: BaseTransport) -> None:
        """Open it and count it as pending; close the oldest one where there are too many."""
        super().connection_made(transport)
        self._pending.append(self)
        if len(self._pending) > MAX_PENDING:
            self._pending.pop(0).transport.abort()

    def connection_lost(self, exc: Exception | None) -> None:
        super().connection_lost(exc)
        with suppress(ValueError):  # it has said the token, or was closed
            self._pending.remove(self)


@dataclass(eq=False, slots=True)
class Viewer:
    """One who sees a session: whether it may change it, and how much of each fork and training it has heard."""

    connection: ServerConnection
    edits: bool
    changed: asyncio.Event = field(default_factory=asyncio.Event)
    heard: dict[int, tuple[int, int]] = field(default_factory=dict)  # of each fork: events and stops
    number: int = -1  # of the run that it has been told about
    learnt: dict[int, tuple[int, int]] = field(default_factory=dict)  # of each training: generations and version

    async def send(self, said: bytes | dict[str, Any]) -> None:
        """Send rows or a message; who does not read for long is dropped."""
        data = said if isinstance(said, bytes) else json.dumps(said, allow_nan=False)
        try:
            async with asyncio.timeout(SEND_SECONDS):
                await self.connection.send(data)
        except TimeoutError:
            self.connection.transport.abort()
            raise


class ViewServer:
    """Serves a session; `ready` is told the address, token and all, as soon as it can be opened."""

    def __init__(self, session: ViewSession, port: int = 0) -> None:
        self.token = secrets.token_urlsafe(32)
        self.port = port
        self._session = session
        self._viewers: list[Viewer] = []
        self._pending: list[ServerConnection] = []
        session.changed = self._changed

    @property
    def address(self) -> str:
        """The address for a browser; the token behind # is never sent over the net."""
        return f"http://{LOOPBACK}:{self.port}/#{self.token}"

    async def serve(self, ready: Callable[[str], None]) -> None:
        """Serve until this is cancelled; PortError where the port cannot be had."""
        try:
            server = await self._listening()
        except OSError as error:
            why = os.strerror(error.errno or 0)
            if not self.port:
                raise PortError(f"no port of this machine can be opened: {why}") from error
            hint = "Leave --port out, and one that is free is taken."
            raise PortError(f"port {self.port} of this machine cannot be opened: {why}", hint) from error
        self.port = server.sockets[0].getsockname()[1]
        await server.start_serving()
        self._session.begin()
        watching = asyncio.create_task(self._session.watch())
        ready(self.address)
        try:
            await asyncio.get_running_loop().create_future()
        finally:
            watching.cancel()
            server.close(close_connections=False)
            await self._say_goodbye()

    async def _listening(self) -> Server:
        return await serve(
            self._handle,
            LOOPBACK,
            self.port,
            process_request=lambda _, request: http_answer(request, self.port),
            process_response=lambda _, request, response: response.headers.update(SECURITY),
            server_header=None,
            compression=None,
            create_connection=partial(PendingConnection, self._pending),  # type: ignore[arg-type]  # as good as a class
            open_timeout=OPEN_SECONDS,
            close_timeout=CLOSE_SECONDS,
            max_size=MAX_MESSAGE_BYTES,
            max_queue=MAX_QUEUED_FRAMES,
            start_serving=False,
        )

    async def _handle(self, connection: ServerConnection) -> None:
        if not await self._has_token(connection):
            await connection.close(CloseCode.POLICY_VIOLATION)
            return
        with suppress(ValueError):  # it was closed just now
            self._pending.remove(connection)
        if len(self._viewers) >= MAX_VIEWERS:
            await connection.close(CloseCode.TRY_AGAIN_LATER)
            return
        viewer = Viewer(connection, edits=not any(other.edits for other in self._viewers))
        self._viewers.append(viewer)
        telling = asyncio.create_task(self._tell(viewer))
        try:
            with suppress(ConnectionClosed, TimeoutError):
                await self._listen(viewer)
        finally:
            telling.cancel()
            self._viewers.remove(viewer)

    async def _has_token(self, connection: ServerConnection) -> bool:
        """True if the first message is the token, and comes in time."""
        try:
            async with asyncio.timeout(TOKEN_SECONDS):
                first = await connection.recv()
        except (TimeoutError, ConnectionClosed):
            return False
        return isinstance(first, str) and hmac.compare_digest(first.encode(errors="replace"), self.token.encode())

    async def _listen(self, viewer: Viewer) -> None:
        async for text in viewer.connection:
            try:
                answer = await self._session.answer(message(text), viewer.edits)
            except RefusedError as error:
                answer = refusal(text, str(error))
            except MindError as error:
                answer = refusal(text, error_text(error))
            if answer is not None:
                await viewer.send(answer)

    async def _tell(self, viewer: Viewer) -> None:
        """Tell a viewer what this is about, and whenever the forks have come farther, how far: no step by itself."""
        viewer.changed.set()
        with suppress(ConnectionClosed, TimeoutError):
            while True:
                await viewer.changed.wait()
                viewer.changed.clear()
                if viewer.number != self._session.number:
                    viewer.number, viewer.heard = self._session.number, {}
                    await viewer.send(self._session.about(viewer.edits))
                await self._tell_ticks(viewer)
                await self._tell_learnt(viewer)

    async def _tell_ticks(self, viewer: Viewer) -> None:
        fork = 0
        while viewer.number == self._session.number and fork < len(self._session.forks):
            if fork and fork not in viewer.heard:
                viewer.heard[fork] = 0, 0
                await viewer.send(self._session.forks_data[fork])
                continue  # meanwhile another run may be seen
            happened, stops = viewer.heard.get(fork, (0, 0))
            ticks = self._session.ticks(fork, happened, stops)
            news = len(ticks["happened"]), len(ticks["stops"])
            viewer.heard[fork] = happened + news[0], stops + news[1]
            await viewer.send(ticks)
            if MAX_HAPPENED in news:  # there may be more
                viewer.changed.set()
            fork += 1

    async def _tell_learnt(self, viewer: Viewer) -> None:
        learning = self._session.learning
        if learning is None:
            return
        for number, run in enumerate(learning.runs):
            heard, version = viewer.learnt.get(number, (0, 0))
            if version == run.version and heard == len(run.generations):
                continue
            told = learning.news(number, heard)
            viewer.learnt[number] = heard + len(told["generations"]), run.version
            await viewer.send(told)
            if len(told["generations"]) == MAX_GENERATIONS:  # there may be more
                viewer.changed.set()

    def _changed(self) -> None:
        for viewer in self._viewers:
            viewer.changed.set()

    async def _say_goodbye(self) -> None:
        closing = [viewer.connection.close(CloseCode.GOING_AWAY) for viewer in self._viewers]
        with suppress(TimeoutError):
            async with asyncio.timeout(CLOSE_SECONDS):
                await asyncio.gather(*closing)


def http_answer(request: Request, port: int) -> Response | None:
    """A file, or why not; None where the websocket may be opened.

    A browser that another site has led here says another host or origin: this server has no other name.
    """
    hosts = request.headers.get_all("Host")
    if len(hosts) != 1 or hosts[0] not in (f"{LOOPBACK}:{port}", f"localhost:{port}"):
        return _refusal(HTTPStatus.FORBIDDEN)
    if request.method != "GET":
        return _refusal(HTTPStatus.METHOD_NOT_ALLOWED, Allow="GET")
    if request.path == WEBSOCKET_PATH:
        own = request.headers.get_all("Origin") == [f"http://{hosts[0]}"]
        return None if own else _refusal(HTTPStatus.FORBIDDEN)
    if request.path not in FILES:
        return _refusal(HTTPStatus.NOT_FOUND)
    name, content = FILES[request.path]
    return _response(HTTPStatus.OK, (FOLDER / name).read_bytes(), content)


def _refusal(status: HTTPStatus, **headers: str) -> Response:
    return _response(status, f"{status.phrase}\n".encode(), "text/plain; charset=utf-8", **headers)


def _response(status: HTTPStatus, body: bytes, content: str, **headers: str) -> Response:
    told = {"Content-Type": content, "Content-Length": str(len(body)), "Connection": "close", **headers}
    return Response(status.value, status.phrase, Headers(told), body)


class BackgroundView:
    """A view, served at `address` until it is closed, or the program ends. PortError where no port can be had."""

    def __init__(self, viewed: Viewed) -> None:
        self._session = ViewSession(viewed)
        self._ready: Future[str] = Future()
        self._thread = Thread(target=asyncio.run, args=(self._serve(),), name="view", daemon=True)
        self._thread.start()
        self.address = self._ready.result()

    def show(self, viewed: Viewed) -> None:
        """Let all viewers see another run."""
        self._loop.call_soon_threadsafe(self._session.show, viewed)

    def close(self) -> None:
        """End it: pages keep what they have fetched."""
        if self._thread.is_alive():
            self._loop.call_soon_threadsafe(self._serving.cancel)
            self._thread.join()

    async def _serve(self) -> None:
        self._loop, self._serving = asyncio.get_running_loop(), cast("asyncio.Task[None]", asyncio.current_task())
        try:
            with suppress(asyncio.CancelledError):  # it is closed
                await ViewServer(self._session).serve(self._ready.set_result)
        except Exception as error:  # said where the view was asked for
            self._ready.set_exception(error)


def open_browser(address: str) -> bool:
    """Open a browser with windows; True if there is one: one that runs in a terminal would take over this one."""
    with suppress(webbrowser.Error):
        browser = webbrowser.get()
        if type(browser) is not webbrowser.GenericBrowser:
            Thread(target=browser.open, args=(address,), daemon=True).start()
            return True
    return False
