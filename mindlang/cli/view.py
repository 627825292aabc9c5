"""`mindc view`: a run or a recording, seen in a browser."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

from mindlang.cli._options import NewFile, WholeOption

if TYPE_CHECKING:
    from mindlang.breakpoints.breakpoint import Breakpoint
    from mindlang.view.viewed import Viewed
    from mindlang.view.viewed_champion import Champions

EXAMPLES = """\b
Examples:
  mindc view collect.mind
  mindc view collect.mind --task Collect --seed 3
  mindc view day.rec ball.bundle                 what a robot has recorded
  mindc view collect.mind --task Collect --break collect.break
  mindc view day.rec ball.bundle --follow        and what it still records
  mindc view robot.local:day.rec ball.bundle --follow    through ssh
  mindc view runs/                               what is being learnt, and champions of any generation
  mindc view collect.mind --task Avoid --no-interruption --port 8123 --no-browser
  mindc view collect.mind --task Collect --export run.html
"""
MAX_PORT = 65535
PATH = click.Path(path_type=Path)


@click.command(epilog=EXAMPLES)
@click.argument("file")
@click.argument("bundle", required=False)
@click.option("--task", metavar="TASK", help="Default: that on which the master is taught, or of its name.")
@click.option("--seed", type=WholeOption(0, 2**64 - 1), help="The same seed gives the same run. Default: drawn.")
@click.option("--master", metavar="SKILL", help="Who is in charge. Default: the master of the task's first lesson.")
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

    The world, the hierarchy, and every value over time: of a run; of what a robot has recorded, with the BUNDLE that
    was running; or of trainings in a folder, while they go on, with the champion of any generation in its world.

    Serves a page at an address of this machine, which nobody else can open, until Ctrl-C; a browser that is closed may
    open it again. With --export it is one file, which opens from a disk without a server. Runs the Python code of
    procedures.
    """
    from mindlang.cli._terminal import refuse_unwritable

    refuse_unwritable(export, ".html")
    is_run = (task, seed, master, no_interruption, breaks) != (None, None, None, False, None)
    if follow:
        _follow(file, None if export or is_run else bundle, port, not no_browser, quiet)
    elif Path(file).is_dir():
        other = bool(bundle or export or task or master or no_interruption or breaks)
        _serve_training(file, seed, port, not no_browser, quiet, other)
    elif bundle is None:
        _refuse_recording(file)
        viewed = _simulated(file, task, seed, master, not no_interruption, breaks, quiet)
        _show(viewed, export, port, not no_browser, quiet)
    elif not is_run:
        _show(_recorded(file, bundle), export, port, not no_browser, quiet)
    else:
        raise click.UsageError("A recording has its task, its master and its end: --port and --export are for it.")


def _show(viewed: Viewed, export: Path | None, port: int | None, opens: bool, quiet: bool) -> None:
    if export:
        _export(viewed, export, quiet)
    else:
        viewed.grow()
        _serve(viewed, None, port, opens, quiet)


def _serve_training(folder: str, seed: int | None, port: int | None, opens: bool, quiet: bool, other: bool) -> None:
    from mindlang.cli._training_view import training_view

    if other:
        raise click.UsageError("A training has its task, its master and its end, and is no single file to export.")
    viewed, champions = training_view(Path(folder), seed, quiet)
    _serve(viewed, champions, port, opens, quiet)


def _refuse_recording(file: str) -> None:
    if file.endswith(".rec"):
        raise click.UsageError(f"A recording is seen with the bundle that was running: mindc view {file} NAME.bundle")


