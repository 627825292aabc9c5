"""`mindc run`: one run of a task, in numbers, pictures and tables."""

from __future__ import annotations

import secrets
import sys
from dataclasses import dataclass
from math import isfinite
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from mindlang.cli import _terminal as terminal
from mindlang.cli._options import PATH, NewFile, NumberOption, RunChoice, refuse_ineffective, run_options

if TYPE_CHECKING:
    from collections.abc import Sequence

    from rich.text import Text

    from mindlang.breakpoints.watch import Stop
    from mindlang.cli._session import RunSession
    from mindlang.run.recorded_run import RecordedRun
    from mindlang.run.setup import RunSetup

EXAMPLES = """\b
Examples:
  mindc run collect.mind
  mindc run collect.mind --task GoToObject --seed 3
  mindc run collect.mind --task Collect --no-interruption --picture path.png
  mindc run collect.mind --task Collect --seed 3 --video run.mp4 --speed 4
  mindc run collect.mind --task Collect --seed 3 --video run.gif
  mindc run collect.mind --task Collect --seed 3 --trace run.csv
  mindc run collect.mind --task Collect --seed 3 --record run.rec
  mindc run collect.mind --task Collect --seed 3 --break collect.break
  mindc run collect.mind --task Avoid --seed 3 --json
  mindc run collect.mind --task Avoid --seed 1/17   of bench --seed 1
"""


@click.command(epilog=EXAMPLES)
@click.argument("file")
@run_options(seed="The same seed gives the same run. Default: drawn, and printed.")
@click.option("--picture", type=NewFile(), metavar="PATH.png", help="Draw the world and the path that the robot took.")
@click.option(
    "--video",
    type=NewFile(),
    metavar="PATH.mp4|gif",
    help="Film the world, the influence in the hierarchy and the readings. A GIF is smaller, with 10 images a second.",
)
@click.option(
    "--speed",
    type=NumberOption(0.01, 1000),
    help="Of the video. Default: a whole run takes a minute, in a GIF 20 seconds.",
)
@click.option(
    "--trace", type=NewFile(), metavar="PATH.csv", help="Write readings, influence, commands and rewards of every tick."
)
@click.option("--record", type=NewFile(), metavar="PATH.rec", help="Write a recording, for mindc view, why and whatif.")
@click.option("--break", "breaks", type=PATH, metavar="PATH.break", help="Stop where a line of it says.")
@click.option("--json", "as_json", is_flag=True, help="Print one JSON document instead.")
@click.option("-q", "--quiet", is_flag=True, help="Print nothing but results and errors.")
def command(
    file: str,
    chosen: RunChoice,
    picture: Path | None,
    video: Path | None,
    speed: float | None,
    trace: Path | None,
    record: Path | None,
    breaks: Path | None,
    as_json: bool,
    quiet: bool,
) -> None:
    """Run a task of FILE once, in numbers, pictures and tables.

    With the weights that its skills were taught. Runs the Python code of the file's procedures. Refuses skills that
    have not been taught, or whose weights belong to another declaration.

    With --break it ends in the first tick in which a line of that file holds, with 1, and says which; with 0 where none
    does.
    """
    terminal.refuse_unwritable(picture, ".png")
    terminal.refuse_unwritable(video, ".mp4", ".gif")
    terminal.refuse_unwritable(trace, ".csv", ".parquet")
    terminal.refuse_unwritable(record, ".rec")
    if video is None:
        refuse_ineffective("of --video: say it, too", "speed")
    from mindlang.cli._session import RunSession

    session, seed = RunSession(quiet), secrets.randbits(31) if chosen.seed is None else chosen.seed
    files = RunFiles(session, picture, video, speed, trace, record)
    if breaks:
        sys.exit(_run_to_breakpoint(session, file, chosen, seed, breaks, files, as_json))
    _run_to_its_end(session, file, chosen, seed, files, as_json)


def _run_to_its_end(
    session: RunSession, file: str, chosen: RunChoice, seed: int, files: RunFiles, as_json: bool
) -> None:
    from mindlang.run.outcome import run_data
    from mindlang.run.summary import run_summary

    setup, rollout = session.prepare(file, chosen)
    made = session.record(setup, rollout, seed) if files.any() else None
    came = made.found if made else run_data(setup.task, session.score(rollout, [seed])[0])
    found = _about(setup, seed, rollout.notes) | came
    terminal.print_result(as_json, found, lambda: run_summary(found))
    if made:
        files.write(made.run, setup, found)


