"""`mindrun FILE.bundle`: drive the robot to which it is wired; without wiring say what it holds, or run it on readings.

Needs numpy alone. `mindrun replay`, `report`, `calibrate` and `doctor` are in `tools/`.
"""

import argparse
import json
import os
import sys
from collections.abc import Callable, Iterator
from contextlib import redirect_stdout
from pathlib import Path
from typing import Any

from mindrun import VERSION, arguments, standard_streams
from mindrun.arguments import MAX_SEED, new_file, real, whole
from mindrun.bundle import read_bundle
from mindrun.describe import contents, describe
from mindrun.engine import Engine
from mindrun.errors import MindError, ProcedureError, ReadingsError, surroundings
from mindrun.named_readings import vector
from mindrun.printable import visible
from mindrun.tools import run_tool, tools
from mindrun.wiring import read_by

OK, FAILED, MISUSE, INTERRUPTED = 0, 1, 2, 130
MAX_LINE_CHARACTERS = 1 << 20  # of one line of readings
MAX_PORT = 65535
MAX_TICK = 2**63 - 1  # tick

EXAMPLES = """examples:
  mindrun ball.bundle                                       on its robot, nothing moves yet
  mindrun ball.bundle --arm --record day.rec                everything moves, and every tick is recorded
  mindrun ball.bundle --arm --view                          and seen in a browser while it drives
  mindrun ball.bundle --arm --view --break day.break        the page pauses where a line holds, the robot never
  mindrun ball.bundle --dry --arm                           in a simulated world, without hardware
  mindrun ball.bundle --describe                            what it holds (a bundle without wiring does this anyway)
  mindrun collect.bundle --json                             the same as JSON
  mindrun collect.bundle --readings log.jsonl               one line of commands for each line of readings
  mindrun collect.bundle --readings - --fill 0.5            readings from standard input, missing ones 0.5
  mindrun collect.bundle --readings - --influence           with the influence of each skill
  mindrun collect.bundle --readings - --master Avoid        another skill in charge

A line of readings: {"proximity": [1, 1, 0.4], "object_bearing": 0.5}; NaN is a reading that failed.
A line of commands: {"commands": {"left_wheel": 0.7, "right_wheel": 0.5}}

tools: mindrun adopt | calibrate | doctor | replay | report | work, each with --help"""


def main() -> None:
    """Run the command line; whatever happens ends in one message and an exit code."""
    standard_streams.prepare(standard_streams.Printable)
    tool = len(sys.argv) > 1 and sys.argv[1] in tools()
    code = guarded((lambda: run_tool(sys.argv[1], sys.argv[2:])) if tool else (lambda: run(_options())))
    if why := standard_streams.finish():
        _say(why)
        code = code or FAILED
    standard_streams.flush_standard_error()
    sys.exit(code)


def guarded(command: Callable[[], int]) -> int:
    """The exit code of a command, whatever happens in it."""
    try:
        return command()
    except SystemExit as stop:
        return stop.code if isinstance(stop.code, int) else OK
    except ProcedureError as error:
        return _say(str(error), error.hint, FAILED)
    except MindError as error:
        return _say(str(error), error.hint, MISUSE)
    except KeyboardInterrupt:
        return INTERRUPTED
    except Exception as error:
        if os.environ.get("MIND_DEBUG"):
            raise
        if why := surroundings(error):
            return _say(why)
        return _say(f"failed: {type(error).__name__}: {error}", "Set MIND_DEBUG=1 to see where, and please report it.")


def run(options: argparse.Namespace) -> int:
    """Drive, describe or run the bundle; the exit code."""
    _refuse_view_of_nothing(options)
    bundle = read_bundle(options.bundle)
    if options.readings:
        with redirect_stdout(sys.stderr):  # what a procedure prints is no command
            engine = Engine(bundle.policy, bundle.procedures, options.master)
        _run(engine, options)
    elif options.dry or (bundle.wiring and not options.describe and not options.json):
        return drive(options)
    elif options.arm or options.record or options.ticks or options.view:
        raise MindError("this bundle is wired to no robot", "mindc build … --robot robot.yaml, or try it with --dry")
    elif options.json:
        standard_streams.document(_json(contents(bundle), indent=2))
    else:
        print(describe(bundle))
    return OK


