"""What `mindc run --break` does: a run up to the first tick in which a line of a .break file stops it."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from math import isfinite
from pathlib import Path
from typing import Any, NoReturn

from rich.text import Text

from mindlang.breakpoints.watch import Stop, noticing, watcher
from mindlang.cli._breakpoint_file import breakpoints_of_run
from mindlang.cli._run_files import RunFiles
from mindlang.cli._run_session import RunChoice, RunSession
from mindlang.cli._terminal import FINDINGS, OK, console, load_compiled, print_json, procedures_talk
from mindlang.run import outcome
from mindlang.run.recorded_run import run_result
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
        made = run_result(setup, rollout, chosen.seed)
        stops = watcher(breakpoints, setup).feed(made.run)
    run, came, stopped = made.run, made.found, stopped_data(stops, str(path), made.run.graph.tick)
    if stopped and stopped["tick"] < run.ticks:
        run = run.until(stopped["tick"])
        came = outcome.data_so_far(run.task, run.lines[-1], run.events[-1], run.ticks, "a breakpoint")
    found = {"task": setup.task.name, "master": setup.master, "seed": chosen.seed, "notes": [*setup.ready.notes]}
    found = found | came | {"stopped": stopped}
    if as_json:
        print_json(found)
    else:
        console().print(stop_summary(stopped), run_summary(found), sep="\n")
    files.write(session, run, cast, found)
    sys.exit(FINDINGS if stopped else OK)


def stopped_data(stops: Sequence[Stop], file: str, tick_seconds: float) -> dict[str, Any] | None:
    """The first tick of a run in which lines of the file stop it, and which lines; None where none does."""
    if not stops:
        return None
    tick = stops[0].tick
    return {
        "tick": tick,
        "seconds": tick * tick_seconds,
        "by": [
            {
                "file": file,
                "line": stop.breakpoint.line,
                "text": stop.breakpoint.text,
                "values": {name: value if isfinite(value) else None for name, value in stop.values},
            }
            for stop in stops
            if stop.tick == tick
        ],
    }


def stop_summary(stopped: dict[str, Any] | None) -> Text:
    """Where a run stopped, and the values that made the lines true."""
    if stopped is None:
        return Text("stopped nowhere\n")
    found = Text.assemble(("stopped", "bold"), f" in tick {stopped['tick']:,}, after {stopped['seconds']:.2f} s\n")
    for each in stopped["by"]:
        found.append(f"{each['file']}:{each['line']}: {each['text']}\n")
        values = (f"{name} {'nan' if value is None else f'{value:g}'}" for name, value in each["values"].items())
        found.append("".join(f"  {value}\n" for value in values), "dim")
    return found
