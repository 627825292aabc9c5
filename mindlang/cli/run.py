"""`mindc run`: one run of a task, in numbers, pictures and tables.

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

from __future__ import annotations

import secrets
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from mindlang.cli import _options as options
from mindlang.cli import _terminal as terminal
from mindlang.number_format import finite

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from rich.text import Text

    from mindlang.breakpoints.watch import Stop
    from mindlang.cli._session import RunSession
    from mindlang.run.recorded_run import RecordedRun
    from mindlang.run.setup import RunSetup

WRITTEN = {"picture": (".png",), "video": (".mp4", ".gif"), "trace": (".csv", ".parquet"), "record": (".rec",)}


@click.command
@click.argument("file")
@options.run_options(seed="The same seed gives the same run. Default: drawn, and printed.")
@options.written("--picture", "PATH.png", "Draw the world and the path that the robot took.")
@options.written(
    "--video",
    "PATH.mp4|gif",
    "Film the world, the influence in the hierarchy and the readings. A GIF is smaller, with 10 images a second.",
)
@click.option(
    "--speed",
    type=options.NumberOption(0.01, 1000),
    help="Of the video. Default: a whole run takes a minute, in a GIF 20 seconds.",
)
@options.written("--trace", "PATH.csv", "Write readings, influence, commands and rewards of every tick.")
@options.written("--record", "PATH.rec", "Write a recording, for mindc view, why and whatif.")
@click.option("--break", "breaks", type=options.PATH, metavar="PATH.break", help="Stop where a line of it says.")
@options.json_flag()
@options.quiet_flag()
def command(file: str, chosen: options.RunChoice, breaks: Path | None, **said: Any) -> None:
    """Run a task of FILE once, in numbers, pictures and tables.

    With the weights that its skills were taught. Runs the Python code of the file's procedures. Refuses skills that
    have not been taught, or whose weights belong to another declaration.

    With --break it ends in the first tick in which a line of that file holds, with 1, and says which; with 0 where none
    does.
    """
    for name, suffixes in WRITTEN.items():
        terminal.refuse_unwritable(said[name], *suffixes)
    if said["video"] is None:
        options.refuse_ineffective("of --video: say it, too", "speed")
    from mindlang.cli._session import RunSession

    sys.exit(_run(file, chosen, breaks, RunFiles(RunSession(), **said)))


def _run(file: str, chosen: options.RunChoice, breaks: Path | None, files: RunFiles) -> int:
    """Run to the end or to a line of the .break file, print and write the outcome; the exit code."""
    from rich.console import Group

    from mindlang.breakpoints.watch import watcher
    from mindlang.run.outcome import data_so_far, run_data, run_names
    from mindlang.run.promises import PromiseCounts
    from mindlang.run.summary import run_summary

    seed = secrets.randbits(31) if chosen.seed is None else chosen.seed
    session, compiled, run, stop = files.session, terminal.load_compiled(file), None, None
    plain, (setup, rollout), breakpoints = session.prepare_stopping(file, compiled, chosen, breaks)
    counts = PromiseCounts(setup.ready.policy.graph, setup.master)
    if breaks or counts.watcher.promises or any(getattr(files, name) for name in WRITTEN):
        made = session.record(setup, rollout, seed)
        run, came = made.run, made.found
    else:
        came = run_data(setup.task, session.score(rollout, [seed])[0])
    if breaks and run:
        with terminal.procedures_talk():
            stop = stopped_data(watcher(breakpoints, setup).feed(run), str(breaks), run.graph.tick)
        if stop and stop["tick"] < run.ticks:
            run = run.until(stop["tick"])
            came = data_so_far(run.task, run.lines[-1], run.events[-1], run.ticks, "a breakpoint")
        came = came | {"stopped": stop}
    if run and counts.watcher.promises:
        counts.add([run])
        came = came | {"promises": counts.data()}
    found = run_names(setup.task, setup.master, seed, setup.robot) | {
        "notes": [*setup.ready.notes, *rollout.notes],
        **came,
    }
    where = [stop_summary(stop)] if breaks else []
    terminal.print_result(found, lambda: Group(*where, run_summary(found)))
    if run:
        files.write(run, plain, found)
    return terminal.FINDINGS if stop else terminal.OK


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
                "values": {name: finite(value) for name, value in stop.values},
            }
            for stop in stops
            if stop.tick == tick
        ],
    }


def stop_summary(stopped: dict[str, Any] | None) -> Text:
    """A text: the tick in which a run stopped, and the values that made the lines true."""
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

    @terminal.procedures_talk()
    def write(self, run: RecordedRun, setup: RunSetup, found: dict[str, Any]) -> None:
        """Write what was asked for of a run of the setup, and say so."""
        from mindrun.terminal.tick_count import ticks as in_words

        from mindlang.run.recording import run_bytes
        from mindlang.run.tables import trace_bytes

        if self.picture:
            self._draw(self.picture, run, found)
        if self.video:
            self._film(self.video, run, found)
        if self.trace:
            suffix = self.trace.suffix.lower()
            self._write(self.trace, lambda: trace_bytes(run, suffix), f"a row for each of {in_words(run.ticks)}")
        if self.record:
            seen = "to be seen with its source or a bundle of it that has no robot"
            self._write(self.record, lambda: run_bytes(run, setup, found["seed"]), f"{in_words(run.ticks)}, {seen}")

    def _write(self, path: Path, data: Callable[[], bytes], what: str) -> None:
        with terminal.refusing(terminal.MISUSE):
            made = data()
        terminal.write_file(path, made)
        self.session.say(f"{path}: {what}")

    def _draw(self, path: Path, run: RecordedRun, found: dict[str, Any]) -> None:
        from mindlang.pictures.environments import environment_picture
        from mindlang.pictures.picture import picture, png

        if run.task.scene.environment:
            self._write(path, lambda: png(environment_picture(run, found)), "the run as its environment draws it")
        else:
            self._write(path, lambda: png(picture(run, found)), "the path of the robot")

    def _film(self, path: Path, run: RecordedRun, found: dict[str, Any]) -> None:
        from mindlang.pictures.film import Film

        film = Film(run, found, self.speed, path.suffix.lower())
        counting = self.session.counting(path.name, len(film))
        with terminal.writing(path), terminal.refusing(terminal.MISUSE), counting as told:
            film.write(path, lambda: told(1))
        self.session.say(f"{path}: {film.seconds:.0f} s at {film.speed:g} times the robot's speed")
