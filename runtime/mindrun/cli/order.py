"""Say an order to a robot that is driven on this machine, or to a dry run.

It counts until another one is said, or for the `timeout` of its sensor.

examples:
  mindrun order wanted 3
  mindrun order pace 0.5 --process 4711
"""

import argparse

from mindrun.robot.order_client import say_order
from mindrun.terminal.arguments import whole

MAX_PROCESS = 2**31 - 1


def options(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("name", metavar="NAME", help="the sensor that is the order")
    parser.add_argument("value", metavar="VALUE", help="which of several, or 0 for none of them; or a number")
    parser.add_argument(
        "--process",
        type=whole(1, MAX_PROCESS),
        default=0,
        metavar="N",
        help="which one drives, where there are several",
    )


def run(options: argparse.Namespace) -> int:
    """Say it; the exit code, 0 where it was taken."""
    print(say_order(options.name, options.value, options.process))
    return 0
