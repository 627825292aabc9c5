"""What `mindc run --break` does: a run up to the first tick in which a line of a .break file stops it."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import NoReturn

from mindlang.breakpoints.report import stop_summary, stopped_data
from mindlang.breakpoints.watch import noticing, watcher
from mindlang.cli._breakpoint_file import breakpoints_of_run
from mindlang.cli._run_files import RunFiles
from mindlang.cli._run_session import RunChoice, RunSession
from mindlang.cli._terminal import FINDINGS, OK, console, load_compiled, print_json, procedures_talk
from mindlang.run import outcome
from mindlang.run.course import course
from mindlang.run.summary import run_summary


def run_to_breakpoint(
    session: RunSession, file: str, chosen: RunChoice, path: Path, files: RunFiles, as_json: bool
) -> NoReturn:
    """Run until a line of the file at `path` stops it, print where and what has come of it, and end the program."""
    compiled = load_compiled(file)
    cast = session.cast(file, compiled, chosen.task, chosen.master)
    breakpoints = breakpoints_of_run(path, compiled, cast)
    setup = noticing(cast, breakpoints)
    rollout = session.simulator(setup, chosen.interrupt)
    with procedures_talk():
        made = course(setup, rollout, chosen.seed)
        stops = watcher(breakpoints, setup).feed(made.run)
    run, came, stopped = made.run, made.found, stopped_data(stops, str(path), made.run.graph.tick)
    if stopped and stopped["tick"] < run.ticks:
        run = run.until(stopped["tick"])
        came = outcome.data_so_far(run) | {"ended_by": "a breakpoint"}
    found = {"task": setup.task.name, "master": setup.master, "seed": chosen.seed, "notes": [*setup.ready.notes]}
    found = found | came | {"stopped": stopped}
    if as_json:
        print_json(found)
    else:
        console().print(stop_summary(stopped), run_summary(found), sep="\n")
    files.write(session, run, cast, found)
    sys.exit(FINDINGS if stopped else OK)
