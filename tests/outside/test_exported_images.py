"""A run in an environment as one file: the images that fit are in it, and what is left out is said."""

import base64
import json
from pathlib import Path

import cv2
import numpy as np
import pytest

pytest.importorskip("gymnasium")

from mindlang.pictures.canvas import reduced
from mindlang.view import export
from mindlang.view.export import ExportedImages
from tests.calling import Call, caller
from tests.outside import worlds
from tests.outside.test_commands import rules
from tests.outside.test_seen_page import seen_run
from tests.view.browser import Opened, chromium
from tests.view.test_export import Page

TICKS = 30


@pytest.fixture
def mindc(capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> Call:
    worlds.register()
    return caller(capsys, monkeypatch)


def images_of(folder: Path, world: type[worlds.Line] = worlds.Line) -> ExportedImages:
    found = export.exported_images(seen_run(folder, world), lambda tick: None)
    assert found
    return found


def pixels(url: str) -> np.ndarray:
    data = base64.b64decode(url.removeprefix("data:image/webp;base64,"), validate=True)
    found = cv2.imdecode(np.frombuffer(data, np.uint8), cv2.IMREAD_COLOR)
    assert found is not None
    return found


def test_every_tick_has_its_image(tmp_path: Path) -> None:
    viewed = seen_run(tmp_path)
    found = export.exported_images(viewed, lambda tick: None)
    assert found
    assert (found.every, found.note, len(found.images)) == (1, "", TICKS + 1)
    places = [int(viewed.image(tick)[19, :, 0].argmax()) for tick in range(TICKS + 1)]
    assert [int(pixels(each)[19, :, 0].argmax()) for each in found.images] == pytest.approx(places, abs=1)
    assert len({*places}) > 3


@pytest.mark.parametrize("least", [1, 2, 7, TICKS])
def test_where_not_all_fit_those_of_a_step_do(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, least: int) -> None:
    every = images_of(tmp_path).images
    limit = sum(map(len, every)) * least // (TICKS + 1) + 200
    monkeypatch.setattr(export, "MAX_IMAGES_BYTES", limit)
    found = images_of(tmp_path)
    assert [*found.images] == [*every[:: found.every]]
    assert sum(map(len, found.images)) <= limit
    assert found.every == 1 or sum(map(len, every[:: found.every // 2])) > limit  # no more would have fitted
    assert (f"every {found.every} ticks" in found.note) == (found.every > 1)


def test_a_large_image_is_smaller_in_a_page() -> None:
    assert reduced(np.zeros((3000, 20, 3), np.uint8), 1 / 3).shape == (1000, 7, 3)


@pytest.mark.parametrize("source", ["run", "recording"])
def test_the_page_shows_each_tick_from_a_disk(mindc: Call, tmp_path: Path, source: str) -> None:
    mind, page = rules(tmp_path), tmp_path / "run.html"
    if source == "recording":
        assert mindc("run", mind, "--seed", 3, "--record", tmp_path / "run.rec").code == 0
        said = mindc("view", tmp_path / "run.rec", mind, "--export", page)
    else:
        said = mindc("view", mind, "--seed", 3, "--export", page)
    assert (said.code, "note" in said.err) == (0, False)
    with chromium() as browser:
        found = Opened(browser, page.as_uri())
        for tick in (12, 30, 3):
            found.jump(tick)
            found.wait(f"document.getElementById('seen-image').dataset.tick === '{tick}'")
        assert found.page.evaluate("document.getElementById('seen-image').naturalWidth") == 60
        assert not found.page.is_visible("#seen-earlier")
        found.close()


def test_the_page_says_which_tick_it_shows(mindc: Call, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    page = tmp_path / "run.html"
    monkeypatch.setattr(export, "MAX_IMAGES_BYTES", 4 * len(images_of(tmp_path).images[0]))
    said = mindc("view", rules(tmp_path), "--seed", 3, "--export", page)
    every = json.loads(Page(page.read_text()).scripts["recording"])["images"]["every"]
    assert f"an image of every {every} ticks" in said.err
    with chromium() as browser:
        found = Opened(browser, page.as_uri())
        found.jump(every + 1)
        found.wait("document.getElementById('seen-earlier').checkVisibility()")
        assert found.texts("#seen-earlier") == [f"as it was after tick {every}"]
        found.jump(every)
        found.wait("!document.getElementById('seen-earlier').checkVisibility()")
        found.close()


def test_an_environment_that_draws_nothing_is_exported_without_images(mindc: Call, tmp_path: Path) -> None:
    page = tmp_path / "run.html"
    said = mindc("view", rules(tmp_path, worlds.Dark), "--seed", 3, "--export", page)
    assert said.code == 0
    assert "note: the page has no images: " in said.err
    with chromium() as browser:
        found = Opened(browser, page.as_uri())
        found.wait("document.getElementById('no-world').textContent.includes('cannot be drawn')")
        assert found.page.is_visible("#no-world")
        found.close()