def _refuse_view_of_nothing(options: argparse.Namespace) -> None:
    """MindError where a view is asked for that would show no robot."""
    if options.view and (options.readings or options.describe or options.json):
        raise MindError("--view shows a robot that drives: with --readings, --describe or --json none does")
    if options.view_port and not options.view:
        raise MindError("--view-port is the port of --view, which was not asked for")
    if options.breaks and not options.view:
        raise MindError("--break pauses the page of --view, which was not asked for; nothing pauses the robot")


def drive(options: argparse.Namespace) -> int:
    """Drive the robot, or a simulated one."""
    from mindrun.robot.command import run as run_robot

    standard_streams.detach_standard_error()
    with redirect_stdout(sys.stderr):  # a procedure may print
        return run_robot(options)


def _options() -> argparse.Namespace:
    about = "Let a compiled mind drive its robot, say what it holds, or run it on readings."
    parser = arguments.parser("mindrun", about, EXAMPLES)
    parser.add_argument("bundle", type=Path, metavar="FILE.bundle", help="what `mindc build` wrote")
    parser.add_argument("--version", action="version", version=f"mindrun, version {VERSION}", help="say which it is")
    parser.add_argument("--readings", metavar="FILE", help="JSON lines of readings by sensor name; - is standard input")
    parser.add_argument("--fill", type=real(0, 1), metavar="X", help="what a sensor that a line leaves out reads")
    parser.add_argument("--influence", action="store_true", help="print the influence of each skill too")
    parser.add_argument("--master", metavar="SKILL", help="the skill in charge (default: the mind's master)")
    parser.add_argument("--json", action="store_true", help="describe the bundle as one JSON document")
    parser.add_argument("--describe", action="store_true", help="say what the bundle holds, and move nothing")
    robot = parser.add_argument_group("on a robot")
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
    return parser.parse_args()


def _run(engine: Engine, options: argparse.Namespace) -> None:
    """Print one line of commands per line of readings, each at once: a robot may be waiting for it.

    Where nobody takes them any more it ends.
    """
    source = _source(options.readings)
    names = [actuator.name for actuator in engine.graph.actuators]
    skills = [skill.name for skill in engine.graph.skills]
    needed = read_by(engine.graph, options.master or engine.graph.master)
    for number, given in _lines(options.readings):
        try:
            with redirect_stdout(sys.stderr):
                commands = engine.tick(vector(engine.graph, given, options.fill, needed))
        except ReadingsError as error:
            raise ReadingsError(f"{source}, line {number}: {error}") from error
        line: dict[str, Any] = {"commands": dict(zip(names, commands.tolist(), strict=True))}
        if options.influence:
            line["influence"] = dict(zip(skills, engine.influence.tolist(), strict=True))
        standard_streams.document(_json(line))
        if standard_streams.lost():
            break
    if engine.faults:
        what = "1 output was" if engine.faults == 1 else f"{engine.faults} outputs were"
        print(f"{what} not sent, because a number was not finite", file=sys.stderr)


def _lines(name: str) -> Iterator[tuple[int, dict[str, Any]]]:
    """The number and the object of each line that is not empty."""
    try:
        with open(0 if name == "-" else name, encoding="utf-8", closefd=name != "-") as file:
            number = 0
            while text := file.readline(MAX_LINE_CHARACTERS):
                number += 1
                if text.strip():
                    yield number, _object(text, f"{_source(name)}, line {number}")
    except UnicodeDecodeError as error:
        raise ReadingsError(f"{_source(name)} is not UTF-8 text") from error
    except OSError as error:
        raise ReadingsError(f"cannot read {name}: {error.strerror}") from error


def _source(name: str) -> str:
    return "standard input" if name == "-" else name


def _object(text: str, where: str) -> dict[str, Any]:
    try:
        value = json.loads(text)
    except (ValueError, RecursionError) as error:
        raise ReadingsError(f'{where}: write readings as {{"sensor": 0.5}} ({error})') from error
    if not isinstance(value, dict):
        raise ReadingsError(f'{where}: write readings as {{"sensor": 0.5}}')
    return value


def _json(value: object, indent: int | None = None) -> str:
    return json.dumps(value, indent=indent, ensure_ascii=False) + "\n"


def _say(message: str, hint: str = "", code: int = FAILED) -> int:
    print(f"mindrun: {visible(message)}", file=sys.stderr)
    if hint:
        print(f"  {visible(hint)}", file=sys.stderr)
    return code


if __name__ == "__main__":
    main()
