"""Compute a recording again: the same commands, bit for bit, or the first tick that differs.

examples:
  mindrun replay day.rec ball.bundle
"""

import argparse
import sys
from pathlib import Path

from mindrun.robot.replay import replay_recording
from mindrun.terminal.standard_streams import draw
from mindrun.terminal.tick_count import ticks as in_words


def options(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("recording", type=Path, help="what mindrun --record wrote")
    parser.add_argument("bundle", type=Path, help="the bundle that was running")


def run(options: argparse.Namespace) -> int:
    """Replay and print; the exit code, 0 where every tick is the same, else 1."""
    found = replay_recording(options.recording, options.bundle, _show_progress)
    if found.differs:
        tick, what = found.differs
        print(f"tick {tick:,} differs: {what} (the same in {in_words(found.ticks)} before it)")
        return 1
    print(f"{in_words(found.ticks)}, the same to the bit")
    return 0


def _show_progress(ticks: int) -> None:
    if sys.stderr.isatty():
        draw(f"\r{ticks:,} ticks")
