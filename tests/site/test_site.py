"""The site: every page is there and is found, and none of them asks anybody else for anything."""

import re
import subprocess
import sys
from collections.abc import Iterator
from html.parser import HTMLParser
from pathlib import Path
from typing import Any
from urllib.parse import unquote, urlsplit

import pytest

from tests.project.sources import ROOT
from tests.site.serving import alone, served
from tests.view.browser import chromium

ELSEWHERE = re.compile(r"^(?:[a-z][a-z0-9+.-]*:)?//", re.IGNORECASE)
LOADING = {"src", "srcset", "data", "poster", "background", "action"}
LINKS_THAT_LOAD = {
    "stylesheet",
    "icon",
    "preload",
    "modulepreload",
    "manifest",
    "prefetch",
    "preconnect",
    "dns-prefetch",
}


class Loads(HTMLParser):
    """What a page loads as soon as it is opened."""

    def __init__(self, page: Path) -> None:
        super().__init__()
        self.found: list[str] = []
        self.feed(page.read_text(encoding="utf-8"))

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        given = {name: value or "" for name, value in attrs}
        self.found += [value for name, value in given.items() if name in LOADING]
        if tag == "link" and LINKS_THAT_LOAD & {*given.get("rel", "").split()}:
            self.found.append(given.get("href", ""))
        self.found += re.findall(r"url\(([^)]*)\)", given.get("style", ""))


def loads(folder: Path) -> Iterator[tuple[str, str]]:
    """Each page or style sheet, and what it loads."""
    for page in folder.rglob("*.html"):
        yield from ((page.name, address) for address in Loads(page).found)
    for sheet in folder.rglob("*.css"):
        text = sheet.read_text(encoding="utf-8")
        addresses = re.findall(r"url\(([^)]*)\)|@import\s+([^;]+);", text)
        yield from ((sheet.name, (one or other).strip("'\" ")) for one, other in addresses)


LONG = ("docs/index", "docs/kinds", "docs/codes", "docs/commands", "README", "examples/collect/RESULTS")


@pytest.fixture(scope="module")
def browser() -> Iterator[Any]:
    with chromium() as found:
        yield found


def test_no_page_loads_anything_from_elsewhere(site: Path) -> None:
    found = [*loads(site)]
    assert len(found) > 100
    assert [each for each in found if ELSEWHERE.match(each[1])] == []


def test_every_page_of_the_project_is_there(doctrees: Path) -> None:
    """And has nothing that Sphinx would warn of: a page in no list, a link to no page or to no heading."""
    pages = [path.relative_to(ROOT).with_suffix(".doctree") for path in (ROOT / "docs").rglob("*.md")]
    assert len(pages) > 50
    assert [page for page in pages if not (doctrees / page).exists()] == []


def test_what_a_page_loads_is_there(site: Path) -> None:
    for page in site.rglob("*.html"):
        found = (address.partition("?")[0].partition("#")[0] for address in Loads(page).found)
        local = [address for address in found if address and not address.startswith(("data:", "#"))]
        assert [each for each in local if not (page.parent / each).exists()] == []


def test_no_link_leads_to_a_source(site: Path) -> None:
    """A code host shows it; a browser would save it."""
    pages = {page: page.read_text(encoding="utf-8") for page in site.rglob("*.html")}
    assert {
        page.name: found for page, text in pages.items() if (found := re.findall(r'href="[^":]*\.md["#]', text))
    } == {}


@pytest.mark.slow
def test_every_link_leads_somewhere(whole_site: Path) -> None:
    """Links of HTML in a page, too, of which Sphinx knows nothing."""
    text = {page: page.read_text(encoding="utf-8") for page in whole_site.rglob("*.html")}
    headings = {page: {"", *re.findall(r'\s(?:id|name)="([^"]+)"', each)} for page, each in text.items()}
    for page in text:
        for link in map(urlsplit, re.findall(r'href="([^"]+)"', text[page])):
            if not link.scheme and not link.netloc:
                to = (page.parent / unquote(link.path)).resolve() if link.path else page
                assert to.is_file(), (page, link)
                assert unquote(link.fragment) in headings.get(to, {link.fragment}), (page, link)


def test_no_page_is_wider_than_a_phone(site: Path, browser: Any) -> None:
    """Code and tables that are wider scroll by themselves, below the words about them."""
    with served(site) as address, alone(browser, address) as page:
        page.set_viewport_size({"width": 390, "height": 844})
        for name in (page for page in LONG if (site / f"{page}.html").exists()):
            page.goto(f"{address}/{name}.html")
            assert page.evaluate("document.documentElement.scrollWidth") == 390, name


def test_the_playground_is_linked_where_there_is_one(site: Path, tmp_path: Path) -> None:
    (tmp_path / "site" / "playground").mkdir(parents=True)
    (tmp_path / "site" / "playground" / "index.html").touch()
    words = ["-m", "sphinx", "-Q", "-D", "include_patterns=docs/index.md", "-c", "docs", "-d", tmp_path / "doctrees"]
    subprocess.run([sys.executable, *words, ".", tmp_path / "site"], cwd=ROOT, check=True)
    there, none = ((folder / "docs" / "index.html").read_text("utf-8") for folder in (tmp_path / "site", site))
    assert "playground/index.html" in there
    assert "playground/index.html" not in none


def test_the_language_has_its_colours(site: Path) -> None:
    text = (site / "docs" / "index.html").read_text(encoding="utf-8")
    assert 'class="highlight-mind' in text
    assert '<span class="kd">skill</span>' in text
    assert '<span class="k">reads</span>' in text


def test_a_search_finds_range_finder(site: Path, browser: Any) -> None:
    with served(site) as address, alone(browser, address) as page:
        page.goto(f"{address}/docs/index.html")
        page.fill("input[name=q]", "range_finder")
        page.press("input[name=q]", "Enter")
        page.wait_for_selector("#search-results li a")
        assert "range_finder" in " ".join(page.locator("#search-results li a").all_inner_texts())
