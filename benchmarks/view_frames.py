"""Frames a second of the page of mindc view, for hierarchies of any size: python benchmarks/view_frames.py [--json].

Each is opened in a Chromium without windows, with all skills open, and plays; without a graphics card frames are drawn
by the processor. Needs `pip install -e '.[browser]'` and a Chromium. "open s" is from the address to the first picture.
"""

import argparse
import json
import time
from pathlib import Path
from tempfile import TemporaryDirectory

from tests.view.browser import Opened, chromium
from tests.view.serving import served, simulated

BRANCH_SKILLS, PULSE_SENSORS = 8, 7  # skills below a skill; sensors that change over time
PLAYED_MILLISECONDS = 4000
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
    lines += ["", "task Go in arena size 60", "  lasts 3000 ticks", "  rewards 0.01 * forward per tick", ""]
    return "\n".join(lines)


def measured(skills: int, folder: Path) -> dict[str, float]:
    """All figures of one size."""
    path = folder / f"tree{skills}.mind"
    path.write_text(tree(skills), encoding="utf-8")
    with served(simulated(path, "Go")) as view, chromium() as browser:
        begin = time.perf_counter()
        opened = Opened(browser, f"http://{view.host}/#{view.token}")
        found: dict[str, float] = {"skills": skills, "open s": time.perf_counter() - begin}
        opened.page.click("#play")
        found["frames/s"] = opened.page.evaluate(FRAMES, PLAYED_MILLISECONDS)
        opened.page.click("#open-all")
        found["all open, frames/s"] = opened.page.evaluate(FRAMES, PLAYED_MILLISECONDS)
        found["nodes"] = opened.page.locator("#hierarchy .node").count()
    return found


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(allow_abbrev=False, description=__doc__)
    parser.add_argument("--skills", type=int, nargs="+", default=[10, 100, 1000, 10_000])
    parser.add_argument("--json", action="store_true")
    options = parser.parse_args()
    with TemporaryDirectory() as folder:
        rows = [measured(skills, Path(folder)) for skills in options.skills]
    if options.json:
        print(json.dumps(rows))
        return
    print("  ".join(f"{name:>18}" for name in rows[0]))
    for row in rows:
        print("  ".join(f"{value:>18,.2f}" for value in row.values()))


if __name__ == "__main__":
    main()
