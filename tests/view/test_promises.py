"""Promises, a choice and influence over one wheel on the page: what `mindc bench` counts, and what the row says."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from mindrun.engine.promises import BY_SKILL, HELD, PromiseWatcher
from mindrun.sim.trace import trace

from mindlang.run.promises import PromiseCounts
from mindlang.view.viewed import Viewed
from mindlang.view.viewed_rows import ViewedPromises
from tests.run.test_promises import MIND, made, prepared
from tests.view.browser import Opened, chromium
from tests.view.serving import served, simulated

FEED = MIND[MIND.index("skill Feed is rule") : MIND.index("task Feed")]
CHOOSING = """\
skill Choose is rule
  reads hungry
  chooses one
  influences SeekDock at hungry
  influences SeekFood at 0.5
skill Feed is rule
  influences Choose at 1
  influences SeekFood over left_wheel at 0.1
"""
SEED = 3


@pytest.fixture(scope="module")
def mind(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("mind") / "dock.mind"
    path.write_text(MIND.replace(FEED, CHOOSING), encoding="utf-8")
    return path


@pytest.fixture
def run(mind: Path) -> Viewed:
    viewed = simulated(mind, "Feed", SEED)
    while not viewed.over:
        viewed.grow()
    return viewed


@pytest.fixture(scope="module")
def browser() -> Iterator[Any]:
    with chromium() as found:
        yield found


def promised(viewed: Viewed) -> list[tuple[str, Any]]:
    return [(node["name"], each) for node in viewed.about["nodes"] for each in node["promises"]]


def numbers(viewed: Viewed, promise: dict[str, Any], tick: int) -> list[int]:
    """The verdict of a tick, and how often it was held, broken by its skill and by those above it until then."""
    return [int(viewed.blocks.blocks[block][tick, column]) for block, column in promise["columns"]]


def test_the_last_row_counts_what_a_bench_counts(run: Viewed, mind: Path) -> None:
    setup = prepared(mind.read_text("utf-8"))
    counts = PromiseCounts(setup.ready.policy.graph, setup.master)
    counts.add(trace(setup.rollout(), SEED).chunks)
    told = {(each["skill"], each["promise"]): each for each in counts.data()}
    assert [(skill, each["text"]) for skill, each in promised(run)] == [*told]
    for skill, each in promised(run):
        found, data = numbers(run, each, run.known)[1:], told[skill, each["text"]]
        assert found == [data["held"], data.get("by_skill", 0), data["by_influence"]]
    assert sum(each["by_influence"] for each in told.values()) > 0


def test_what_begins_to_be_broken_happens(run: Viewed) -> None:
    texts = [each["text"] for each in run.about["events"]]
    for skill, each in promised(run):
        broken = [numbers(run, each, tick)[0] >= BY_SKILL for tick in range(run.known + 1)]
        event = texts.index(f"broken: {skill} {each['text']}")
        begins = [tick for tick in range(1, run.known + 1) if broken[tick] and not broken[tick - 1]]
        assert [tick for tick, number in run.happened if number == event] == begins


@pytest.mark.parametrize("parts", [[0, 1, 1, 700], [250, 251, 600]])
def test_rows_in_parts_of_any_size_are_judged_as_the_whole_is(parts: list[int]) -> None:
    setup = prepared(MIND)
    graph, ticks = setup.ready.policy.graph, made(setup, SEED)
    seen, watcher, begins = ViewedPromises(graph, setup.master), PromiseWatcher(graph, setup.master), {250, 900}
    found, verdicts = [], []
    for first, end in zip([0, *parts], [*parts, len(ticks)], strict=True):
        rows = slice(first, end)
        here = [row - first for row in sorted(begins) if first <= row < end]
        found.append(seen.feed(ticks.readings[rows], ticks.influence[rows], here)[0])
    for row in range(len(ticks)):
        if row in begins:  # whoever acted before is not asked now what came of it
            watcher.reset()
        verdicts.append(watcher.feed(ticks.readings[row : row + 1], ticks.influence[row : row + 1])[0])
    whole = np.concatenate(found).reshape(-1, len(watcher.promises), 4)
    assert np.array_equal(whole[..., 0], verdicts)
    assert np.array_equal(whole[..., 1], np.cumsum(np.array(verdicts) == HELD, axis=0))


def test_the_page_says_what_was_broken_chosen_and_over_what(run: Viewed, browser: Any) -> None:
    nodes, edges = run.about["nodes"], run.about["edges"]
    place = {node["name"]: number for number, node in enumerate(nodes)}
    promises = nodes[place["SeekDock"]]["promises"]
    ticks = next(tick for tick in range(run.known) if numbers(run, promises[0], tick)[0] == 3), run.known
    with served(run) as view:
        found = Opened(browser, f"http://{view.host}/#{view.token}")
        for tick in ticks:
            found.jump(tick)
            found.page.click(f"[data-node='{place['SeekDock']}']")
            lines = found.page.inner_text("#chosen-text").splitlines()[1:]
            marks = found.page.locator(f"[data-node='{place['SeekDock']}'] .promise")
            for each, line, mark in zip(promises, lines, marks.all(), strict=True):
                verdict, held, by_skill, above = numbers(run, each, tick)
                says = ["not judged", "held", "broken by it", "broken above it"][verdict]
                judged = held + by_skill + above
                assert line.startswith(f"{each['text']}: {says if judged else 'not judged yet'}")
                assert (f"above it in {above}" in line) == (above > 0)
                assert f"{judged} tick" in line or not judged
                classes = mark.get_attribute("class").split()
                assert ("held" in classes, "broken" in classes) == (verdict == HELD, verdict > HELD)
                assert ("before" in classes) == (by_skill + above > 0)
            found.page.click(f"[data-node='{place['Choose']}']")
            flow = run.flows.transmitted(np.array([tick]))[0]
            [chosen] = [edge for edge, of in enumerate(edges) if of["from"] == place["Choose"] and flow[edge] > 0]
            assert f"chooses one: {nodes[edges[chosen]['to']]['name']}" in found.page.inner_text("#chosen-text")
            dots = found.page.locator("#hierarchy .edge:has(.choice)").all()
            lit = [each.get_attribute("data-edge") for each in dots if "lit" in each.get_attribute("class").split()]
            assert (len(dots), lit) == (2, [str(chosen)])
        [over] = found.page.locator("#hierarchy .edge.over").all()
        found.page.evaluate(
            "number => document.querySelector(`[data-edge='${number}']`).dispatchEvent("
            "new MouseEvent('click', {bubbles: true}))",
            over.get_attribute("data-edge"),
        )
        assert "over left_wheel" in found.page.inner_text("#chosen-text")
        found.close()
