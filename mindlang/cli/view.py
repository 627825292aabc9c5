"""`mindc view`: a run, a recording or a training, seen in a browser, or written to a page.

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
  mindc view car.mind --drive left_wheel,right_wheel --record drive.rec
  mindc view collect.mind --no-interruption --port 8123 --no-browser
  mindc view collect.mind --task Collect --export run.html
"""

import secrets
import sys
from contextlib import ExitStack, closing
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click
from mindrun.terminal.arguments import listed_names
from mindrun.terminal.command_line import command_line

from mindlang.cli import _options as options
from mindlang.cli import _terminal as terminal
from mindlang.cli._options import OF_A_CAST, OF_A_RUN, OF_RUNS_ALONE, PATH, RunChoice, refuse_ineffective

if TYPE_CHECKING:
    from mindlang.compiler.compile import Compiled
    from mindlang.view.about import Texts
    from mindlang.view.learning import Learning
    from mindlang.view.viewed import Viewed
    from mindlang.view.viewed_recording import Watching

Names = tuple[str, ...] | None
MAX_PORT = 65535


@click.command
@click.argument("file")
@click.argument("bundle", required=False)
@options.run_options(seed="The same seed gives the same run. Default: drawn.")
@click.option("--break", "breaks", type=PATH, metavar="PATH.break", help="Pause the page where a line of it says.")
@options.flag("--follow", "Of a recording: show what is still written. HOST:FILE.rec is read by ssh.")
@click.option("--drive", type=listed_names, metavar="NAME,…", help="Drive actuators, or skills' influence, by hand.")
@options.written("--record", "PATH.rec", "With --drive: write each run, the second to PATH-2.rec.")
@click.option("--port", type=options.WholeOption(1, MAX_PORT), help="Of this machine. Default: any that is free.")
@options.unless("--no-browser opens_browser", "Print the address, and open nothing.")
@options.written("--export", "PATH.html", "Write the page with the run in it, and end.")
@options.quiet_flag("Print nothing but the address and errors.")
def command(
    file: str, bundle: str | None, chosen: RunChoice, breaks: Path | None, follow: bool, drive: Names, **said: Any
) -> None:
    """See a run of FILE, or a robot's day, in a browser.

    The world, the hierarchy, and every value over time: of a run; of a recording, with the BUNDLE that was running or
    the .mind file that it is built from; or of trainings in a folder, while they go on, with the champion of any
    generation in its world.

    Serves a page at an address of this machine, which nobody else can open, until Ctrl-C; a browser that is closed may
    open it again. With --export it is one file, which opens from a disk without a server. Runs the Python code of
    procedures.

    With --drive a person drives in real time, by keys or a gamepad. Skills that were not taught send 0 then.
    """
    output = ViewOutput(**said)
    if output.export:
        refuse_ineffective("of a page that is served, not of --export", "port", "opens_browser")
        terminal.refuse_unwritable(output.export, ".html")
    if drive:
        _drive(file, bundle, chosen, drive, output)
        return
    refuse_ineffective("of what is driven by hand, with --drive", "record")
    if follow and bundle is None:
        raise click.UsageError("--follow is for a recording and its bundle: mindc view day.rec NAME.bundle --follow")
    if bundle is not None and (follow or not Path(file).is_dir()):
        refuse_ineffective(OF_RUNS_ALONE, *OF_A_RUN)
        if follow:
            refuse_ineffective("of what has an end, not of --follow", "export")
        _show_recording(file, Path(bundle), follow, breaks, output)
    elif Path(file).is_dir():
        refuse_ineffective("of a run or a recording, not of trainings", "bundle", *OF_A_CAST, "breaks", "export")
        output.show(*training_view(Path(file), chosen.seed))
    elif file.endswith(".rec"):
        instead = command_line("mindc", "view", Path(file), "NAME.bundle")
        raise click.UsageError(f"A recording is seen with the bundle that was running: {instead}")
    else:
        output.show(run_view(file, chosen, breaks))


def run_view(file: str, chosen: RunChoice, breaks: Path | None) -> "Viewed":
    """A run at its beginning, of a drawn seed where none is said; `breaks` is a file of breakpoints."""
    from mindlang.cli._session import RunSession
    from mindlang.view.viewed_run import ViewedRun

    compiled, session = terminal.load_compiled(file), RunSession()
    _, (setup, rollout), breakpoints = session.prepare_stopping(file, compiled, chosen, breaks)
    seed = secrets.randbits(31) if chosen.seed is None else chosen.seed
    return ViewedRun(setup, rollout, seed, _texts(compiled), breakpoints).begun()


