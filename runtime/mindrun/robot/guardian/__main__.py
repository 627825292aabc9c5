"""`python -P -m mindrun.robot.guardian`: guard actuators; standard input is their plan, one line, and then frames.

With `--neutral FILE`, bring them to neutral once, and end: for systemd, after the robot has stopped.
"""

import os
from collections.abc import Callable
from pathlib import Path

from mindrun.errors import MindError, text_of
from mindrun.robot.guardian.messages import OVER, REST, say
from mindrun.robot.guardian.plan import MAX_PLAN_BYTES, Plan, from_json, read_plan
from mindrun.robot.guardian.process import Process
from mindrun.robot.guardian.realtime import printing_never_waits, set_realtime, wake_on_signals
from mindrun.robot.guardian.watch import report, rescue, watch
from mindrun.terminal.arguments import parser
from mindrun.terminal.standard_streams import ERROR_DESCRIPTOR, OUTPUT_DESCRIPTOR, LineWriter

OK, FAILED, USAGE, UNAVAILABLE, BROKEN = 0, 1, 64, 69, 70  # as in sysexits.h
INPUT_DESCRIPTOR = 0
NOBODY = -1  # in place of a descriptor


def main() -> None:
    """Guard, and end without waiting for anything that hangs."""
    known = parser("guardian", __doc__)
    known.add_argument(
        "--neutral", default="", metavar="FILE", help="bring all actuators of this bundle or plan to neutral, and end"
    )
    known.add_argument("--within", metavar="SECONDS", type=float, default=5.0, help="for --neutral (default: 5)")
    options = known.parse_args()
    set_realtime()
    status = os.dup(OUTPUT_DESCRIPTOR)
    with printing_never_waits():  # what a driver prints is no status
        code = _done(status, options.neutral, options.within)
    os._exit(code)


def _done(status: int, neutral: str, seconds: float) -> int:
    """Guard, or bring the actuators of a bundle or plan to neutral once, in so many seconds; the exit code."""
    is_heard = neutral in ("", "-")
    try:
        if is_heard:  # the plan is the first line: what follows are frames
            with open(INPUT_DESCRIPTOR, "rb", buffering=0, closefd=False) as file:
                plan = from_json(file.readline(MAX_PLAN_BYTES))
        else:
            plan = read_plan(Path(neutral))
    except MindError as error:
        say(status, "failed", " ".join(str(error).split()))
        report(str(error))
        return USAGE
    if not is_heard:  # a terminal must stay as it is
        os.close(status)
        return FAILED if rescue(plan, NOBODY, seconds) else OK
    os.set_blocking(status, False)
    if not neutral:
        return _guarded(plan, status)
    moving = rescue(plan, status, seconds)
    say(status, OVER)
    return FAILED if moving else OK


def guard(
    plan: Plan, frames: int, report: Callable[[str], None], status: Callable[[str], None], rests: Callable[[], None]
) -> int:
    """Follow the frames; however this ends, every actuator is at neutral first, and then `rests` is called."""
    process = Process(plan, frames, report, status)
    wake_on_signals(process.wake)
    code, wrong = OK, None
    try:
        wrong = process.open()
        if wrong:
            status(f"failed {'; '.join(wrong)}")
            report("; ".join(wrong))
            code = UNAVAILABLE
        else:
            process.settle()
            status("ready")
            process.serve()
    except BaseException as error:
        report(f"broken: {type(error).__name__} {text_of(error)}")
        code = BROKEN
    process.rest()
    process.settle()
    if wrong is not None:  # what was not even tried to be opened is at neutral only by chance
        rests()
    process.close()
    return code


def _guarded(plan: Plan, status: int) -> int:
    """Guard in a process of its own, which this one watches."""
    frames = os.dup(INPUT_DESCRIPTOR)
    with open(os.devnull, "rb", buffering=0) as nothing:  # noqa: PTH123  so that what a driver starts reads no frame
        os.dup2(nothing.fileno(), INPUT_DESCRIPTOR)

    def work(word: int) -> int:
        set_realtime()
        errors, states = LineWriter(ERROR_DESCRIPTOR, "guardian: "), LineWriter(status)

        def rests() -> None:
            states.drain(1.0)
            say(status, REST)
            say(word, REST)

        code = guard(plan, frames, errors, states, rests)
        errors.drain(0.2)
        return code

    return watch(plan, frames, status, work)


if __name__ == "__main__":
    main()
