"""A run with several robots on the page: each is drawn, and a click on one shows its mind in the same tick."""

from pathlib import Path

import pytest
from mindrun.sim.trace import joined, trace

from tests.sim.minds import DRIFTER
from tests.view.browser import Opened, chromium
from tests.view.serving import ViewingClient, prepared, served, simulated, unpacked

MASTERS = "Drift", "Drift", "Sway"  # of the robots
TASK = """
skill Sway is rule
  reads quick
  drives left_wheel at quick
  drives right_wheel at 0.6
task Drift in arena size 40
  contains mate is robot count 1
  contains stray is robot count 1 under Sway
  contains object is item size 1
  lasts 600 ticks
  rewards 1 on collision with mate
"""
SEED, TICK, ROBOT = 3, 200, 2
WALL_UNITS, TITLE_PIXELS, EDGE_PIXELS, SHARE = 0.8, 38, 4, 0.02  # around an arena that is seen whole


@pytest.fixture(scope="module")
def team(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("team") / "team.mind"
    path.write_text(DRIFTER + TASK)
    return path


def commands(viewer: ViewingClient, robot: int) -> bytes:
    """The bits of the commands of a robot up to the tick, as the server has them."""
    about = viewer.hear("about")
    title = f"Drift with {MASTERS[robot]} in charge, seed {SEED}, robot {robot}"
    assert (about["robot"], about["robots"], about["title"]) == (robot, len(MASTERS), title)
    assert [thing["robot"] for thing in about["world"]["things"]] == [*range(len(MASTERS)), None]
    viewer.run(TICK)
    data = viewer.frame(say="rows", **{"from": 1, "to": TICK + 1})
    singles = unpacked(data, about["doubles"], about["singles"])[4]
    _, first, count = about["columns"]["commands"]
    return bytes(singles[:TICK, first : first + count].tobytes())


def test_the_server_shows_a_run_through_another_robot_when_asked(team: Path) -> None:
    rollout = prepared(team, "Drift").rollout()
    expected = [joined(trace(rollout, SEED, robot=robot).chunks).commands[:TICK].tobytes() for robot in range(3)]
    assert len({*expected}) == len(MASTERS)
    with served(simulated(team, "Drift", SEED)) as view, view.viewer() as first, view.viewer() as second:
        assert commands(first, 0) == commands(second, 0) == expected[0]
        first.say(say="watch", robot=ROBOT)
        assert commands(first, ROBOT) == commands(second, ROBOT) == expected[ROBOT]
        first.say(say="watch", robot=3)
        assert "there is no robot 3 in Drift" in first.hear("refused")["why"]
        second.say(say="watch", robot=0)
        assert "somebody else" in second.hear("refused")["why"]


def test_a_click_on_another_robot_shows_its_mind_in_the_same_tick(team: Path) -> None:
    setup = prepared(team, "Drift")
    runs = [joined(trace(setup.rollout(), SEED, robot=robot).chunks) for robot in range(3)]
    with chromium() as browser, served(simulated(team, "Drift", SEED)) as view:
        opened = Opened(browser, f"http://{view.host}/#{view.token}")
        opened.jump(TICK)
        canvas = opened.page.locator("#world").bounding_box()
        free, units = canvas["height"] - TITLE_PIXELS - EDGE_PIXELS, 2 * (20 + WALL_UNITS + SHARE * 20)
        scale = min(canvas["width"], free) / units
        x, y = runs[ROBOT].body[TICK - 1, :2].tolist()
        place = canvas["width"] / 2 + scale * x, TITLE_PIXELS + free / 2 - scale * y
        opened.page.mouse.click(canvas["x"] + place[0], canvas["y"] + place[1])
        opened.wait(f"document.querySelector('#title').textContent.endsWith('robot {ROBOT}')")
        opened.wait(f"document.body.dataset.tick === '{TICK}'")
        opened.page.click("#hierarchy .node.actuator >> text=left_wheel")
        value = f"{float(runs[ROBOT].commands[TICK - 1, 0]):.4g}"
        opened.wait(f"document.body.innerText.includes('left_wheel is {value} at tick {TICK}')")
        opened.page.keyboard.press("r")
        opened.wait("document.querySelector('#title').textContent.endsWith('robot 0')")
        opened.close()
