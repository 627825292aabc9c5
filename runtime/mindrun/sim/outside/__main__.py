"""`python -m mindrun.sim.outside --last-step DESCRIPTOR`: a process that steps environments, and may end by them."""

import os
import sys

from mindrun.sim.outside.answering import Answering
from mindrun.work.last_step import LastStep
from mindrun.work.serving import Serving, own_streams
from mindrun.work.worker import MAX_SILENT_SECONDS

STEP_SECONDS = MAX_SILENT_SECONDS // 2  # nobody is in a hurry but who looks on, who stops it


def main() -> None:
    """Answer frames until no more come."""
    requests, answers = own_streams()
    last_step = LastStep(int(sys.argv[2]))
    Serving(Answering(last_step), answers, lambda: os._exit(0), STEP_SECONDS).serve(requests)
    os._exit(0)  # whatever threads an environment has left


if __name__ == "__main__":
    main()
