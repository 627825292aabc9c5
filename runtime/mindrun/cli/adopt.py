"""Say that this robot is wired as a bundle has it: from then on a bundle with another wiring moves nothing here.

examples:
  mindrun adopt ball.bundle
"""

import argparse
from pathlib import Path

from mindrun.errors import MindError
from mindrun.graph.bundle import read_bundle
from mindrun.robot.ownership import adopt


def options(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("bundle", type=Path, help="what `mindc build --robot` wrote")


def run(options: argparse.Namespace) -> int:
    """Adopt; the exit code, 0 where it is adopted."""
    bundle = read_bundle(options.bundle)
    wiring = bundle.wiring
    if wiring is None:
        raise MindError("this bundle is wired to no robot", "mindc build … --robot robot.yaml")
    path = adopt(wiring, bundle.graph)
    print(f"this robot is {wiring.robot}, {len(wiring.sensors)} sensors and {len(wiring.actuators)} actuators ({path})")
    return 0
