"""The reference of the language, docs/language: each word has its entry, and what an entry shows has what it is about.

tests/pages runs what the pages show.
"""

import re
from pathlib import Path
from typing import NamedTuple

import pytest

from mindlang.explaining.kinds import language_words
from tests.language.examples import ROOT

INDEX = ROOT / "docs" / "language.md"
PAGES = sorted((ROOT / "docs" / "language").glob("*.md"))
LAST = "The whole file"


class Entry(NamedTuple):
    """A heading of a page, with the text below it."""

    page: Path
    title: str
    text: str

    def __str__(self) -> str:
        return f"{self.page.stem}: {self.title}"


def entries() -> list[Entry]:
    """Those of all pages, without the one that checks the file of the page."""
    found = [(page, part) for page in PAGES for part in page.read_text(encoding="utf-8").split("\n## ")[1:]]
    return [Entry(page, *part.split("\n", 1)) for page, part in found if not part.startswith(LAST)]


def test_every_word_is_in_the_index() -> None:
    said = " , ".join(re.findall("`([^`]+)`", INDEX.read_text(encoding="utf-8")))
    assert [word for word in language_words() if f" {word} " not in f" {said} "] == []


def test_an_entry_is_in_the_index_and_shows_its_words() -> None:
    index = INDEX.read_text(encoding="utf-8")
    for entry in entries():
        anchor = re.sub(r"[^\w -]", "", entry.title.lower()).replace(" ", "-")
        assert f"(language/{entry.page.name}#{anchor})" in index
        shown = "".join(re.findall(r"^```(?:mind|diff) .*?^```", entry.text, re.DOTALL | re.MULTILINE))
        assert [word for word in re.findall("`([^`]+)`", entry.title) if word not in shown] == [], str(entry)


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_what_a_page_writes_it_checks(page: Path) -> None:
    text = page.read_text(encoding="utf-8")
    written = set(re.findall(r"^```(?:mind|diff) (\S+)", text, re.MULTILINE))
    checked = set(re.findall(r"\$ mindc check (\S+)\n    nothing wrong\n", text))
    assert written - checked - set(re.findall('use "(.+?)"', text)) == set()
    assert re.search(rf"\n## {LAST}\n\n    \$ mindc check \S+\n    nothing wrong\n\Z", text)
