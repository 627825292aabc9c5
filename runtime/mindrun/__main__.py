"""`python -m mindrun FILE.bundle`: say what a bundle holds, or run it on readings. Needs numpy alone."""

import argparse
import json
import os
import sys
from collections.abc import Iterator
from contextlib import redirect_stdout
from math import nan
from pathlib import Path
from typing import Any

from mindrun.bundle import read_bundle
from mindrun.describe import contents, describe
from mindrun.engine import Engine
from mindrun.errors import MindError, ProcedureError, ReadingsError
from mindrun.readings import vector

OK, FAILED, MISUSE, INTERRUPTED = 0, 1, 2, 130
LONGEST = 1 << 20  # characters of one line of readings

EXAMPLES = """examples:
  mindrun collect.bundle                                    what it holds
  mindrun collect.bundle --json                             the same as JSON
  mindrun collect.bundle --readings log.jsonl               one line of commands for each line of readings
  mindrun collect.bundle --readings - --fill 0.5            readings from standard input, missing ones 0.5
  mindrun collect.bundle --readings - --influence           with the influence of each skill
  mindrun collect.bundle --readings - --master Avoid        another skill in charge

A line of readings: {"proximity": [1, 1, 0.4], "object_bearing": 0.5}; NaN is a reading that failed.
A line of commands: {"commands": {"left_wheel": 0.7, "right_wheel": 0.5}}"""


def main() -> None:
    """Run the command line; whatever happens ends in one message and an exit code."""
    sys.exit(run(_options()))


def run(options: argparse.Namespace) -> int:
    """Describe or run the bundle; the exit code."""
    try:
        bundle = read_bundle(options.bundle)
        if options.readings:
            with redirect_stdout(sys.stderr):  # what a procedure prints is no command
                engine = Engine(bundle.graph, bundle.weights, bundle.procedures, options.master)
            _run(engine, options)
        else:
            print(json.dumps(contents(bundle), indent=2, ensure_ascii=False) if options.json else describe(bundle))
        sys.stdout.flush()
    except ProcedureError as error:
        return _said(error, FAILED)
    except MindError as error:
        return _said(error, MISUSE)
    except BrokenPipeError:  # the reader, `head` say, has seen enough
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    except OSError as error:
        return _said(error, FAILED)
    except KeyboardInterrupt:
        return INTERRUPTED
    return OK


def _options() -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        "mindrun",
        description="Say what a compiled mind holds, or run it on readings.",
        epilog=EXAMPLES,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("bundle", type=Path, metavar="FILE.bundle", help="what `mindc build` wrote")
    parser.add_argument("--readings", metavar="FILE", help="JSON lines of readings by sensor name; - is standard input")
    parser.add_argument("--fill", type=_share, metavar="X", help="what a sensor that a line leaves out reads")
    parser.add_argument("--influence", action="store_true", help="print the influence of each skill too")
    parser.add_argument("--master", metavar="SKILL", help="the skill in charge (default: the mind's master)")
    parser.add_argument("--json", action="store_true", help="describe the bundle as one JSON document")
    return parser.parse_args()


def _share(text: str) -> float:
    try:
        value = float(text)
    except ValueError:
        value = nan
    if not 0 <= value <= 1:
        raise argparse.ArgumentTypeError(f"{text} is not a number from 0 to 1")
    return value


def _run(engine: Engine, options: argparse.Namespace) -> None:
    """Print one line of commands per line of readings, each at once: a robot may be waiting for it."""
    source = _source(options.readings)
    names = [actuator.name for actuator in engine.graph.actuators]
    skills = [skill.name for skill in engine.graph.skills]
    for number, given in _lines(options.readings):
        try:
            with redirect_stdout(sys.stderr):
                commands = engine.tick(vector(engine.graph, given, options.fill))
        except ReadingsError as error:
            raise ReadingsError(f"{source}, line {number}: {error}") from error
        line: dict[str, Any] = {"commands": dict(zip(names, commands.tolist(), strict=True))}
        if options.influence:
            line["influence"] = dict(zip(skills, engine.influence.tolist(), strict=True))
        print(json.dumps(line, ensure_ascii=False), flush=True)
    if engine.faults:
        what = "1 output was" if engine.faults == 1 else f"{engine.faults} outputs were"
        print(f"{what} not sent, because a number was not finite", file=sys.stderr)


def _lines(name: str) -> Iterator[tuple[int, dict[str, Any]]]:
    """The number and the object of each line that is not empty."""
    try:
        with open(0 if name == "-" else name, encoding="utf-8", closefd=name != "-") as file:
            number = 0
            while text := file.readline(LONGEST):
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


def _said(error: Exception, code: int) -> int:
    print(f"mindrun: {error}", file=sys.stderr)
    return code


if __name__ == "__main__":
    main()
