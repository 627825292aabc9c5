"""`mindc run`: one run of a task, in numbers and in pictures."""

from __future__ import annotations

from math import isfinite
from pathlib import Path
from typing import Any

import click

EXAMPLES = """\b
Examples:
  mindc run collect.mind
  mindc run collect.mind --task GoToObject --seed 3
  mindc run collect.mind --task Collect --no-interruption --picture path.png
  mindc run collect.mind --task Collect --seed 3 --video run.mp4 --speed 4
  mindc run collect.mind --task Avoid --seed 3 --json
"""
SEED = click.IntRange(0, 2**64 - 1)
PATH = click.Path(path_type=Path)


class Speed(click.FloatRange):
    """A range in which "nan", of which no comparison holds, does not lie."""

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """The number; as click does it, except for nan."""
        number = super().convert(value, param, ctx)
        return number if isfinite(number) else self.fail(f"{value} is not a number.", param, ctx)


@click.command(epilog=EXAMPLES)
@click.argument("file")
@click.option("--task", metavar="TASK", help="Default: that on which the master, or a skill below it, is taught.")
@click.option("--seed", type=SEED, help="The same seed gives the same run. Default: drawn, and printed.")
@click.option("--master", metavar="SKILL", help="Who is in charge. Default: the master of the task's first lesson.")
@click.option("--no-interruption", is_flag=True, help="Go on to the last tick, whatever would end the run.")
@click.option("--picture", type=PATH, metavar="PATH.png", help="Draw the world and the path that the robot took.")
@click.option("--video", type=PATH, metavar="PATH.mp4", help="Film the world and the influence in the hierarchy.")
@click.option("--speed", type=Speed(0.01, 1000), help="Of the video. Default: a whole run takes a minute.")
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
    as_json: bool,
    quiet: bool,
) -> None:
    """Run a task of FILE once, in numbers and in pictures.

    With the weights that its skills were taught. Runs the Python code of the file's procedures. Refuses skills that
    have not been taught, or whose weights belong to another declaration.
    """
    import secrets

    from mindlang.run import outcome
    from mindlang.run.stage import Stage
    from mindlang.run.summary import run_summary
    from mindlang.terminal import console, print_json, refuse_unwritable

    stage = Stage(quiet)
    refuse_unwritable(picture, ".png")
    refuse_unwritable(video, ".mp4")
    cast, rollout = stage.prepare(file, task, master, interrupt=not no_interruption)
    seed = secrets.randbits(31) if seed is None else seed
    found = outcome.one(cast.task, stage.score(rollout, [seed])[0])
    found = {"task": cast.task.name, "master": cast.master, "seed": seed, "notes": [*cast.ready.notes]} | found
    if as_json:
        print_json(found)
    else:
        console().print(run_summary(found))
    if picture:
        stage.draw(cast, rollout, found, picture)
    if video:
        stage.film(cast, rollout, found, video, speed)
