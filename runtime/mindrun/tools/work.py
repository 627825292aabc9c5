"""Do jobs for a mindc on this or another machine: frames on standard input, their answers on standard output.

It is begun by mindc train and mindc bench, with --on, and ends when they do. It runs the Python code of the procedures
that it is sent: whoever can write to its standard input can run code here, as with any ssh.

examples:
  mindc train collect.mind --on ssh:a,b              begins `mindrun work` on the machines a and b
  mindc train collect.mind --on command:"docker run -i mind mindrun work --threads 4"
"""

import argparse
import os
import sys
from time import perf_counter

from mindrun.arguments import whole
from mindrun.errors import MindError
from mindrun.work.assigned import rollout_of
from mindrun.work.frame import FrameError
from mindrun.work.worker import Worker, serve

MAX_THREADS = 1024
BEGUN_BY = "it is begun by: mindc train FILE --on ssh:HOST"


def options(parser: argparse.ArgumentParser) -> None:
    """The arguments."""
    parser.add_argument("--threads", type=whole(1, MAX_THREADS), metavar="N", help="cores to use (default: all)")


def run(options: argparse.Namespace) -> int:
    """Answer frames until no more come; the exit code."""
    if sys.stdin.isatty():
        raise MindError(
            "mindrun work is begun by another program, which sends it jobs", "mindc train FILE --on ssh:a,b"
        )
    requests, answers = os.fdopen(os.dup(0), "rb"), os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)  # what a procedure or a library prints is no answer
    threads = options.threads or len(os.sched_getaffinity(0))
    try:
        serve(Worker(lambda assignment: rollout_of(assignment, threads), perf_counter), requests, answers)
    except FrameError as error:
        raise MindError(
            f"standard input is no frame: {error}", "it is begun by mindc train FILE --on ssh:a,b"
        ) from error
    except BrokenPipeError:
        return 0  # nobody waits for the answer any more
    return 0
