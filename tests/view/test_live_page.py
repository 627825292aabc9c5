"""The page of a robot that drives: at the newest tick, until somebody looks at another."""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest
from mindrun.robot.recording import Recorder

from mindlang.view.viewed_recording import followed_recording
from tests.view.browser import Opened, chromium
from tests.view.serving import served
from tests.view.test_following import Growing, write_rows


@pytest.fixture(scope="module")
def browser() -> Iterator[Any]:
    with chromium() as found:
        yield found


class LivePage:
    """A page, and the robot that records for it."""

    def __init__(self, day: Growing, recorder: Recorder, page: Opened) -> None:
        self.page, self._day, self._recorder = page, day, recorder
        self.ticks = 0

    def record(self, ticks: int) -> None:
        """Some ticks more."""
        write_rows(self._recorder, self._day.engine, self.ticks, self.ticks + ticks)
        self.ticks += ticks

    def wait(self, shown: int, is_live: bool) -> None:
        """Until all ticks are known and the page shows this one."""
        self.page.wait(f"document.getElementById('tick').max === '{self.ticks}'")
        self.page.wait(f"document.body.dataset.tick === '{shown}'")
        assert self.page.page.get_attribute("#live", "aria-pressed") == str(is_live).lower()


@contextmanager
def live_page(folder: Path, browser: Any) -> Iterator[LivePage]:
    """A page that is open on a robot that has recorded nothing yet."""
    day = Growing(folder)
    with (
        Recorder(day.rec, day.about, flush_every=0) as recorder,
        followed_recording(str(day.rec), day.bundle) as viewed,
        served(viewed) as view,
    ):
        page = Opened(browser, f"http://{view.host}/#{view.token}")
        yield LivePage(day, recorder, page)
        page.close()


def test_it_stays_at_the_newest_tick_without_being_asked(tmp_path: Path, browser: Any) -> None:
    with live_page(tmp_path, browser) as live:
        for ticks in (1, 2, 40, 400):
            live.record(ticks)
            live.wait(live.ticks, is_live=True)
        assert live.page.page.get_attribute("#play", "aria-label") == "pause"


def test_who_looks_at_another_tick_stays_there_until_it_is_live_again(tmp_path: Path, browser: Any) -> None:
    with live_page(tmp_path, browser) as live:
        keys = live.page.page.keyboard
        live.record(30)
        live.wait(30, is_live=True)
        keys.press("Space")
        live.record(10)
        live.wait(30, is_live=False)
        live.page.page.click("#live")
        live.wait(40, is_live=True)
        live.page.jump(7)
        live.record(10)
        live.wait(7, is_live=False)
        keys.press("End")
        live.record(10)
        live.wait(60, is_live=True)
        keys.press("ArrowLeft")
        live.record(10)
        live.wait(59, is_live=False)
        keys.press("Space")  # on from there, to the newest
        live.wait(70, is_live=False)


def test_what_is_over_has_nothing_to_stay_with(browser: Any, tmp_path: Path) -> None:
    with live_page(tmp_path, browser) as live:
        live.record(5)
        live.wait(5, is_live=True)
        Path(tmp_path / "day.rec").unlink()
        live.page.wait("document.getElementById('live').getAttribute('aria-pressed') === 'false'")
        live.wait(5, is_live=False)