def _run_to_breakpoint(
    session: RunSession, file: str, chosen: RunChoice, seed: int, path: Path, files: RunFiles, as_json: bool
) -> int:
    """Run until a line of the .break file at `path` stops it; print where, and what came of it; the exit code."""
    from rich.console import Group

    from mindlang.breakpoints.watch import noticing, watcher
    from mindlang.cli._session import breakpoints_of_run
    from mindlang.run.outcome import data_so_far
    from mindlang.run.recorded_run import run_result
    from mindlang.run.summary import run_summary

    compiled = terminal.load_compiled(file)
    cast = session.cast(file, compiled, chosen)
    breakpoints = breakpoints_of_run(path, compiled, cast)
    setup = noticing(cast, breakpoints)
    rollout = session.simulator(setup, chosen.interrupt)
    with terminal.procedures_talk():
        made = run_result(setup, rollout, seed)
        stopped = stopped_data(watcher(breakpoints, setup).feed(made.run), str(path), made.run.graph.tick)
    run, came = made.run, made.found
    if stopped and stopped["tick"] < run.ticks:
        run = run.until(stopped["tick"])
        came = data_so_far(run.task, run.lines[-1], run.events[-1], run.ticks, "a breakpoint")
    found = _about(setup, seed) | came | {"stopped": stopped}
    terminal.print_result(as_json, found, lambda: Group(stop_summary(stopped), run_summary(found)))
    files.write(run, cast, found)
    return terminal.FINDINGS if stopped else terminal.OK


def _about(setup: RunSetup, seed: int, notes: Sequence[str] = ()) -> dict[str, Any]:
    return {"task": setup.task.name, "master": setup.master, "seed": seed, "notes": [*setup.ready.notes, *notes]}


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
    from rich.text import Text

    if stopped is None:
        return Text("stopped nowhere\n")
    found = Text.assemble(("stopped", "bold"), f" in tick {stopped['tick']:,}, after {stopped['seconds']:.2f} s\n")
    for each in stopped["by"]:
        found.append(f"{each['file']}:{each['line']}: {each['text']}\n")
        values = (f"{name} {'nan' if value is None else f'{value:g}'}" for name, value in each["values"].items())
        found.append("".join(f"  {value}\n" for value in values), "dim")
    return found


@dataclass(frozen=True, slots=True)
class RunFiles:
    """The files that a run is written to, None for what nobody asked for, and the speed of the film."""

    session: RunSession
    picture: Path | None
    video: Path | None
    speed: float | None
    trace: Path | None
    record: Path | None

    def any(self) -> bool:
        """Whether there is something to write."""
        return bool(self.picture or self.video or self.trace or self.record)

    @terminal.procedures_talk()
    def write(self, run: RecordedRun, setup: RunSetup, found: dict[str, Any]) -> None:
        """Write what was asked for of a run of the setup, and say so."""
        from mindrun.terminal.tick_count import ticks as in_words

        if self.picture:
            self._draw(self.picture, run, found)
        if self.video:
            self._film(self.video, run, found)
        if self.trace:
            from mindlang.run.tables import trace_bytes

            with terminal.refusing(terminal.MISUSE):
                data = trace_bytes(run, self.trace.suffix.lower())
            terminal.write_file(self.trace, data)
            self.session.say(f"{self.trace}: a row for each of {in_words(run.ticks)}")
        if self.record:
            from mindlang.run.recording import run_bytes

            with terminal.refusing(terminal.MISUSE):
                data = run_bytes(run, setup, found["seed"])
            terminal.write_file(self.record, data)
            seen = "to be seen with its source or a bundle of it that has no robot"
            self.session.say(f"{self.record}: {in_words(run.ticks)}, {seen}")

    def _draw(self, path: Path, run: RecordedRun, found: dict[str, Any]) -> None:
        from mindlang.pictures.picture import png

        if run.task.scene.environment:
            from mindlang.pictures.environments import environment_picture as picture

            what = "the run as its environment draws it"
        else:
            from mindlang.pictures.picture import picture

            what = "the path of the robot"
        with terminal.refusing(terminal.MISUSE):
            drawn = picture(run, found)
        terminal.write_file(path, png(drawn))
        self.session.say(f"{path}: {what}")

    def _film(self, path: Path, run: RecordedRun, found: dict[str, Any]) -> None:
        from mindlang.pictures.film import Film

        film = Film(run, found, self.speed, path.suffix.lower())
        try:
            with terminal.refusing(terminal.MISUSE), self.session.progress() as progress:
                bar = progress.add_task(path.name, total=len(film))
                film.write(path, lambda: progress.advance(bar))
        except OSError as error:
            terminal.fail(f"{path} cannot be written: {error.strerror}", code=terminal.MISUSE)
        self.session.say(f"{path}: {film.seconds:.0f} s at {film.speed:g} times the robot's speed")
