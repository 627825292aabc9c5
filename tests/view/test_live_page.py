"""The page of a robot that drives: at the newest tick, until somebody looks at another."""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from time import sleep
from typing import Any

import pytest
from mindrun.graph.bundle import Bundle
from mindrun.robot.recording import About, Recorder

from mindlang.breakpoints.resolve import breakpoints_of
from mindlang.breakpoints.watch import RecordingWatcher, recording_subject
from mindlang.compiler.source import Source
from mindlang.view.viewed_recording import followed_recording
from tests.view.browser import Opened, chromium
from tests.view.serving import Served, served
from tests.view.test_following import Growing, write_rows


@pytest.fixture(scope="module")
def browser() -> Iterator[Any]:
    with chromium() as found:
        yield found


class LivePage:
    """A page, and the robot that records for it."""

    def __init__(self, day: Growing, recorder: Recorder, view: Served, page: Opened) -> None:
        self.view, self.page, self._day, self._recorder = view, page, day, recorder
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
def live_page(folder: Path, browser: Any, breaks: str = "", ticks: int = 0) -> Iterator[LivePage]:
    """A page that is open on a robot that has recorded so many ticks, and pauses where lines of a .break file say."""
    day = Growing(folder)

    def watching(of: About, mind: Bundle) -> RecordingWatcher:
        found = breakpoints_of(Source("day.break", breaks), recording_subject(of, mind))
        return RecordingWatcher(found.breakpoints, of, mind)

    with Recorder(day.rec, day.about) as recorder:
        write_rows(recorder, day.engine, 0, ticks)
        with followed_recording(str(day.rec), day.bundle, watching) as viewed, served(viewed) as view:
            while viewed.known < ticks:
                sleep(0.01)
            page = Opened(browser, f"http://{view.host}/#{view.token}")
            live = LivePage(day, recorder, view, page)
            live.ticks = ticks
            yield live
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


def test_it_pauses_where_a_breakpoint_says_and_the_robot_drives_on(tmp_path: Path, browser: Any) -> None:
    """Those of before somebody looked are marked, and do not hold the page up."""
    breaks = "stop in tick 3\nstop in tick 34\nstop in tick 90\n"
    with live_page(tmp_path, browser, breaks, ticks=20) as live:
        live.wait(20, is_live=True)
        live.record(10)
        live.wait(30, is_live=True)
        live.record(10)
        live.wait(34, is_live=False)
        live.record(10)
        live.wait(34, is_live=False)
        assert live.page.page.inner_text("#state") == "stopped: line 2: stop in tick 34"
        live.page.page.click("#event-before")
        live.wait(3, is_live=False)
        assert live.page.page.inner_text("#state") == "stopped: line 1: stop in tick 3"
        live.page.page.click("#live")
        live.record(50)
        live.wait(90, is_live=False)


@pytest.mark.parametrize("is_live", [True, False])
def test_a_connection_that_breaks_leaves_it_where_it_was(tmp_path: Path, browser: Any, is_live: bool) -> None:
    with live_page(tmp_path, browser) as live:
        live.record(30)
        live.wait(30, is_live=True)
        if not is_live:
            live.page.jump(7)
        live.view.drop()
        live.page.wait("!document.querySelector('#notice').hidden")
        live.record(10)
        live.wait(40 if is_live else 7, is_live)


def test_what_is_over_has_nothing_to_stay_with(browser: Any, tmp_path: Path) -> None:
    with live_page(tmp_path, browser) as live:
        live.record(5)
        live.wait(5, is_live=True)
        Path(tmp_path / "day.rec").unlink()
        live.page.wait("document.getElementById('live').getAttribute('aria-pressed') === 'false'")
        live.wait(5, is_live=False)
