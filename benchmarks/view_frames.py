"""Frames a second of the page of mindc view, for hierarchies of any size: python benchmarks/view_frames.py [--json].

Each is opened in a Chromium without windows and plays, then with all skills open, then with 100,000 events in its
timeline; without a graphics card frames are drawn by the processor. Needs `pip install -e '.[browser]'` and a Chromium.
"open s" is from the address to the first picture.
"""

import time
from pathlib import Path

from benchmarks.sizes import measure_sizes
from mindlang.view.viewed import Viewed
from tests.view.browser import Opened, chromium
from tests.view.serving import served, simulated

BRANCH_SKILLS, PULSE_SENSORS = 8, 7  # skills below a skill; sensors that change over time
PLAYED_MILLISECONDS = 4000
EVENT_COUNT, RUN_TICKS = 100_000, 3000
FRAMES = """milliseconds => new Promise((done) => {
  let frames = 0;
  const begin = performance.now();
  const count = (now) => {
    frames++;
    now - begin < milliseconds ? requestAnimationFrame(count) : done((1000 * frames) / (now - begin));
  };
  requestAnimationFrame(count);
})"""


def tree(skills: int) -> str:
    """A mind of rules, each with eight others below it; what they transmit changes in every tick."""
    lines = ["tick 1/60 s", "master S0", "body Robot is disc"]
    lines += [f"actuator {side} is wheel side {side} neutral 0.5" for side in ("left", "right")]
    lines += [f"sensor p{i} is sine period {i + 1} s" for i in range(PULSE_SENSORS)]
    for skill in reversed(range(skills)):
        below = range(BRANCH_SKILLS * skill + 1, min(skills, BRANCH_SKILLS * (skill + 1) + 1))
        pulse = f"p{skill % PULSE_SENSORS}"
        lines += ["", f"skill S{skill} is rule", f"  reads {pulse}"]
        lines += [f"  influences S{each} at {pulse}" for each in below]
        lines += [f"  drives {side} at {pulse}" for side in ("left", "right") if not below]
    lines += ["", "task Go in arena size 60", f"  lasts {RUN_TICKS} ticks", "  rewards 0.01 * forward per tick", ""]
    return "\n".join(lines)


def measured(skills: int, folder: Path) -> dict[str, float]:
    """All figures of one size."""
    path = folder / f"tree{skills}.mind"
    path.write_text(tree(skills), encoding="utf-8")
    found: dict[str, float] = {"skills": skills}
    with served(simulated(path, "Go")) as view, chromium() as browser:
        begin = time.perf_counter()
        opened = Opened(browser, f"http://{view.host}/#{view.token}")
        found["open s"] = time.perf_counter() - begin
        opened.page.click("#play")
        found["frames/s"] = opened.page.evaluate(FRAMES, PLAYED_MILLISECONDS)
        opened.page.click("#open-all")
        found["all open, frames/s"] = opened.page.evaluate(FRAMES, PLAYED_MILLISECONDS)
        found["nodes"] = opened.page.locator("#hierarchy .node").count()
    with served(eventful(simulated(path, "Go"))) as view, chromium() as browser:
        opened = Opened(browser, f"http://{view.host}/#{view.token}")
        opened.page.click("#play")
        found["100,000 events, frames/s"] = opened.page.evaluate(FRAMES, PLAYED_MILLISECONDS)
    return found


def eventful(viewed: Viewed) -> Viewed:
    """The run to its end, with events in every tick."""
    while not viewed.over:
        viewed.grow()
    viewed.happened = [(1 + RUN_TICKS * number // EVENT_COUNT, 0) for number in range(EVENT_COUNT)]
    return viewed


if __name__ == "__main__":
    measure_sizes(__doc__, [10, 100, 1000, 10_000], measured)
