"""The pages of reference in docs/ are what the program says of itself."""

import os
from xml.etree import ElementTree

import pytest

from docs.reference.pages import PAGES, pictures
from mindlang.explaining.collection import articles
from tests.project.sources import ROOT

PICTURE_BYTES = 16_000


@pytest.mark.parametrize("name", PAGES)
def test_what_is_published_is_what_the_program_says(name: str) -> None:
    published = ROOT / "docs" / name
    if os.environ.get("UPDATE"):
        published.write_text(PAGES[name](), encoding="utf-8")
    assert published.read_text(encoding="utf-8") == PAGES[name]()


@pytest.mark.parametrize("name", pictures())
def test_what_is_drawn_is_what_the_program_draws(name: str) -> None:
    drawn, published = pictures()[name](), ROOT / "docs" / name
    if os.environ.get("UPDATE"):
        published.parent.mkdir(exist_ok=True)
        published.write_text(drawn, encoding="utf-8")
    assert published.read_text(encoding="utf-8") == drawn
    assert len(drawn) < PICTURE_BYTES
    assert ElementTree.fromstring(drawn).findtext("{http://www.w3.org/2000/svg}title")


def test_no_picture_is_left_over_and_each_is_shown() -> None:
    published = {f"pictures/{path.name}" for path in (ROOT / "docs" / "pictures").iterdir()}
    assert published == set(pictures())
    text = "".join(make() for make in PAGES.values())
    assert all(f"]({name})" in text for name in published)


def test_every_article_stands_in_a_page() -> None:
    text = "".join(make() for make in PAGES.values())
    assert [each.name for each in articles() if f"\n### `{each.name}`\n\n{each.summary}\n" not in text] == []
