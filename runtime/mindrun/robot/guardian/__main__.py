"""`python -P -m mindrun.robot.guardian`: guard actuators; standard input is their plan, one line, and then frames.

With `--neutral FILE`, bring them to neutral once, and end: for systemd, after the robot has stopped.
"""

import argparse
import os
from pathlib import Path
from time import monotonic, sleep

from mindrun.errors import MindError
from mindrun.line_writer import LineWriter
from mindrun.robot.guardian.plan import DRIVERS, MAX_PLAN_BYTES, Plan, from_json, read_plan
from mindrun.robot.guardian.process import Process
from mindrun.robot.guardian.realtime import import_little, set_realtime, wake_on_signals

OK, FAILED, USAGE, UNAVAILABLE, BROKEN = 0, 1, 64, 69, 70  # as in sysexits.h
INPUT_DESCRIPTOR, OUTPUT_DESCRIPTOR, ERROR_DESCRIPTOR = 0, 1, 2
RETRY_SECONDS = 0.05  # between two tries to open what could not be


def main() -> None:
    """Guard, and end without waiting for anything that hangs."""
    options = _options()
    if options.neutral in (None, "-"):  # a bundle needs all drivers to be read
        import_little(DRIVERS)
    set_realtime()
    errors = LineWriter(ERROR_DESCRIPTOR, "guardian: ")
    status = LineWriter(os.dup(OUTPUT_DESCRIPTOR))
    os.dup2(ERROR_DESCRIPTOR, OUTPUT_DESCRIPTOR)  # what a driver prints is no status
    try:
        plan = _plan(options.neutral or "-")
    except MindError as error:
        errors(str(error))
        status(f"failed {error}")
        code = USAGE
    else:
        if options.neutral:
            code = bring(Process(plan, INPUT_DESCRIPTOR, errors), errors, options.within)
        else:
            code = guard(plan, errors, status)
    errors.flush(0.2)
    status.flush(0.2)
    os._exit(code)  # a thread that hangs in a device's write would never be joined


def guard(plan: Plan, report: LineWriter, status: LineWriter) -> int:
    """Follow the frames on standard input; however this ends, every actuator is at neutral first."""
    process = Process(plan, INPUT_DESCRIPTOR, report, status)
    wake_on_signals(process.wake)
    code = OK
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
        process.rest()
        report(f"broken: {type(error).__name__} {error}")
        code = BROKEN
    process.rest()
    process.settle()
    process.close()
    return code


def bring(process: Process, report: LineWriter, seconds: float) -> int:
    """Bring all that can be opened to neutral; whether that was all, and in time."""
    wake_on_signals(process.wake)  # whoever tells it to end is told that it does, when it is done
    until = monotonic() + seconds
    while (wrong := process.open()) and monotonic() < until:  # a bus that is busy is free again
        sleep(RETRY_SECONDS)
    if not process.settle(max(until - monotonic(), RETRY_SECONDS)):
        wrong.append(f"not everything was at neutral after {seconds:g} s")
    process.close()
    for line in wrong:
        report(line)
    return FAILED if wrong else OK


def _plan(path: str) -> Plan:
    """The plan in a file, or on standard input up to the end of the first line: what follows are frames."""
    if path != "-":
        return read_plan(Path(path))
    with open(INPUT_DESCRIPTOR, "rb", buffering=0, closefd=False) as file:
        return from_json(file.readline(MAX_PLAN_BYTES))


def _options() -> argparse.Namespace:
    parser = argparse.ArgumentParser("guardian", description=__doc__, allow_abbrev=False)
    parser.add_argument(
        "--neutral", metavar="FILE", help="bring all actuators of this bundle or plan to neutral, and end"
    )
    parser.add_argument("--within", metavar="SECONDS", type=float, default=5.0, help="for --neutral (default: 5)")
    return parser.parse_args()


if __name__ == "__main__":
    main()
