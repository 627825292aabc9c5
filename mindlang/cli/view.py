"""`mindc view`: a run or a recording, seen in a browser."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

from mindlang.cli._options import (
    LAYOUT,
    OF_A_CAST,
    OF_A_RUN,
    OF_RUNS_ALONE,
    OF_TASK,
    UNDER_MASTER,
    NewFile,
    WholeOption,
    refuse_ineffective,
)

if TYPE_CHECKING:
    from mindlang.cli._view_output import ViewOutput

EXAMPLES = """\b
Examples:
  mindc view collect.mind
  mindc view collect.mind --task Collect --seed 3
  mindc view day.rec ball.bundle           what a robot has recorded
  mindc view run.rec collect.mind          what mindc run --record has written
  mindc view collect.mind --task Collect --break collect.break
  mindc view day.rec ball.bundle --follow  and what it still records
  mindc view day.rec ball.bundle --break day.break  where it had to stop, say
  mindc view robot.local:day.rec ball.bundle --follow  through ssh
  mindc view runs/                         what is being learnt, and champions
  mindc view collect.mind --no-interruption --port 8123 --no-browser
  mindc view collect.mind --task Collect --export run.html
"""
MAX_PORT = 65535
PATH = click.Path(path_type=Path)


@click.command(epilog=EXAMPLES)
@click.argument("file")
@click.argument("bundle", required=False)
@OF_TASK
@click.option("--seed", type=LAYOUT, help="The same seed gives the same run. Default: drawn.")
@UNDER_MASTER
@click.option("--no-interruption", is_flag=True, help="Go on to the last tick, whatever would end the run.")
@click.option("--break", "breaks", type=PATH, metavar="PATH.break", help="Pause the page where a line of it says.")
@click.option(
    "--follow", is_flag=True, help="Of a recording: show what is still written. HOST:FILE.rec is read by ssh."
)
@click.option("--port", type=WholeOption(1, MAX_PORT), help="Of this machine. Default: any that is free.")
@click.option("--no-browser", is_flag=True, help="Print the address, and open nothing.")
@click.option("--export", type=NewFile(), metavar="PATH.html", help="Write the page with the run in it, and end.")
@click.option("-q", "--quiet", is_flag=True, help="Print nothing but the address and errors.")
def command(
    file: str,
    bundle: str | None,
    task: str | None,
    seed: int | None,
    master: str | None,
    no_interruption: bool,
    breaks: Path | None,
    follow: bool,
    port: int | None,
    no_browser: bool,
    export: Path | None,
    quiet: bool,
) -> None:
    """See a run of FILE, or a robot's day, in a browser.

    The world, the hierarchy, and every value over time: of a run; of a recording, with the BUNDLE that was running or
    the .mind file that it is built from; or of trainings in a folder, while they go on, with the champion of any
    generation in its world.

    Serves a page at an address of this machine, which nobody else can open, until Ctrl-C; a browser that is closed may
    open it again. With --export it is one file, which opens from a disk without a server. Runs the Python code of
    procedures.
    """
    output = _output(port, not no_browser, export, quiet)
    if follow:
        _follow(file, bundle, breaks, output)
    elif Path(file).is_dir():
        _show_training(file, seed, output)
    elif bundle is not None:
        _show_recording(file, bundle, breaks, output)
    else:
        from mindlang.cli._run_view import ViewChoice, run_view

        _refuse_recording(file)
        output.show(run_view(file, ViewChoice(task, seed, master, not no_interruption, breaks), quiet))


def _output(port: int | None, opens_browser: bool, export: Path | None, quiet: bool) -> ViewOutput:
    from mindlang.cli._terminal import refuse_unwritable
    from mindlang.cli._view_output import ViewOutput

    if export:
        refuse_ineffective("of a page that is served, not of --export", "port", "no_browser")
        refuse_unwritable(export, ".html")
    return ViewOutput(port, opens_browser, export, quiet)


def _follow(file: str, bundle: str | None, breaks: Path | None, output: ViewOutput) -> None:
    if bundle is None:
        raise click.UsageError("--follow is for a recording and its bundle: mindc view day.rec NAME.bundle --follow")
    refuse_ineffective(OF_RUNS_ALONE, *OF_A_RUN)
    refuse_ineffective("of what has an end, not of --follow", "export")
    from mindlang.cli._recording_view import followed_view

    with followed_view(file, bundle, breaks) as viewed:
        output.show(viewed)


def _show_training(folder: str, seed: int | None, output: ViewOutput) -> None:
    refuse_ineffective("of a run or a recording, not of trainings", "bundle", *OF_A_CAST, "breaks", "export")
    from mindlang.cli._training_view import training_view

    output.show(*training_view(Path(folder), seed, output.quiet))


def _show_recording(file: str, bundle: str, breaks: Path | None, output: ViewOutput) -> None:
    refuse_ineffective(OF_RUNS_ALONE, *OF_A_RUN)
    from mindlang.cli._recording_view import recording_view

    output.show(recording_view(file, bundle, breaks))


def _refuse_recording(file: str) -> None:
    if file.endswith(".rec"):
        from mindrun.terminal.command_line import command_line

        command = command_line("mindc", "view", Path(file), "NAME.bundle")
        raise click.UsageError(f"A recording is seen with the bundle that was running: {command}")
