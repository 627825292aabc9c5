"""Do jobs for a mindc on this or another machine: frames on standard input, their answers on standard output.

It is begun by mindc train and mindc bench, with --on, and ends when they do. It runs the Python code of the procedures
that it is sent: whoever can write to its standard input can run code here, as with any ssh.

examples:
  mindc train collect.mind --on ssh:a,b        begins it on the machines a and b
  mindc train collect.mind --on command:"docker run -i mind mindrun work"
"""

import argparse
import os
import sys
from dataclasses import replace
from pathlib import Path
from time import perf_counter
from typing import Any, NoReturn

from mindrun.errors import MindError
from mindrun.processors import cores
from mindrun.terminal import standard_streams
from mindrun.terminal.arguments import whole
from mindrun.work.assigned import drop, scorer_of
from mindrun.work.assignment import Assignment
from mindrun.work.frame import FrameError
from mindrun.work.last_step import LastStep
from mindrun.work.serving import STEP_SECONDS, Serving, own_streams
from mindrun.work.worker import Worker

MAX_THREADS = 1024
MAX_STEP_SECONDS = 86_000  # of a step of an environment
MAX_DESCRIPTOR = 1 << 20
BEGUN_BY = "it is begun by mindc train FILE --on ssh:a,b"


def options(parser: argparse.ArgumentParser) -> None:
    """The arguments."""
    parser.add_argument("--threads", type=whole(1, MAX_THREADS), metavar="N", help="cores to use (default: all)")
    parser.add_argument(
        "--folder",
        type=Path,
        metavar="PATH",
        help="where a module of an environment may stand",
    )
    parser.add_argument(
        "--step-seconds",
        type=whole(1, MAX_STEP_SECONDS),
        default=STEP_SECONDS,
        metavar="S",
        help=f"how long a step of an environment may take, before the job has failed (default: {STEP_SECONDS})",
    )
    parser.add_argument(
        "--last-step",
        type=whole(0, MAX_DESCRIPTOR),
        metavar="N",
        help="a descriptor of memory that mindc reads when this has ended: at which step of an environment it was",
    )


def run(options: argparse.Namespace) -> int:
    """Answer frames until no more come; the exit code."""
    if sys.stdin.isatty():
        raise MindError("mindrun work is begun by another program, which sends it jobs", BEGUN_BY)
    requests, answers = own_streams()
    sys.path += [f"{options.folder}"] if options.folder else []
    threads = options.threads or cores()
    seconds = options.step_seconds

    last_step = None if options.last_step is None else LastStep(options.last_step)

    def made(assignment: Assignment) -> Any:
        scorer = scorer_of(replace(assignment, folder=options.folder), threads, seconds)
        if last_step and hasattr(scorer, "write_steps"):
            scorer.write_steps(last_step)
        return scorer

    worker = Worker(made, perf_counter, drop)
    try:
        Serving(worker, answers, lambda: os._exit(0), seconds).serve(requests)
    except FrameError as error:
        raise MindError(f"standard input is no frame: {error}", BEGUN_BY) from error
    except BrokenPipeError:
        pass  # nobody waits for the answer any more
    _end()


def _end() -> NoReturn:
    """End the process, whatever threads an environment or a procedure has left: Python itself would wait for them."""
    standard_streams.finish()
    standard_streams.flush_standard_error()
    os._exit(0)
