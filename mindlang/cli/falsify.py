"""`mindc falsify`: where does a mind fail? Layouts and ranges of a task in which it does, the worst of them as seeds.

Examples:
  mindc falsify collect.mind --task Collect
  mindc falsify collect.mind --task Collect --runs 100000
  mindc falsify collect.mind --task Collect --for 60      seconds
  mindc falsify collect.mind --task Collect --fewer 3     than 3 counted
  mindc falsify collect.mind --task Avoid --below 20      a score
  mindc falsify collect.mind --task Collect --write hard.seeds
"""

import sys
from collections.abc import Sequence
from pathlib import Path
from time import perf_counter
from typing import TYPE_CHECKING, Any

import click
from mindrun.processors import cores
from mindrun.terminal.command_line import command_line

from mindlang.cli import _options as options
from mindlang.cli import _terminal as terminal

if TYPE_CHECKING:
    from mindrun.sim.rollout import Rollout

    from mindlang.cli._session import RunSession
    from mindlang.falsify.search import Found
    from mindlang.run.setup import RunSetup

DEFAULT_RUNS = 2000
MAX_SECONDS = 7 * 24 * 3600
SECONDS = options.NumberOption(1, MAX_SECONDS)
NUMBER = options.NumberOption(-1e9, 1e9)


@click.command
@click.argument("file")
@options.OF_TASK
@click.option("--runs", type=options.RUNS, help=f"Layouts to run the task on. Default: {DEFAULT_RUNS:,}.")
@click.option("--for", "seconds", type=SECONDS, metavar="SECONDS", help="Search so long, in the place of --runs.")
@click.option("--below", type=NUMBER, metavar="SCORE", help="A run fails, too, that scores less.")
@click.option("--fewer", type=NUMBER, metavar="COUNT", help="A run fails, too, that counts fewer.")
@click.option("--seed", type=options.SEED, default=1, show_default=True, help="Draws the layouts.")
@options.WORKERS
@options.named("--master", "SKILL", options.SKILLS, options.IN_CHARGE)
@options.written("--write hard", "PATH.seeds", "Write the layouts that failed, for a lesson: hard 25% of it.")
@options.json_flag()
@options.quiet_flag()
def command(
    file: str, task: str | None, master: str | None, workers: int | None, hard: Path | None, **said: Any
) -> None:
    """Find layouts and ranges of a task on which FILE fails.

    A run fails that does not succeed, where its task can succeed; else one that an end of the task ends before its
    time; and one with a fault. Where a task has neither, one that counts less than half of the median of all runs, or
    scores that where nothing is counted. The report says which.

    First it is run on many layouts, for the share of failures with a confidence interval. Where the task draws numbers
    (varies, fails, draws) the search goes on where they are as in the worst runs, for the region that fails at least
    twice as often as all layouts. The worst runs are told as seeds: `mindc run --seed` repeats them.

    Runs the Python code of the file's procedures. With --for what is found depends on how fast the machine is. Ends
    with 1 where a run has failed.
    """
    from mindlang.cli._session import RunSession
    from mindlang.falsify.report import found_data, found_summary

    if said["seconds"] is not None:
        options.refuse_ineffective("left out with --for: the time says how many", "runs")
    terminal.refuse_unwritable(hard, ".seeds")
    session, seed = RunSession(), said["seed"]
    chosen = options.RunChoice(task, seed, master, True)
    setup, rollout = session.prepare(file, chosen, workers or cores(), said["runs"] or DEFAULT_RUNS)
    found = _searched(session, setup, rollout, **said)
    session.note(*setup.world_notes, *rollout.notes)
    words: list[str | Path] = [Path(file), "--task", setup.task.name, *(["--master", master] if master else [])]
    data = {"task": setup.task.name, "master": setup.master, "of_seed": seed} | found_data(found, seed)
    data |= {"repeat": f"{command_line('mindc', 'run', *words)} --seed"}
    terminal.print_result(data, lambda: found_summary(data))
    if hard:
        _write(session, hard, found, [*words, *_as_written(said)])
    sys.exit(terminal.FINDINGS if data["worst"] else terminal.OK)


def _as_written(said: dict[str, Any]) -> list[str]:
    """The options of a search as words of a command line."""
    return [f"--{'for' if name == 'seconds' else name}={value}" for name, value in said.items() if value is not None]


def _write(session: "RunSession", path: Path, found: "Found", words: Sequence[str | Path]) -> None:
    """Write the layouts that failed, or say that there are none."""
    from mindlang.falsify.report import hard_runs, hard_text

    if count := len(hard_runs(found)):
        terminal.write_file(path, hard_text(found, command_line("mindc", "falsify", *words)).encode())
        session.say(f"{path}: a seed for each of {count:,} layouts")
    else:
        session.note(f"{path} is not written: no run has failed")


@terminal.procedures_talk()
def _searched(
    session: "RunSession",
    setup: "RunSetup",
    rollout: "Rollout",
    runs: int | None,
    seconds: float | None,
    below: float | None,
    fewer: float | None,
    seed: int,
) -> "Found":
    """The search of so many runs, or of so many seconds, with a bar that says how much of it is left."""
    from mindlang.falsify.failures import Criterion
    from mindlang.falsify.numbers import numbers_of
    from mindlang.falsify.search import MAX_ROUNDS, Search, checked_runs, round_runs

    task, count, began = setup.task, runs or DEFAULT_RUNS, perf_counter()
    numbers = numbers_of(setup.ready.policy.graph, task) if rollout.simulates else []
    more = MAX_ROUNDS * round_runs(count) + checked_runs(count) if numbers else 0
    criterion, what = Criterion(task, below, fewer), f"{task.name} falsified"
    if seconds is None:
        with session.counting(what, count + more) as ran:
            return Search(rollout, criterion, numbers, seed, ran).find(count)
    with session.progress() as shown:
        bar = shown.add_task(what, total=seconds)

        def ran(runs: float) -> None:
            shown.update(bar, completed=perf_counter() - began)

        passed = lambda: (perf_counter() - began) / seconds  # noqa: E731
        return Search(rollout, criterion, numbers, seed, ran, passed).find(None)
