"""A run in an environment as `mindc view` shows it: the environment draws itself, tick by tick."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest

pytest.importorskip("gymnasium")

from mindrun.errors import MindError

from mindlang.compiler.compile import load
from mindlang.run.setup import set_up
from mindlang.view.messages import RefusedError
from mindlang.view.viewed import Viewed
from mindlang.view.viewed_recording import viewed_recording
from mindlang.view.viewed_run import ViewedRun
from tests.calling import Call, caller
from tests.outside import worlds
from tests.outside.test_commands import RULES, rules
from tests.view.browser import Opened, chromium
from tests.view.serving import served

DIFFER = "document.getElementById('seen-image').src !== document.getElementById('seen-changed-image').src"


@pytest.fixture
def mindc(capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> Call:
    worlds.register()
    return caller(capsys, monkeypatch)


def seen_run(folder: Path, world: type[worlds.Line] = worlds.Line, text: str = RULES) -> Viewed:
    """A run that has come to its end."""
    worlds.register()
    path = rules(folder, world, text)
    setup = set_up(str(path), load(path), None, None)
    viewed = ViewedRun(setup, setup.rollout(), 3, {}).begun()
    while not viewed.over:
        viewed.grow()
    return viewed


def column(image: Any) -> int:
    """Where the point is."""
    return int(image[19, :, 0].argmax())


def test_each_tick_has_an_image_in_any_order(tmp_path: Path) -> None:
    viewed = seen_run(tmp_path)
    assert viewed.about["drawn"]
    forward = [column(viewed.image(tick)) for tick in range(viewed.known + 1)]
    assert len({*forward}) > 3
    assert [column(viewed.image(tick)) for tick in reversed(range(viewed.known + 1))] == forward[::-1]
    readings = viewed.group("readings", np.arange(1, viewed.known + 1))[:, 0]
    assert all(abs(30 + 9 * (6 * x - 3) - at) < 1.01 for x, at in zip(readings.tolist(), forward, strict=False))
    with pytest.raises(RefusedError):
        viewed.image(viewed.known + 1)


def test_what_cannot_be_drawn_is_said(tmp_path: Path) -> None:
    with pytest.raises(MindError, match="draws no pictures"):
        seen_run(tmp_path, worlds.Empty).image(1)
    failing = seen_run(tmp_path, text=RULES.replace("  ends on", "  fails push 1% per tick\n  ends on"))
    with pytest.raises(MindError, match="actuators fail"):
        failing.image(1)


@pytest.mark.parametrize(("world", "visible"), [(worlds.Line, "#seen"), (worlds.Dark, "#no-world")])
def test_the_page_shows_it_or_says_why_not(tmp_path: Path, world: type[worlds.Line], visible: str) -> None:
    with chromium() as browser, served(seen_run(tmp_path, world)) as view:
        found = Opened(browser, f"http://{view.host}/#{view.token}")
        found.jump(12)
        if world is worlds.Line:
            found.wait("document.getElementById('seen-image').dataset.tick === '12'")
        else:
            found.wait("document.getElementById('no-world').textContent.includes('cannot be drawn')")
        assert found.page.is_visible(visible)
        found.close()


def test_an_image_is_the_same_whatever_was_drawn_before(tmp_path: Path) -> None:
    viewed = seen_run(tmp_path, worlds.Sparks)
    forward = [viewed.image(tick).copy() for tick in range(viewed.known + 1)]
    for tick in (29, 29, 3, 17, 16, 30):
        assert np.array_equal(viewed.image(tick), forward[tick]), tick


def test_a_recording_is_drawn_with_what_reached_the_actuators(tmp_path: Path, mindc: Call) -> None:
    path = rules(tmp_path, text=RULES.replace("neutral 1/3", "neutral 1/3 delay 5 ticks"))
    assert mindc("run", path, "--seed", 3, "--record", tmp_path / "run.rec").code == 0
    recorded, run = viewed_recording(tmp_path / "run.rec", path), seen_run(tmp_path, text=path.read_text())
    while not recorded.over:
        recorded.grow()
    ticks = np.arange(1, run.known + 1)
    assert not np.array_equal(*(recorded.group(name, ticks) for name in ("commands", "sent")))
    assert all(np.array_equal(recorded.image(tick), run.image(tick)) for tick in (0, *ticks.tolist()))


def test_a_run_and_the_one_beside_it_are_both_seen(tmp_path: Path) -> None:
    viewed = seen_run(tmp_path)
    with chromium() as browser, served(viewed) as view:
        found = Opened(browser, f"http://{view.host}/#{view.token}")
        found.jump(4)
        found.page.locator("#hierarchy .node", has_text="Left").first.click()
        found.page.fill("#edit input[aria-label=value]", "1")
        found.page.fill("#edit input[aria-label=ticks]", "20")
        found.page.click("#edit button")
        found.wait("document.getElementById('seen-changed-image').checkVisibility()")
        found.jump(25)
        found.wait("document.getElementById('seen-image').dataset.tick === '25'")
        found.wait("document.getElementById('seen-changed-image').dataset.tick === '25'")
        assert found.page.evaluate(DIFFER)
        found.page.select_option("#forks", "0")
        found.wait("!document.getElementById('seen-changed-image').checkVisibility()")
        found.close()
