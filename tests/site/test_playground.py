"""The playground in a real browser: what is typed is answered, and nothing is asked of anybody but its server."""

import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from tests.project.sources import ROOT
from tests.site.building import built_playground
from tests.site.serving import alone, served
from tests.view.browser import chromium

pytestmark = pytest.mark.slow  # Python starts in the page: ten seconds, and thirty where npm installs first

WANDERER = (ROOT / "examples" / "braitenberg.mind").read_text(encoding="utf-8")
NOTHING_WRONG = "nothing wrong"
START_MILLISECONDS = 60_000


@pytest.fixture(scope="module")
def site(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return built_playground(tmp_path_factory.mktemp("playground"))


@pytest.fixture(scope="module")
def browser() -> Iterator[Any]:
    with chromium() as found:
        yield found


@pytest.fixture(scope="module")
def opened(site: Path, browser: Any) -> Iterator[Any]:
    """The page, with Python started and its first text answered."""
    with served(site) as address, alone(browser, address) as page:
        page.goto(f"{address}/playground/index.html")
        answered(page, NOTHING_WRONG, START_MILLISECONDS)
        yield page


def answered(page: Any, words: str, milliseconds: int = 20_000) -> None:
    """Wait until the page says so of its text."""
    page.locator("#state", has_text=re.compile(f"^{re.escape(words)}$")).wait_for(timeout=milliseconds)


def typed(page: Any, text: str) -> None:
    """Put a text in the place of the one that is there, as a user does."""
    page.locator(".cm-content").click()
    page.keyboard.press("ControlOrMeta+a")
    page.keyboard.insert_text(text)


def shown(page: Any) -> str:
    """The text in the editor, of which it draws what can be seen."""
    return "\n".join(page.locator(".cm-line").all_inner_texts())


def test_a_mistake_stands_below_its_line_with_what_to_do(opened: Any) -> None:
    typed(opened, WANDERER.replace("drives left_wheel", "drives left_whel", 1))
    answered(opened, "1 mistake")
    below = opened.locator(".below")
    assert "Did you mean left_wheel?" in below.locator(".words.error").inner_text()
    line = below.locator("xpath=preceding-sibling::*[1]").inner_text()
    assert "left_whel" in line
    assert opened.locator(".underlined.error").all_inner_texts() == ["left_whel"]


def test_what_lint_finds_is_told_as_well(opened: Any) -> None:
    typed(opened, f"{WANDERER}\nsensor spare is range_finder\n")
    answered(opened, "1 finding")
    assert "unread-sensor" in opened.locator(".words.warning").inner_text()


def test_the_hierarchy_follows_the_text_and_leads_to_it(opened: Any) -> None:
    typed(opened, WANDERER.replace("Shy", "Timid"))
    answered(opened, NOTHING_WRONG)
    assert sorted(opened.locator("#hierarchy .node.skill .name").all_text_contents()) == [
        "MoveForward",
        "Timid",
        "Turn",
        "Wander",
    ]
    assert opened.locator("#hierarchy .node.master .name").all_text_contents() == ["Wander"]
    opened.locator("#hierarchy .node.skill", has_text="Timid").click()
    assert opened.locator(".cm-activeLine").inner_text().startswith("skill Timid is rule")


def test_tidy_writes_it_as_fmt_does(opened: Any) -> None:
    typed(opened, WANDERER.replace("  drives", "      drives"))
    opened.locator("#tidy:not([disabled])").click()
    opened.locator("#tidy[disabled]").wait_for()
    assert [line for line in shown(opened).splitlines() if "  drives" in line]
    assert "      drives" not in shown(opened)


def test_a_link_has_the_whole_text_in_it(opened: Any) -> None:
    typed(opened, WANDERER.replace("Shy", "Schüchtern"))
    opened.locator("#share").click()
    opened.locator("#share", has_text="Link copied").wait_for()
    link = opened.url
    assert "#text=" in link
    other = opened.context.new_page()
    other.goto(link)
    other.locator(".cm-line", has_text="skill Schüchtern is rule").wait_for()
    other.close()


def test_a_broken_link_leaves_the_first_example(opened: Any) -> None:
    other = opened.context.new_page()
    other.goto(f"{opened.url.partition('#')[0]}#text=nonsense")
    other.locator(".cm-line", has_text="Wander").first.wait_for()
    other.close()


def test_every_example_can_be_chosen(opened: Any) -> None:
    titles = opened.locator("#examples option").all_inner_texts()
    assert len(titles) > 3
    for title in titles[::-1]:
        opened.select_option("#examples", label=title)
        answered(opened, NOTHING_WRONG)


def test_once_loaded_it_works_without_a_network(site: Path, browser: Any) -> None:
    with served(site) as address, alone(browser, address) as page:
        page.goto(f"{address}/playground/index.html")
        answered(page, NOTHING_WRONG, START_MILLISECONDS)
        page.context.set_offline(True)
        typed(page, WANDERER.replace("drives left_wheel", "drives left_whel", 1))
        answered(page, "1 mistake")
        page.locator("#share").click()
        page.locator("#share", has_text="Link copied").wait_for()


@pytest.mark.parametrize("width", [1280, 390])
def test_nothing_stands_beyond_the_edge(opened: Any, width: int) -> None:
    opened.set_viewport_size({"width": width, "height": 800})
    typed(opened, WANDERER.replace("drives left_wheel", "drives left_whel", 1))
    answered(opened, "1 mistake")
    assert opened.evaluate("document.documentElement.scrollWidth") <= width
    for name in ("#tidy", "#share", "#theme", "#examples", "#state", ".words .message", ".words code"):
        place = opened.locator(name).bounding_box()
        assert place["x"] >= 0
        assert place["x"] + place["width"] <= width
