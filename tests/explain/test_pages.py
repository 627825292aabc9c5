"""The pages of reference in docs/ are what the program says of itself."""

import os

import pytest

from mindlang.cli._command_articles import commands_page
from mindlang.explaining.collection import articles
from mindlang.explaining.pages import PAGES
from tests.project.sources import ROOT

ALL = {**PAGES, "commands.md": commands_page}


@pytest.mark.parametrize("name", ALL)
def test_what_is_published_is_what_the_program_says(name: str) -> None:
    published = ROOT / "docs" / name
    if os.environ.get("UPDATE"):
        published.write_text(ALL[name](), encoding="utf-8")
    assert published.read_text(encoding="utf-8") == ALL[name]()


def test_every_article_stands_in_a_page() -> None:
    text = "".join(make() for make in PAGES.values())
    assert [each.name for each in articles() if f"\n### `{each.name}`\n\n{each.summary}\n" not in text] == []