def _simulated(
    file: str,
    task: str | None,
    seed: int | None,
    master: str | None,
    interrupt: bool,
    breaks: Path | None,
    quiet: bool,
) -> Viewed:
    import secrets

    from mindlang.cli._run_session import RunSession
    from mindlang.cli._terminal import load_compiled
    from mindlang.compiler.drawing import text_after_name
    from mindlang.view.viewed_run import ViewedRun

    compiled, session = load_compiled(file), RunSession(quiet)
    breakpoints: tuple[Breakpoint, ...] = ()
    setup = session.cast(file, compiled, task, master)
    if breaks:
        from mindlang.breakpoints.watch import noticing
        from mindlang.cli._run_to_breakpoint import read_breakpoints

        breakpoints = read_breakpoints(breaks, compiled, setup)
        setup = noticing(setup, breakpoints)
    rollout = session.simulator(setup, interrupt)
    skills = compiled.mind.skills if compiled.mind else ()
    texts = {(skill.name, edge.target): text_after_name(edge.fact) for skill in skills for edge in skill.edges}
    return ViewedRun(setup, rollout, secrets.randbits(31) if seed is None else seed, texts, breakpoints).begun()


def _recorded(file: str, bundle: str) -> Viewed:
    from mindlang.cli._recordings import refusing_recordings
    from mindlang.view.viewed_recording import viewed_recording

    with refusing_recordings():
        return viewed_recording(Path(file), Path(bundle))


def _follow(file: str, bundle: str | None, port: int | None, opens: bool, quiet: bool) -> None:
    from contextlib import ExitStack

    from mindlang.cli._recordings import refusing_recordings
    from mindlang.view.viewed_recording import followed_recording

    if bundle is None:
        raise click.UsageError("--follow is for a recording and its bundle: mindc view day.rec NAME.bundle --follow")
    with ExitStack() as stack:
        with refusing_recordings():
            viewed = stack.enter_context(followed_recording(file, Path(bundle)))
        _serve(viewed, None, port, opens, quiet)


def _serve(viewed: Viewed, champions: Champions | None, port: int | None, opens: bool, quiet: bool) -> None:
    import asyncio
    import os
    import sys

    from mindlang.cli._terminal import MISUSE, fail, procedures_talk, talk
    from mindlang.view.server import ViewServer
    from mindlang.view.session import Session

    out = sys.stdout

    def ready(address: str) -> None:
        click.echo(address, file=out)
        if not quiet:
            talk.print("Ctrl-C ends this; a browser that is closed does not.")
        if opens:
            _open(address)

    try:
        with procedures_talk():
            asyncio.run(ViewServer(Session(viewed, champions), port or 0).serve(ready))
    except OSError as error:
        hint = "Another program has that port: leave --port out, and one that is free is taken."
        fail(f"port {port} of this machine cannot be opened: {os.strerror(error.errno or 0)}", hint, MISUSE)


def _export(viewed: Viewed, path: Path, quiet: bool) -> None:
    from mindrun.errors import MindError

    from mindlang.cli._run_session import RunSession
    from mindlang.cli._terminal import MISUSE, fail, procedures_talk, write_file
    from mindlang.view.export import exported
    from mindlang.view.session import Session

    said = RunSession(quiet)
    with said.progress() as progress, procedures_talk():
        bar = progress.add_task(path.name, total=viewed.about["of_ticks"])
        while not viewed.over:
            viewed.grow()
            progress.update(bar, completed=viewed.known)
    if viewed.failed:
        fail(f"{viewed.failed}: nothing is written")
    session = Session(viewed)
    everything = session.ticks(0) | {"happened": viewed.happened, "stops": viewed.stops}
    try:
        page = exported(session.about(edits=False), everything, viewed)
    except MindError as error:
        fail(str(error), error.hint, MISUSE)
    write_file(path, page.encode())
    said.say(f"{path}: {viewed.known:,} ticks, {len(page) / 1e6:.1f} MB, opens in any browser")


def _open(address: str) -> None:
    """Open a browser with windows, if there is one: what runs in a terminal would take this one."""
    import webbrowser
    from contextlib import suppress
    from threading import Thread

    with suppress(webbrowser.Error):
        browser = webbrowser.get()
        if type(browser) is not webbrowser.GenericBrowser:
            Thread(target=browser.open, args=(address,), daemon=True).start()