def _drive(file: str, bundle: str | None, chosen: RunChoice, names: tuple[str, ...], output: "ViewOutput") -> None:
    """Show runs that a hand drives, until Ctrl-C."""
    from time import monotonic, sleep

    from mindrun.robot.hand import hand_on

    from mindlang.cli._session import RunSession, ensure_compiled, refusing_setups
    from mindlang.run.setup import set_up
    from mindlang.view.viewed_run import DrivenRuns

    if bundle is not None or Path(file).is_dir() or file.endswith(".rec"):
        raise click.UsageError("--drive is for a run of a .mind file; a robot is driven by mindrun NAME.bundle --drive")
    refuse_ineffective("of what is seen alone, not of --drive", "breaks", "export", "interrupt", "follow", "robot")
    terminal.refuse_unwritable(output.record, ".rec")
    compiled, session = terminal.load_compiled(file), RunSession()
    with refusing_setups(), terminal.procedures_talk():
        setup = set_up(file, compiled, chosen.task, chosen.master, untaught=True)
        hand = hand_on(setup.ready.policy.graph, setup.master, names)
        ensure_compiled(setup.rollout(), session.say)
        session.note(*filter(None, (*setup.ready.notes, setup.note)))
        runs = DrivenRuns(setup, hand, _texts(compiled), monotonic, sleep, output.record, session.say)
        viewed = runs.begun(chosen.seed)
    with closing(runs):
        output.show(viewed)


def _texts(compiled: "Compiled") -> "Texts":
    """The text of each edge, by the names of its skill and of whom it is for."""
    from mindlang.compiler.drawing import text_after_name

    skills = compiled.whole[0].skills
    return {(skill.name, edge.target): text_after_name(edge.fact) for skill in skills for edge in skill.edges}


@terminal.procedures_talk()
def training_view(folder: Path, seed: int | None) -> "tuple[Viewed, Learning]":
    """The champion of a training's folder that was found last, at its beginning, and all others."""
    from mindlang.cli._session import RunSession, ensure_compiled
    from mindlang.view.learning import open_learning
    from mindlang.view.messages import RefusedError

    with terminal.refusing_lessons():
        try:
            learning = open_learning(folder, secrets.randbits(31) if seed is None else seed)
            number, attempt, generation = learning.newest()
            ensure_compiled(learning.rollout(number), RunSession().say)
            return learning.begin(number, attempt, generation), learning
        except RefusedError as error:
            terminal.fail(str(error))


def _show_recording(file: str, bundle: Path, follow: bool, breaks: Path | None, output: "ViewOutput") -> None:
    """Show a recording: read once, or followed while it is written, of this machine or as HOST:FILE."""
    from mindlang.breakpoints.watch import RecordingWatcher, recording_subject
    from mindlang.cli._session import read_breakpoints, refusing_recordings
    from mindlang.view.viewed_recording import followed_recording, viewed_recording

    watching: Watching | None = (
        (lambda of, mind: RecordingWatcher(read_breakpoints(breaks, recording_subject(of, mind)), of, mind))
        if breaks
        else None
    )
    with ExitStack() as stack:
        with refusing_recordings():
            if follow:
                viewed = stack.enter_context(followed_recording(file, bundle, watching))
            else:
                viewed = viewed_recording(Path(file), bundle, watching)
        output.show(viewed)


@dataclass(frozen=True, slots=True)
class ViewOutput:
    """The output of `mindc view`: the file `export`, or a page served at a `port`, None for any that is free.

    `record` is for what is driven by hand.
    """

    port: int | None
    opens_browser: bool
    export: Path | None
    record: Path | None = None

    def show(self, viewed: "Viewed", learning: "Learning | None" = None) -> None:
        """Write the file, or serve until Ctrl-C."""
        import asyncio

        from mindlang.view.server import PortError, ViewServer, open_browser
        from mindlang.view.session import ViewSession

        def ready(address: str) -> None:
            click.echo(address, file=out)
            if not is_quiet:
                terminal.tell("Ctrl-C ends this; a browser that is closed does not.")
            if self.opens_browser:
                open_browser(address)

        if self.export:
            self._write(viewed, self.export)
            return
        if not viewed.is_live:
            viewed.grow()  # what the page shows first
        out, is_quiet = sys.stdout, terminal.is_asked("quiet")  # procedures print elsewhere
        with terminal.refusing(terminal.MISUSE, of=PortError), terminal.procedures_talk():
            asyncio.run(ViewServer(ViewSession(viewed, learning), self.port or 0).serve(ready))

    def _write(self, viewed: "Viewed", path: Path) -> None:
        from mindrun.terminal.tick_count import ticks as in_words

        from mindlang.cli._session import RunSession
        from mindlang.view.export import exported, exported_images, refuse_too_large_page
        from mindlang.view.session import ViewSession

        session = RunSession()
        with session.progress() as progress, terminal.procedures_talk():
            bar = progress.add_task(path.name, total=viewed.about["of_ticks"])
            while not viewed.over:
                viewed.grow()
                progress.update(bar, completed=viewed.known)
            if viewed.failed:
                terminal.fail(f"{viewed.failed}: nothing is written")
            with terminal.refusing(terminal.MISUSE):
                refuse_too_large_page(viewed)
            progress.reset(bar, description="images", total=viewed.known)
            images = exported_images(viewed, lambda tick: progress.update(bar, completed=tick))
        seen = ViewSession(viewed)
        everything = seen.ticks(0) | {"happened": viewed.happened, "stops": viewed.stops}
        page = exported(seen.about(edits=False), everything, viewed, images)
        terminal.write_file(path, page.encode())
        session.say(f"{path}: {in_words(viewed.known)}, {len(page) / 1e6:.1f} MB, opens in any browser")
        if images and images.note:
            session.note(images.note)
