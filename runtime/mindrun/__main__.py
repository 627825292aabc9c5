"""`mindrun FILE.bundle`: drive the robot to which it is wired; without wiring say what it holds, or run it on readings.

Needs numpy alone. `mindrun replay`, `report`, `calibrate`, `adopt`,
`order` and `doctor` are in `cli/`.
"""

import argparse
import json
import os
import sys
from collections.abc import Callable, Iterator
from contextlib import redirect_stdout
from itertools import count
from math import isnan
from typing import Any

from mindrun.cli import driving_parser, tool_parser, tools
from mindrun.engine.engine import Engine
from mindrun.errors import MindError, ProcedureError, ReadingsError, surroundings
from mindrun.files.printable import visible
from mindrun.graph.bundle import read_bundle
from mindrun.graph.describe import contents, describe
from mindrun.graph.named_readings import vector
from mindrun.graph.wiring import read_by
from mindrun.terminal import standard_streams
from mindrun.terminal.arguments import emptiness

OK, FAILED, MISUSE, INTERRUPTED = 0, 1, 2, 130
MAX_LINE_CHARACTERS = 1 << 20  # of one line of readings
WORK = "work"  # was a tool
INSTEAD_OF_WORK = (
    "Dask's workers do its jobs: dask worker --scheduler-file scheduler.json, for mindc train --on dask:scheduler.json"
)


def main() -> None:
    """Run the command line; whatever happens ends in one message and an exit code."""
    standard_streams.prepare(standard_streams.Printable)
    code = guarded(_command)
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


def _command() -> int:
    """Run a tool, or drive; the exit code."""
    words = sys.argv[1:]
    if flaw := emptiness(words):
        raise MindError(flaw, "write something there, or leave it out")
    if words[:1] == [WORK]:
        raise MindError(f"there is no mindrun {WORK} any more", INSTEAD_OF_WORK)
    if words and words[0] in tools():
        options = tool_parser(words[0]).parse_args(words[1:])
        return int(options.run(options))
    return run(driving_parser().parse_args())


def run(options: argparse.Namespace) -> int:
    """Drive, describe or run the bundle; the exit code."""
    if options.view and (options.readings or options.describe or options.json):
        raise MindError("--view shows a robot that drives: with --readings, --describe or --json none does")
    if options.view_port and not options.view:
        raise MindError("--view-port is the port of --view, which was not asked for")
    if options.breaks and not options.view:
        raise MindError("--break pauses the page of --view, which was not asked for; nothing pauses the robot")
    bundle = read_bundle(options.bundle)
    if options.order and (options.readings or options.describe or options.json):
        raise MindError("--order is for a robot that drives: with --readings, --describe or --json none does")
    if options.drive and (options.readings or options.describe or options.json):
        raise MindError("--drive is for a robot that drives: with --readings, --describe or --json none does")
    if options.readings:
        with redirect_stdout(sys.stderr):  # what a procedure prints is no command
            engine = Engine(bundle.policy, bundle.procedures, options.master)
        _run(engine, options)
    elif options.dry or (bundle.wiring and not options.describe and not options.json):
        from mindrun.robot.drive import run as drive

        standard_streams.detach_standard_error()
        with redirect_stdout(sys.stderr):  # a procedure may print
            return drive(options, bundle)
    elif options.arm or options.record or options.ticks or options.view or options.order or options.drive:
        raise MindError("this bundle is wired to no robot", "mindc build … --robot robot.yaml, or try it with --dry")
    elif options.json:
        standard_streams.document(_json(contents(bundle), indent=2))
    else:
        print(describe(bundle))
    return OK


def _run(engine: Engine, options: argparse.Namespace) -> None:
    """Print a line of commands per line of readings, each at once: a robot may wait; end where nobody takes them."""
    names = [actuator.name for actuator in engine.graph.actuators]
    skills = [skill.name for skill in engine.graph.skills]
    needed = read_by(engine.graph, options.master or engine.graph.master)
    for where, given in _lines(options.readings):
        try:
            with redirect_stdout(sys.stderr):
                commands = engine.tick(vector(engine.graph, given, options.fill, needed))
        except ReadingsError as error:
            raise ReadingsError(f"{where}: {error}") from error
        line: dict[str, Any] = {"commands": dict(zip(names, commands.tolist(), strict=True))}
        if options.influence:
            influence = (None if isnan(number) else number for number in engine.influence.tolist())
            line["influence"] = dict(zip(skills, influence, strict=True))
        standard_streams.document(_json(line))
        if standard_streams.output_failure():
            break
    if engine.faults:
        what = "1 output was" if engine.faults == 1 else f"{engine.faults} outputs were"
        print(f"{what} not sent, because a number was not finite", file=sys.stderr)


def _lines(name: str) -> Iterator[tuple[str, dict[str, Any]]]:
    """The place of each line that is not empty, for messages, and its JSON object; ReadingsError where it is none."""
    source = "standard input" if name == "-" else name
    try:
        with open(0 if name == "-" else name, encoding="utf-8", closefd=name != "-") as file:
            for number in count(1):
                if not (text := file.readline(MAX_LINE_CHARACTERS)):
                    return
                if not text.strip():
                    continue
                where = f"{source}, line {number}"
                try:
                    given = json.loads(text)
                except (ValueError, RecursionError) as error:
                    raise ReadingsError(f'{where}: write readings as {{"sensor": 0.5}} ({error})') from error
                if not isinstance(given, dict):
                    raise ReadingsError(f'{where}: write readings as {{"sensor": 0.5}}')
                yield where, given
    except UnicodeDecodeError as error:
        raise ReadingsError(f"{source} is not UTF-8 text") from error
    except OSError as error:
        raise ReadingsError(f"cannot read {name}: {error.strerror}") from error


def _json(value: object, indent: int | None = None) -> str:
    return json.dumps(value, indent=indent, ensure_ascii=False) + "\n"


def _say(message: str, hint: str = "", code: int = FAILED) -> int:
    print(f"mindrun: {visible(message)}", file=sys.stderr)
    if hint:
        print(f"  {visible(hint)}", file=sys.stderr)
    return code


if __name__ == "__main__":
    main()
