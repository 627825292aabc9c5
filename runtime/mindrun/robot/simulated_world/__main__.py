"""`python -P -m mindrun.robot.simulated_world --task T --socket PATH BUNDLE`: a simulated world, behind a socket.

It says `ready` on its standard output, or in one line what is wrong; `drivers/simulated.py` talks to it.
"""

import argparse
import os
import signal
import sys
from importlib import import_module
from math import isfinite
from pathlib import Path

from mindrun.errors import MindError
from mindrun.robot.parent_process import end_with_parent
from mindrun.robot.simulated_world.scene import SEED_COUNT, SimulatedScene, SimulatedWorld
from mindrun.robot.simulated_world.server import Server, listening


def main() -> None:
    """Simulate a world until the parent process ends."""
    options = _options()
    end_with_parent(os.getppid(), signal.SIGTERM)
    try:
        _run(options)
    except MindError as error:
        print(f"{error}; {error.hint}" if error.hint else error, flush=True)
        sys.exit(2)
    except KeyboardInterrupt:
        sys.exit(130)


def _run(options: argparse.Namespace) -> None:
    world = _world(options)
    server = Server(SimulatedScene(world, options.again))
    signal.signal(signal.SIGTERM, server.end)
    with listening(options.socket) as listener:
        print("ready", flush=True)
        server.serve(listener, world.graph.tick / options.speed)


def _world(options: argparse.Namespace) -> SimulatedWorld:
    """The world of a bundle. Here alone the simulator is imported: a robot has none."""
    from mindrun.graph.bundle import read_bundle

    try:
        simulator = import_module("mindrun.sim.commanded_world")
    except ImportError as error:
        raise MindError(f"there is no simulator here ({error})", "pip install mindlang") from error
    graph = read_bundle(options.bundle).graph
    try:
        world: SimulatedWorld = simulator.World(graph, options.task, options.seed, options.master or None)
    except MemoryError as error:
        raise MindError(f"this computer has too little memory for task {options.task}") from error
    return world


def _options() -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        "mindrun.robot.simulated_world", description="A simulated world, behind a socket.", allow_abbrev=False
    )
    parser.add_argument("bundle", type=Path, metavar="FILE.bundle")
    parser.add_argument("--task", required=True, help="the task whose world it is")
    parser.add_argument("--socket", required=True, type=Path, metavar="PATH")
    parser.add_argument("--seed", type=_seed, default=0, help="of the layout (default: 0)")
    parser.add_argument("--speed", type=_speed, default=1.0, help="times real time (default: 1)")
    parser.add_argument("--master", default="", help="the skill in charge (default: the mind's master)")
    parser.add_argument("--again", action="store_true", help="begin another world when a run ends")
    return parser.parse_args()


def _seed(text: str) -> int:
    if not 0 <= int(text) < SEED_COUNT:
        raise argparse.ArgumentTypeError(f"{text} is not a seed")
    return int(text)


def _speed(text: str) -> float:
    if not (isfinite(float(text)) and float(text) > 0):
        raise argparse.ArgumentTypeError(f"{text} is not a speed above 0")
    return float(text)


if __name__ == "__main__":
    main()
