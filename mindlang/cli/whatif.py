"""`mindc whatif`: a run with something changed, beside the run as it was.

Examples:
  mindc whatif collect.mind --task Collect --seed 3 --tick 812 --without Avoid
  mindc whatif collect.mind --seed 3 --sensor proximity=1 --picture paths.png
  mindc whatif collect.mind --tick 812 --set object_bearing=0.5 --ticks 60
  mindc whatif collect.mind --seed 3 --tick 812 --without Avoid --json
  mindc whatif collect.mind --seed 3 --tick 812 --with other.mind
  mindc whatif collect.mind --seed 3 --sensor proximity=other.rec
  mindc whatif day.rec ball.bundle --without Avoid
"""

from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from mindlang.cli import _options as options
from mindlang.cli import _terminal as terminal
from mindlang.cli._options import RunChoice, WholeOption

if TYPE_CHECKING:
    from mindlang.whatif.comparison import Compared
    from mindlang.whatif.request import Request

SENSORS = options.declared("sensor")


@click.command
@click.argument("file")
@click.argument("bundle", required=False, type=options.PATH)
@options.run_options(seed="Of the run. Default: 1.")
@click.option("--tick", type=WholeOption(1, 2**53), default=1, help="The first tick that is changed. Default: 1.")
@click.option("--ticks", type=WholeOption(1, 2**53), help="How many are. Default: all that follow; one with --set.")
@options.named("--without", "SKILL", options.SKILLS, "Silence a skill: it has no influence.", multiple=True)
@options.named(
    "--sensor sensors", "NAME=0.5", SENSORS, "What a sensor reads: NAME=0.5, NAME=1,0.5,1, NAME=day.rec", multiple=True
)
@click.option(
    "--set", "settings", multiple=True, metavar="NAME=0.5", help="A reading, a memory or an influence, for one tick."
)
@click.option("--with", "other", metavar="OTHER.mind", help="Another mind takes over: other weights, another version.")
@options.written("--picture", "PATH.png", "Draw both paths.")
@options.json_flag()
@options.quiet_flag()
def command(file: str, bundle: Path | None, chosen: RunChoice, picture: Path | None, **said: Any) -> None:
    """Run a task of FILE as it is, and again with something changed.

    Both runs are the same to the bit until the tick of the change. Says in which tick they differ first and in what,
    and what came of both. Runs the Python code of the file's procedures.

    Where FILE is a recording, BUNDLE is the one that was running, or the .mind file that it is built from: says what it
    would have sent for the same readings, in an open loop.
    """
    from mindlang.whatif.request import Request

    request = Request(**said)
    if request.other and request.ticks:
        raise click.UsageError("A mind that takes over goes on to the end: leave out --ticks.")
    if bundle is None and file.endswith(".rec"):
        raise click.UsageError(f"{file} is a recording: say the bundle that was running after it.")
    if bundle is not None:
        options.refuse_ineffective(options.OF_RUNS_ALONE, *options.OF_A_RUN, "picture")
    if not request.parts:
        words = "--without SKILL, --sensor NAME=0.5, --set NAME=0.5 or --with OTHER.mind"
        terminal.fail("nothing is changed", f"Say what: {words}", terminal.MISUSE)
    if bundle is None:
        terminal.refuse_unwritable(picture, ".png")
        _compare_runs(file, chosen, request, picture)
    else:
        _compare_recorded(Path(file), bundle, request)


def _compare_runs(file: str, chosen: RunChoice, request: "Request", picture: Path | None) -> None:
    """Run as it is and with changes, and print what differs."""
    from dataclasses import replace

    from mindrun.engine.changes import ChangeError

    from mindlang.cli._session import RunSession, refusing_recordings
    from mindlang.whatif.comparison import compare_runs, comparison_data, comparison_summary
    from mindlang.whatif.request import changes_of

    session, seed, theirs = RunSession(), 1 if chosen.seed is None else chosen.seed, None
    ours = session.prepare(file, chosen)
    if request.other:
        theirs = session.prepare(request.other, replace(chosen, task=ours.setup.task.name))
        if theirs.setup.task != ours.setup.task:
            where = f"task {ours.setup.task.name} is another in {request.other}"
            session.note(f"{where}; one seed need not give one world")
    setup = (theirs or ours).setup
    with refusing_recordings():
        changes = changes_of(request, setup.ready.policy.graph, setup.master, Path(file))
    with terminal.refusing(terminal.MISUSE, of=ChangeError), terminal.procedures_talk():
        compared = compare_runs(ours, seed, request.tick, changes, theirs)
    # A sensor that was replaced for as long as a recording lasts reads what it measures after that.
    ends = {change.last for change in changes if request.ticks is None and change.last and len(change.values) > 1}
    for end in sorted(ends):
        if end < compared.now.run.ticks:
            session.note(f"a recording ends with tick {end:,}: from then on its sensor reads what it measures")
    data = comparison_data(request, compared)
    terminal.print_result(data, lambda: comparison_summary(request, compared))
    if picture:
        session.say(f"{picture}: {_draw(compared, request, picture)}")


def _draw(compared: "Compared", request: "Request", path: Path) -> str:
    """Draw both runs, and say what the picture shows."""
    from mindlang.pictures.picture import png

    if compared.was.run.task.scene.environment:
        from mindlang.pictures.environments import environment_pictures as two_runs

        shown = "both runs"
    else:
        from mindlang.pictures.picture import two_paths as two_runs

        shown = "both paths of the robot"
    both = [(each.run, each.found) for each in (compared.was, compared.now)]
    with terminal.refusing(terminal.MISUSE):
        drawn = two_runs(both, request.words, request.tick)
    terminal.write_file(path, png(drawn))
    return shown


def _compare_recorded(path: Path, bundle: Path, request: "Request") -> None:
    """Compute a recording as it was and with changes, and print what differs."""
    from mindrun.graph.bundle import read_bundle

    from mindlang.cli._session import refusing_recordings
    from mindlang.run.recording import bundle_without_robot
    from mindlang.run.setup import ready_to_act
    from mindlang.whatif.comparison import compare_recording, recording_data, recording_summary

    with refusing_recordings():
        other = None
        if request.other and request.other.endswith(".bundle"):
            other = read_bundle(Path(request.other))
        elif request.other:
            compiled = terminal.load_compiled(request.other)
            other = bundle_without_robot(ready_to_act(request.other, compiled), compiled.sources[0].folder)
        found = compare_recording(path, bundle, request, other)
    terminal.print_result(recording_data(request, found), lambda: recording_summary(request, path.name, found))
