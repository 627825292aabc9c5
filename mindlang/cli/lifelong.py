"""`mindc lifelong`: what every task that was taught counts after each lesson.

Examples:
  mindc lifelong collect.mind
  mindc lifelong monolith.mind --layouts 200 --seed 1
  mindc lifelong collect.mind --runs lab/runs --json
"""

from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import Any

import click
from mindrun.processors import cores

from mindlang.cli import _options as options
from mindlang.cli._terminal import load_compiled, print_result, procedures_talk, refuse_standard_input, refusing_lessons

CELL_COLUMNS, LINE_COLUMNS = 7, 80
LONG_MEAN = 999.95  # from which on a mean has no decimal


@click.command
@click.argument("file")
@click.option("--runs", type=options.PATH, default="runs", show_default=True, help="Where runs are kept.")
@click.option("--layouts", type=options.RUNS, default=50, show_default=True, help="On which each task runs each time.")
@click.option("--seed", type=options.SEED, default=1, show_default=True, help="Draws the layouts.")
@options.WORKERS
@options.json_flag()
@options.quiet_flag()
def command(file: str, runs: Path, layouts: int, seed: int, workers: int | None) -> None:
    """Show what each lesson of FILE taught, and what was forgotten.

    The lessons are those whose runs are kept, and whose weights went to the lock. After each of them every task that
    any of them taught runs on the same fresh layouts. A number is the mean of what a task counts in a run, or of the
    scores where it counts nothing; `kept` is what is left in the end of what a task had after the last lesson that
    taught it. Runs the Python code of the file's procedures.
    """
    from rich.text import Text

    from mindlang.cli._session import RunSession, ensure_compiled
    from mindlang.run.setup import layouts as seeds_of
    from mindlang.training.subject import open_subject
    from mindlang.training.taught_runs import history, mean_of, players, taught_runs

    refuse_standard_input(file, "Standard input has no runs: they are kept of a file.")
    session, compiled = RunSession(), load_compiled(file)
    with refusing_lessons(), procedures_talk():
        subject = open_subject(Path(file), compiled)
        taught, others = taught_runs(subject, runs)
        if others:
            session.note(f"lessons whose weights fit no more: {others}; they are left out")
        rows: dict[tuple[str, str], list[float | None]] = {each.place: [] for each in taught}
        with session.counting("tasks", len(rows) * len(taught)) as told:
            for place, row in rows.items():
                for rollout in players(subject, place, taught, workers or cores()):
                    if rollout:
                        ensure_compiled(rollout, session.say)
                    row.append(mean_of(rollout, seeds_of(seed, layouts)) if rollout else None)
                    told(1)
    found = {"layouts": layouts, "seed": seed, **history(taught, rows)}
    print_result(found, lambda: Text("\n".join(lines(found))))


def lines(found: Mapping[str, Any]) -> Iterator[str]:
    """The lessons, then a line for each task, with as many lessons side by side as there is room for."""
    lessons, tasks = found["lessons"], found["tasks"]
    for number, lesson in enumerate(lessons, 1):
        yield f"{number:>3} {lesson['lesson']}"
    names = [task["task"] + f" under {task['master']}" * (task["master"] != task["task"]) for task in tasks]
    wide = max(map(len, ["after lesson", *names]))
    most = max(1, (LINE_COLUMNS - wide) // CELL_COLUMNS - 1)
    for first in range(0, len(lessons), most):
        shown = slice(first, first + most)
        is_last = first + most >= len(lessons)
        yield "\n" + _line("after lesson", wide, [*range(1, len(lessons) + 1)][shown], "kept" * is_last)
        for name, task in zip(names, tasks, strict=True):
            share = "–" if task["kept"] is None else f"{task['kept']:.0%}"
            means = ("–" if x is None else f"{x:.{int(abs(x) < LONG_MEAN)}f}" for x in task["means"][shown])
            yield _line(name, wide, means, share * is_last)


def _line(name: str, wide: int, cells: Iterable[object], last: str) -> str:
    return f"{name:<{wide}}" + "".join(f"{cell!s:>{CELL_COLUMNS}}" for cell in (*cells, last)).rstrip()
