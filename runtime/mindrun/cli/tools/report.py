"""Hold a recording against what the source declares of time: rate, delays, losses.

examples:
  mindrun report day.rec ball.bundle
  mindrun report day.rec ball.bundle --json
"""

import argparse
import json
from dataclasses import asdict
from pathlib import Path

from mindrun.graph.bundle import digest, read_bundle
from mindrun.robot.timing_report import report
from mindrun.terminal.standard_streams import document


def options(parser: argparse.ArgumentParser) -> None:
    """The arguments."""
    parser.add_argument("recording", type=Path, help="what mindrun --record wrote")
    parser.add_argument("bundle", type=Path, help="the bundle that was running")
    parser.add_argument("--json", action="store_true", help="one JSON document instead")


def run(options: argparse.Namespace) -> int:
    """Report and print; the exit code, 0 where the robot keeps to what training had, else 1."""
    lines = report(options.recording, digest(options.bundle), read_bundle(options.bundle).graph)
    if options.json:
        document(json.dumps({"lines": [asdict(line) for line in lines]}, indent=2) + "\n")
    else:
        width = max((len(line.what) for line in lines), default=0)
        for line in lines:
            mark = "ok " if line.kept else "NOT"
            print(f"{mark}  {line.what:<{width}}  declared {line.declared:<9}  had {line.had}")
    return 0 if all(line.kept for line in lines) else 1
