"""A real browser that opens the page of a view: playwright's, or the Chromium of this machine."""

import os
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest

HOW = "pip install -e '.[browser]' and apt-get install chromium (or: playwright install chromium)"
NAMES = ("chromium", "chromium-browser", "google-chrome")
WIDTH, HEIGHT = 1280, 720
WAIT_MILLISECONDS, POLL_MILLISECONDS = 20_000, 50


@contextmanager
def chromium() -> Iterator[Any]:
    """A browser without windows; the test is skipped where there is none."""
    playwright = pytest.importorskip("playwright.sync_api", reason=f"the page is tested in a browser: {HOW}")
    with playwright.sync_playwright() as driver:
        found = next(filter(None, map(shutil.which, NAMES)), None)
        if not found and not Path(driver.chromium.executable_path).exists():
            pytest.skip(f"there is no Chromium: {HOW}")
        alone = ["--no-sandbox"] if os.geteuid() == 0 else []  # Chromium has no sandbox for root
        browser = driver.chromium.launch(executable_path=found, args=alone)
        yield browser
        browser.close()


class Opened:
    """A page that is open, what it asked for, what it said to the server, and what went wrong in it."""

    def __init__(self, browser: Any, address: str, scheme: str = "light") -> None:
        self.context = browser.new_context(viewport={"width": WIDTH, "height": HEIGHT}, color_scheme=scheme)
        self.page = self.context.new_page()
        self.requests: list[str] = []
        self.sent: list[str] = []
        self.errors: list[str] = []
        self.page.on("request", lambda request: self.requests.append(request.url))
        self.page.on("websocket", self._listen)
        self.page.on("pageerror", lambda error: self.errors.append(str(error)))
        self.page.on("console", lambda said: self.errors.append(said.text) if said.type == "error" else None)
        self.page.goto(address)
        self.page.wait_for_selector("#hierarchy .node.master.lit, #hierarchy .node.master")

    def _listen(self, socket: Any) -> None:
        self.requests.append(socket.url)
        socket.on("framesent", lambda data: self.sent.append(str(data)))

    def close(self) -> None:
        """Close it; nothing may have gone wrong in it."""
        self.context.close()
        assert self.errors == []

    @property
    def tick(self) -> int:
        """The tick that is shown."""
        return int(self.page.input_value("#tick"))

    def jump(self, tick: int) -> None:
        """Type a tick, and wait until it is shown."""
        self.page.fill("#tick", str(tick))
        self.page.press("#tick", "Enter")
        self.page.press("#tick", "Escape")
        self.wait(f"document.body.dataset.tick === '{tick}'")

    def wait(self, condition: str) -> None:
        """Until a condition holds in the page. (Its policy forbids playwright's own waiting, which is an eval.)"""
        for _ in range(WAIT_MILLISECONDS // POLL_MILLISECONDS):
            if self.page.evaluate(condition):
                return
            self.page.wait_for_timeout(POLL_MILLISECONDS)
        raise AssertionError(condition)

    def texts(self, selector: str) -> list[str]:
        """The texts of all such elements."""
        return list(self.page.locator(selector).all_text_contents())
