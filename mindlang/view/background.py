"""A view that a program serves from a thread beside its own work, and whose run it may replace."""

from __future__ import annotations

import asyncio
from concurrent.futures import Future
from contextlib import suppress
from threading import Thread

from mindlang.view.server import ViewServer
from mindlang.view.session import Session
from mindlang.view.viewed import Viewed


class BackgroundView:
    """Served at `address` until it is closed, or the program ends. PortError where no port can be had."""

    def __init__(self, viewed: Viewed) -> None:
        self._session = Session(viewed)
        self._loop = asyncio.new_event_loop()
        self._ready: Future[str] = Future()
        self._serving: asyncio.Task[None] | None = None
        self._thread = Thread(target=self._run, name="view", daemon=True)
        self._thread.start()
        self.address = self._ready.result()

    def see(self, viewed: Viewed) -> None:
        """Let all viewers see another run."""
        self._loop.call_soon_threadsafe(self._session.see, viewed)

    def close(self) -> None:
        """End it: pages keep what they have fetched."""
        if self._serving and self._thread.is_alive():
            self._loop.call_soon_threadsafe(self._serving.cancel)
            self._thread.join()

    def _run(self) -> None:
        with asyncio.Runner(loop_factory=lambda: self._loop) as runner, suppress(asyncio.CancelledError):
            runner.run(self._serve())

    async def _serve(self) -> None:
        self._serving = asyncio.current_task()
        try:
            await ViewServer(self._session).serve(self._ready.set_result)
        except Exception as error:  # said where the view was asked for
            self._ready.set_exception(error)
