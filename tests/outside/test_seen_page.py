"""A run in an environment as `mindc view` shows it: the environment draws itself, tick by tick."""

import base64
from collections.abc import Callable
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest

pytest.importorskip("gymnasium")

from mindrun.errors import MindError

from mindlang.compiler.compile import load
from mindlang.run.setup import set_up
from mindlang.view.messages import RefusedError
from mindlang.view.viewed import Viewed
from mindlang.view.viewed_run import ViewedRun
from tests.outside import worlds
from tests.outside.test_commands import rules
from tests.view.browser import Opened, chromium
from tests.view.serving import served


def seen_run(folder: Path, world: type[worlds.Line] = worlds.Line, change: Callable[[str], str] = str) -> Viewed:
    """A run that has come to its end."""
    worlds.register()
    path = rules(folder, world)
    path.write_text(change(path.read_text(encoding="utf-8")), encoding="utf-8")
    setup = set_up(str(path), load(path), None, None)
    viewed = ViewedRun(setup, setup.rollout(), 3, {}).begun()
    while not viewed.over:
        viewed.grow()
    return viewed


def column(png: str) -> int:
    """Where the point is."""
    image: Any = cv2.imdecode(np.frombuffer(base64.b64decode(png), np.uint8), cv2.IMREAD_COLOR)
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
    failing = seen_run(tmp_path, change=lambda text: text.replace("  ends on", "  fails push 1% per tick\n  ends on"))
    assert not failing.about["drawn"]
    with pytest.raises(RefusedError):
        failing.image(1)


@pytest.mark.parametrize(("world", "visible"), [(worlds.Line, "#seen"), (worlds.Dark, "#no-world")])
def test_the_page_shows_it_or_says_why_not(tmp_path: Path, world: type[worlds.Line], visible: str) -> None:
    with chromium() as browser, served(seen_run(tmp_path, world)) as view:
        found = Opened(browser, f"http://{view.host}/#{view.token}")
        found.jump(12)
        if world is worlds.Line:
            found.wait("document.getElementById('seen').dataset.tick === '12'")
        else:
            found.wait("document.getElementById('no-world').textContent.includes('cannot be drawn')")
        assert found.page.is_visible(visible)
        found.close()
