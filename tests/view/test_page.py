"""The page in a real browser: it shows the run, tick by tick, and nothing that is in it can do anything."""

import json
from collections.abc import Iterator
from itertools import cycle
from pathlib import Path
from typing import Any

import pytest

from mindlang.run.edge_flow import edge_flows
from mindlang.run.recorded_run import record_run
from mindlang.view.messages import AskShares, RefusedError
from mindlang.view.session import command_shares
from mindlang.view.viewed import Viewed
from tests.calling import write_rules
from tests.view.browser import Opened, chromium
from tests.view.serving import prepared, served, simulated

LONG_NAME = 1_000_000
HOSTILE = [
    "<img src=x onerror=\"document.title='taken'\">",
    "<script>document.title='taken'</script>",
    "\u202egnp.exe",
    "</text></svg><svg onload=\"document.title='taken'\">",
    "javascript:document.title='taken'",
    "a" * LONG_NAME,
]
OWN_IMAGES = "#seen-image, #seen-changed-image"  # of environments


@pytest.fixture(scope="module")
def browser() -> Iterator[Any]:
    with chromium() as found:
        yield found


@pytest.fixture(scope="module")
def mind(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return write_rules(tmp_path_factory.mktemp("mind"))


@pytest.fixture
def opened(browser: Any, mind: Path) -> Iterator[Opened]:
    with served(simulated(mind)) as view:
        found = Opened(browser, f"http://{view.host}/#{view.token}")
        yield found
        found.close()


def test_opens_with_the_hierarchy_and_asks_nobody_else(opened: Opened, mind: Path) -> None:
    graph = prepared(mind, "Chase").ready.policy.graph
    names = {opened.page.locator(f"#hierarchy [data-node='{i}']").count() for i in range(len(graph.sensors))}
    assert names == {0}  # sensors are in the lists, not in the picture
    shown = " ".join(opened.texts("#hierarchy .node text"))
    assert all(skill.name in shown for skill in graph.skills if skill.name == graph.master)
    assert all(actuator.name in shown for actuator in graph.actuators)
    opened.page.click("#play")
    opened.wait("Number(document.querySelector('#tick').value) > 5")
    host = opened.page.url.split("/#")[0].removeprefix("http://")
    assert opened.requests
    for url in opened.requests:
        assert url.startswith((f"http://{host}/", f"ws://{host}/rows", "data:,")), url


def test_plays_pauses_steps_and_jumps(opened: Opened) -> None:
    page = opened.page
    page.keyboard.press("Space")
    opened.wait("Number(document.querySelector('#tick').value) > 10")
    page.keyboard.press("Space")
    opened.wait("document.querySelector('#play').getAttribute('aria-label') === 'play'")
    opened.jump(300)
    for key, tick in (("ArrowRight", 301), ("Shift+ArrowRight", 311), ("ArrowLeft", 310), ("Shift+ArrowLeft", 300)):
        page.keyboard.press(key)
        opened.wait(f"document.querySelector('#timeline').getAttribute('aria-valuenow') === '{tick}'")
    page.keyboard.press("Home")
    opened.wait("document.querySelector('#timeline').getAttribute('aria-valuenow') === '0'")
    page.keyboard.press("+")
    opened.wait("document.querySelector('#rate').value === '2'")
    box = page.locator("#timeline").bounding_box()
    page.mouse.click(box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
    opened.wait("Number(document.querySelector('#timeline').getAttribute('aria-valuenow')) > 400")


def test_a_click_on_an_edge_shows_what_the_engine_says_it_transmits(opened: Opened, mind: Path) -> None:
    setup = prepared(mind, "Chase")
    run = record_run(setup, setup.rollout(True), 3)
    flows = edge_flows(setup.ready.policy, {}, setup.master, run)
    edges = [int(str(each.get_attribute("data-edge"))) for each in opened.page.locator("#hierarchy .edge").all()]
    assert sorted(edges) == [*range(len(flows.links))]
    found, engine = [], []
    for tick in (1, 37, 640, 1100):
        opened.jump(tick)
        for edge, transmitted in enumerate(flows.flow_at(range(tick - 1, tick)).transmitted[0]):
            opened.page.locator(f"#hierarchy [data-edge='{edge}']").focus()
            opened.page.keyboard.press("Enter")
            opened.wait(f"document.querySelector('#hierarchy .selected')?.dataset.edge === '{edge}'")
            opened.page.evaluate("new Promise(requestAnimationFrame)")
            found.append(float(str(opened.page.get_attribute("#chosen-text", "data-value"))))
            engine.append(float(transmitted))
    assert found == engine
    assert any(value > 0 for value in engine)


def test_a_curve_that_is_chosen_is_asked_for_and_drawn(opened: Opened) -> None:
    opened.page.fill("#curves-search", "reward")
    opened.page.locator("#curves-choice input:not(:checked)").first.click()
    opened.wait("document.querySelectorAll('#curves-choice input:checked').length > 1")
    opened.page.evaluate("new Promise(done => setTimeout(done, 1000))")
    asked = [json.loads(said)["columns"] for said in opened.sent if '"columns"' in said]
    about = simulated_columns(opened)
    assert about in asked[-1]


def simulated_columns(opened: Opened) -> list[int]:
    """The address of the first reward line's column, as the server of this page has it."""
    return list(opened.page.evaluate(ASK_ABOUT)["columns"]["rewards"][:2])


ASK_ABOUT = """() => new Promise((done) => {
  const socket = new WebSocket(`ws://${location.host}/rows`);
  socket.onopen = () => socket.send(location.hash.slice(1));
  socket.onmessage = ({ data }) => { socket.close(); done(JSON.parse(data)); };
})"""


def test_a_search_finds_what_is_listed_and_shows_where_it_is(opened: Opened) -> None:
    name = opened.texts("#hierarchy .node.actuator text")[0]
    opened.page.keyboard.press("/")
    opened.page.keyboard.type(name)
    opened.wait(f"document.querySelector('#active .name')?.textContent === {json.dumps(name)}")
    opened.page.keyboard.press("Enter")
    opened.wait("!!document.querySelector('#hierarchy .selected.actuator')")
    assert name in opened.page.inner_text("#chosen-text")


def test_an_actuator_says_which_paths_its_command_comes_from(opened: Opened) -> None:
    opened.jump(640)
    opened.page.locator("#hierarchy .node.actuator").first.click()
    opened.wait("document.querySelectorAll('#why .path').length > 0")
    assert "tick 640" in opened.page.inner_text("#why .sum")
    command = float(str(opened.page.get_attribute("#why .sum", "title")))
    titles = [str(each.get_attribute("title")) for each in opened.page.locator("#why .numbers").all()]
    shares = [float(title.rsplit("share ", 1)[1]) for title in titles]
    assert sum(shares) == pytest.approx(command, abs=1e-6)
    assert command == float(str(opened.page.get_attribute("#chosen-text", "data-value")))


def test_a_network_that_grew_is_drawn(browser: Any, mind: Path) -> None:
    viewed = simulated(mind)
    [name] = [node["name"] for node in viewed.about["nodes"] if node["master"]]
    nodes = [
        {"name": each, "role": role} for each, role in (("eye", "reading"), ("neuron 1", "neuron"), ("m", "output"))
    ]
    viewed.about = {
        **viewed.about, "links": [{"skill": name, "nodes": nodes, "links": [[0, 1, 2.5], [1, 1, -1.0], [1, 2, 4.0]]}]
    }  # fmt: skip
    with served(viewed) as view:
        found = Opened(browser, f"http://{view.host}/#{view.token}")
        assert not found.page.is_visible("#links")
        found.page.click("#hierarchy .node.master")
        assert found.texts("#links .node text") == [each["name"] for each in nodes]
        assert found.texts("#links .link.below title") == ["neuron 1 \u2192 neuron 1: -1"]
        found.page.click("#links")
        assert found.page.locator("#links.large").count() == 1
        found.page.click("#links")
        found.page.click("#hierarchy .node.actuator")
        assert not found.page.is_visible("#links")
        found.close()


def test_a_value_that_is_changed_makes_a_run_beside_this_one(opened: Opened, mind: Path) -> None:
    graph = prepared(mind, "Chase").ready.policy.graph
    skill = next(skill.name for skill in graph.skills if skill.name != graph.master)
    opened.jump(100)
    opened.page.fill("#search", skill)
    opened.page.press("#search", "Enter")
    opened.page.fill("#edit input[aria-label=value]", "0")
    opened.page.click("#edit button")
    opened.wait("document.querySelectorAll('#forks option').length === 2 && !document.querySelector('#forks').hidden")
    assert skill in opened.texts("#forks option")[1]
    [said] = [json.loads(said) for said in opened.sent if '"change"' in said]
    assert (said["tick"], said["what"], said["value"]) == (100, "influence", 0)
    opened.wait("document.querySelector('#forks').value === '1'")
    opened.jump(400)
    assert any(json.loads(said).get("fork") == 1 for said in opened.sent if '"rows"' in said)


def test_what_no_path_has_made_of_a_command_is_said(opened: Opened, monkeypatch: pytest.MonkeyPatch) -> None:
    def answered(viewed: Viewed, asked: AskShares) -> dict[str, Any]:
        more = {"rest": 0.125, "rest_paths": 7, "rounding": -2e-5}
        return command_shares(viewed, asked) | more | ({"paths": [], "neutral": 0.5} if asked.tick == 641 else {})

    monkeypatch.setattr("mindlang.view.session.command_shares", answered)
    opened.jump(640)
    opened.page.locator("#hierarchy .node.actuator").first.click()
    opened.wait("document.querySelectorAll('#why .note').length === 2")
    assert "0.125 over 7 other paths" in opened.page.inner_text("#why")
    assert "rounding" in opened.page.inner_text("#why")
    opened.jump(641)
    opened.wait("document.querySelector('#why').innerText.includes('nothing influences it: its neutral, 0.5')")


def test_a_subtree_is_collapsed_and_opened(opened: Opened) -> None:
    before = opened.page.locator("#hierarchy .node").count()
    opened.page.locator("#hierarchy .master .fold").click()
    assert opened.page.locator("#hierarchy .node").count() == 1
    opened.page.locator("#hierarchy .master .fold").click()
    assert opened.page.locator("#hierarchy .node").count() == before


def test_help_names_every_key(opened: Opened) -> None:
    opened.page.keyboard.press("?")
    assert opened.page.locator("#keys[open] tr").count() > 10
    opened.page.click("#close-keys")
    assert opened.page.locator("#keys[open]").count() == 0


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_colours_are_the_systems_until_somebody_chooses(browser: Any, mind: Path, scheme: str) -> None:
    with served(simulated(mind)) as view:
        found = Opened(browser, f"http://{view.host}/#{view.token}", scheme)
        assert found.page.get_attribute("html", "data-theme") == scheme
        found.page.click("#theme")
        found.page.reload()
        found.wait("!!document.querySelector('#hierarchy .node')")
        assert found.page.get_attribute("html", "data-theme") != scheme
        found.close()


def test_names_do_nothing_whatever_they_are(browser: Any, mind: Path) -> None:
    viewed = simulated(mind)
    viewed.about = renamed(dict(viewed.about), cycle(HOSTILE))
    with served(viewed) as view:
        found = Opened(browser, f"http://{view.host}/#{view.token}")
        found.jump(100)
        for node in found.page.locator("#hierarchy .node").all():
            node.focus()
            found.page.keyboard.press("Enter")
        found.page.evaluate("new Promise(done => setTimeout(done, 500))")
        assert found.page.title().endswith("mind view")  # the scripts would have set another
        assert found.page.locator(f"body img:not({OWN_IMAGES}), body script, foreignObject").count() == 0
        assert found.page.locator(OWN_IMAGES).evaluate_all("them => them.map(one => one.src)") == ["", ""]
        assert "\u202e" not in found.page.inner_text("body")
        assert len(found.page.inner_text("body")) < 20_000
        found.close()


def renamed(said: Any, names: Iterator[str], key: str = "") -> Any:
    """What a server says, with hostile names and texts in all places."""
    match said:
        case dict():
            return {name: renamed(each, names, name) for name, each in said.items()}
        case list() | tuple():
            return [renamed(each, names, key) for each in said]
        case str() if key in ("name", "text", "says", "title", "task", "master", "rewards", "ends"):
            return next(names)
    return said


def test_at_a_hundred_times_it_ends_where_the_run_ends(opened: Opened) -> None:
    opened.page.select_option("#rate", "100")
    opened.page.click("#play")
    opened.wait("document.querySelector('#state').textContent.includes('1200 ticks')")
    opened.wait("document.querySelector('#play').getAttribute('aria-label') === 'play'")
    opened.wait("document.querySelector('#timeline').getAttribute('aria-valuenow') === '1200'")
    opened.jump(613)  # between those that were shown
    assert opened.tick == 613


def test_a_connection_that_breaks_is_said_and_made_again_where_one_was(browser: Any, mind: Path) -> None:
    with served(simulated(mind)) as view:
        found = Opened(browser, f"http://{view.host}/#{view.token}")
        found.jump(100)
        view.drop()
        found.wait("!document.querySelector('#notice').hidden")
        assert "does not answer" in found.page.inner_text("#notice")
        found.page.keyboard.press("ArrowRight")  # what is here is still shown
        found.wait("document.body.dataset.tick === '101'")
        found.wait("document.querySelector('#notice').hidden")
        found.jump(900)
        found.close()


def test_a_view_that_has_ended_can_still_be_looked_at(browser: Any, mind: Path) -> None:
    with served(simulated(mind)) as view:
        found = Opened(browser, f"http://{view.host}/#{view.token}")
        found.jump(100)
    found.wait("!document.querySelector('#notice').hidden")
    found.page.keyboard.press("ArrowLeft")
    found.wait("document.body.dataset.tick === '99'")
    found.context.close()  # what could not be fetched is an error of the browser's


def test_another_token_is_told_what_to_do(browser: Any, mind: Path) -> None:
    with served(simulated(mind)) as view:
        page = browser.new_page()
        page.goto(f"http://{view.host}/#{view.token[:-1]}")
        page.wait_for_selector("#notice:not([hidden])")
        assert "open the one that mindc view has printed last" in page.inner_text("#notice")
        page.close()


def test_what_was_refused_is_said_and_asked_again(browser: Any, mind: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    with served(simulated(mind)) as view:
        found = Opened(browser, f"http://{view.host}/#{view.token}")
        found.jump(100)

        def refused(*_: object) -> bytes:
            raise RefusedError("not today")

        with monkeypatch.context() as patch:
            patch.setattr(Viewed, "rows", refused)
            patch.setattr(Viewed, "some_columns", refused)
            found.page.fill("#tick", "1000")
            found.page.press("#tick", "Enter")
            found.page.press("#tick", "Escape")
            found.wait("document.querySelector('#notice').textContent === 'not today'")
            found.page.click("#curves-choice li:last-child input")
        found.wait("document.body.dataset.tick === '1000'")
        found.close()


def test_a_second_page_says_that_another_may_change_the_run(opened: Opened, browser: Any) -> None:
    second = Opened(browser, opened.page.url)
    assert opened.page.inner_text("#source") == "simulation"
    assert second.page.inner_text("#source") == "simulation, another page may change it"
    second.close()


def test_why_is_asked_again_after_a_connection_that_broke(browser: Any, mind: Path) -> None:
    with served(simulated(mind)) as view:
        found = Opened(browser, f"http://{view.host}/#{view.token}")
        found.jump(640)
        found.page.locator("#hierarchy .node.actuator").first.click()
        found.wait("document.querySelectorAll('#why .path').length > 0")
        asked = sum('"why"' in said for said in found.sent)
        view.drop()
        found.wait("!document.querySelector('#notice').hidden")
        found.wait("document.querySelector('#notice').hidden")
        found.wait("document.body.dataset.tick === '640'")
        for _ in range(400):
            if sum('"why"' in said for said in found.sent) > asked:
                break
            found.page.wait_for_timeout(50)
        assert sum('"why"' in said for said in found.sent) > asked
        found.close()


def test_why_says_why_it_cannot(opened: Opened, monkeypatch: pytest.MonkeyPatch) -> None:
    def refused(*_: object) -> None:
        raise RefusedError("nobody knows")

    monkeypatch.setattr("mindlang.view.session.command_shares", refused)
    opened.jump(640)
    opened.page.locator("#hierarchy .node.actuator").first.click()
    opened.wait("document.querySelector('#why').textContent === 'nobody knows'")


def test_many_events_are_marked_and_gone_to(browser: Any, mind: Path) -> None:
    viewed = simulated(mind)
    while not viewed.over:
        viewed.grow()
    viewed.happened = [(tick, 0) for tick in range(1, 1200, 3) for _ in range(100)]
    with served(viewed) as view:
        found = Opened(browser, f"http://{view.host}/#{view.token}")
        found.jump(600)
        for key, tick in (("]", 601), ("]", 604), ("[", 601), ("[", 598)):
            found.page.keyboard.press(key)
            found.wait(f"document.body.dataset.tick === '{tick}'")
        found.close()


def test_a_window_that_gets_another_size_shows_all(opened: Opened) -> None:
    for width, height in ((700, 900), (1600, 500), (1280, 720)):
        opened.page.set_viewport_size({"width": width, "height": height})
        opened.wait("document.querySelector('#world').width === document.querySelector('#world').clientWidth")
        assert opened.page.evaluate("document.documentElement.scrollWidth <= innerWidth")
        assert opened.page.is_visible("#play")
    box, play = opened.page.locator("footer").bounding_box(), opened.page.locator("#play").bounding_box()
    assert play["y"] + play["height"] <= box["y"] + box["height"] + 1


def test_what_has_no_world_is_shown_without_one(browser: Any, mind: Path) -> None:
    viewed = simulated(mind)
    viewed.about = {**viewed.about, "world": None}
    with served(viewed) as view:
        found = Opened(browser, f"http://{view.host}/#{view.token}")
        found.jump(100)
        assert found.page.is_visible("#no-world")
        assert found.page.locator("#hierarchy .node.lit").count() > 0
        found.page.keyboard.press("0")
        found.page.keyboard.press("f")
        found.close()
