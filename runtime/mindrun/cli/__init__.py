"""The command line of `mindrun`, and its tools, one file each: `options` adds the arguments of one, `run` does it."""

from argparse import ArgumentParser, _ArgumentGroup
from importlib import import_module
from pathlib import Path
from pkgutil import iter_modules
from textwrap import fill

from mindrun import VERSION
from mindrun.terminal.arguments import MAX_SEED, listed_names, new_file, parser, real, whole

MAX_PORT = 65535
MAX_TICK = 2**63 - 1  # tick
EXAMPLES = "examples:\n"  # what the paragraph of a tool's help begins with that keeps its lines
LINE_COLUMNS = 80

DRIVING_EXAMPLES = """examples:
  mindrun ball.bundle                              on its robot, nothing moves
  mindrun ball.bundle --arm --record day.rec       moves, and records every tick
  mindrun ball.bundle --arm --view                 seen in a browser meanwhile
  mindrun ball.bundle --arm --view --break day.break   a page that pauses there
  mindrun ball.bundle --dry --arm                  in a simulated world
  mindrun ball.bundle --arm --drive left_wheel,right_wheel   by hand
  mindrun fetch.bundle --arm --order wanted=3      and what is typed meanwhile
  mindrun ball.bundle --describe                   what it holds
  mindrun collect.bundle --json                    the same as JSON
  mindrun collect.bundle --readings log.jsonl      a line of commands for each
  mindrun collect.bundle --readings - --fill 0.5       missing readings are 0.5
  mindrun collect.bundle --readings - --influence      with each influence
  mindrun collect.bundle --readings - --master Avoid   another skill in charge

A line of readings, in which NaN is one that failed:
{"proximity": [1, 1, 0.4], "object_bearing": 0.5}

A line of commands: {"commands": {"left_wheel": 0.7, "right_wheel": 0.5}}

tools: mindrun adopt | calibrate | doctor | order | replay | report,
each with --help"""


def driving_parser() -> ArgumentParser:
    """The parser of `mindrun FILE.bundle`."""
    about = "Let a compiled mind drive its robot, say what it holds, or run it on readings."
    known = parser("mindrun", about, DRIVING_EXAMPLES)
    known.add_argument("bundle", type=Path, metavar="FILE.bundle", help="what `mindc build` wrote")
    known.add_argument("--version", action="version", version=f"mindrun, version {VERSION}", help="say which it is")
    known.add_argument("--readings", metavar="FILE", help="JSON lines of readings by sensor name; - is standard input")
    known.add_argument("--fill", type=real(0, 1), metavar="X", help="what a sensor that a line leaves out reads")
    known.add_argument("--influence", action="store_true", help="print the influence of each skill too")
    known.add_argument("--master", metavar="SKILL", help="the skill in charge (default: the mind's master)")
    known.add_argument("--json", action="store_true", help="describe the bundle as one JSON document")
    known.add_argument("--describe", action="store_true", help="say what the bundle holds, and move nothing")
    robot = known.add_argument_group("on a robot")
    robot.add_argument("--arm", action="store_true", help="let the actuators move: without it they stay neutral")
    robot.add_argument("--record", type=new_file, metavar="FILE", help="every reading, influence and command, per tick")
    robot.add_argument("--view", action="store_true", help="show it in a browser while it drives (needs mindlang)")
    robot.add_argument(
        "--view-port", type=whole(1, MAX_PORT), metavar="P", help="of that page (default: 8123, or any that is free)"
    )
    robot.add_argument(
        "--break", dest="breaks", type=Path, metavar="FILE", help="pause that page where a line of FILE.break says"
    )
    robot.add_argument(
        "--ticks", type=whole(0, MAX_TICK), default=0, metavar="N", help="end after so many ticks (default: never)"
    )
    robot.add_argument(
        "--dry", action="store_true", help="no hardware: a run in a simulated world (needs the simulator)"
    )
    robot.add_argument("--task", metavar="TASK", help="with --dry: the task of that world (default: the master's)")
    robot.add_argument("--seed", type=whole(0, MAX_SEED), default=1, help="with --dry: the layout of that world")
    robot.add_argument("-q", "--quiet", action="store_true", help="say nothing but errors, and where a view is")
    _add_what_is_said(robot)
    return known


def _add_what_is_said(robot: _ArgumentGroup) -> None:
    """Add the options by which a person takes part."""
    robot.add_argument(
        "--order", action="append", default=[], metavar="NAME=X", help="what a sensor that is an order reads at first"
    )
    robot.add_argument(
        "--drive",
        type=listed_names,
        default=(),
        metavar="NAME,…",
        help="actuators, or skills, that a person drives",
    )


def tools() -> list[str]:
    """The names of the tools."""
    return sorted(module.name for module in iter_modules(__path__))


def tool_parser(name: str) -> ArgumentParser:
    """The parser of a tool, with its help."""
    module = import_module(f"{__name__}.{name}")
    summary, _, rest = (module.__doc__ or "").partition("\n\n")
    known = parser(f"mindrun {name}", _filled(summary), _filled(rest))
    module.options(known)
    known.set_defaults(run=module.run)
    return known


def _filled(text: str) -> str:
    """The paragraphs of a text in lines for a terminal."""
    parts = text.strip().split("\n\n")
    return "\n\n".join(part if part.startswith(EXAMPLES) else fill(part, LINE_COLUMNS) for part in parts)
