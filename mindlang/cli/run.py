"""`mindc run`: one run of a task, in numbers, pictures and tables."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

from mindlang.cli._options import LAYOUT, OF_TASK, UNDER_MASTER, NewFile, NumberOption, refuse_ineffective

if TYPE_CHECKING:
    from mindlang.cli._run_files import RunFiles
    from mindlang.cli._run_session import RunChoice, RunSession

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
@OF_TASK
@click.option("--seed", type=LAYOUT, help="The same seed gives the same run. Default: drawn, and printed.")
@UNDER_MASTER
@click.option("--no-interruption", is_flag=True, help="Go on to the last tick, whatever would end the run.")
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
@click.option(
    "--break", "breaks", type=click.Path(path_type=Path), metavar="PATH.break", help="Stop where a line of it says."
)
@click.option("--json", "as_json", is_flag=True, help="Print one JSON document instead.")
@click.option("-q", "--quiet", is_flag=True, help="Print nothing but results and errors.")
def command(
    file: str,
    task: str | None,
    seed: int | None,
    master: str | None,
    no_interruption: bool,
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
    import secrets

    from mindlang.cli._run_files import RunFiles
    from mindlang.cli._run_session import RunChoice, RunSession

    session, files = RunSession(quiet), RunFiles(picture, video, speed, trace, record)
    files.refuse_unwritable()
    if video is None:
        refuse_ineffective("of --video: say it, too", "speed")
    chosen = RunChoice(task, secrets.randbits(31) if seed is None else seed, master, not no_interruption)
    if breaks:
        from mindlang.cli._run_to_breakpoint import run_to_breakpoint

        run_to_breakpoint(session, file, chosen, breaks, files, as_json)
    _run_to_its_end(session, file, chosen, files, as_json)


def _run_to_its_end(session: RunSession, file: str, chosen: RunChoice, files: RunFiles, as_json: bool) -> None:
    from mindlang.cli._terminal import console, print_json
    from mindlang.run import outcome
    from mindlang.run.summary import run_summary

    setup, rollout = session.prepare(file, chosen.task, chosen.master, chosen.interrupt)
    made = session.record(setup, rollout, chosen.seed) if files.any() else None
    came = made.found if made else outcome.run_data(setup.task, session.score(rollout, [chosen.seed])[0])
    found = {
        "task": setup.task.name,
        "master": setup.master,
        "seed": chosen.seed,
        "notes": [*setup.ready.notes, *rollout.notes],
    } | came
    if as_json:
        print_json(found)
    else:
        console().print(run_summary(found))
    if made:
        files.write(session, made.run, setup, found)
