"""What `mindc bench` does with two minds, or two masters: both on the same layouts, and what differs."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from mindrun.sim.rollout import Rollout

from mindlang.cli._run_session import BenchChoice, RunSession
from mindlang.cli._terminal import MISUSE, console, fail, print_json, write_file
from mindlang.run import outcome
from mindlang.run.comparison import Benched, compare, differing_tasks
from mindlang.run.setup import RunSetup
from mindlang.run.summary import comparison_summary
from mindlang.run.tables import csv_parts, joined, runs_table

MAX_COMPARED = 2  # minds, or masters


@dataclass(frozen=True, slots=True)
class Contender:
    """A mind that is compared, the master it is asked to run under, and what it is called beside the other."""

    file: str
    master: str | None
    name: str


def contenders(files: Sequence[str], masters: Sequence[str]) -> list[Contender]:
    """Who runs: one mind, two minds, or one mind under two masters; of two minds each may have a master of its own."""
    if len(files) > MAX_COMPARED or len(masters) > MAX_COMPARED:
        fail("Two are compared, not more.", "mindc bench A.mind B.mind, or one FILE with --master X --master Y", MISUSE)
    count = max(len(files), len(masters))
    asked: Sequence[str | None] = masters or [None]
    both = [(files[i % len(files)], asked[i % len(asked)]) for i in range(count)]
    names = [_name(file, master, files, masters) for file, master in both]
    if len({*names}) < count:
        names = [f"{name} ({place})" for name, place in zip(names, "AB", strict=True)]
    return [Contender(*each, name) for each, name in zip(both, names, strict=True)]


def _name(file: str, master: str | None, files: Sequence[str], masters: Sequence[str]) -> str:
    if len(files) == 1:
        return str(master)
    return f"{file} with {master}" if len(masters) == MAX_COMPARED else file


def compare_benched(
    both: Sequence[Contender], chosen: BenchChoice, table: Path | None, as_json: bool, quiet: bool
) -> None:
    """Run both on the same layouts, and print what differs."""
    session = RunSession(quiet)
    cast = _cast(session, both, chosen)
    is_one_world = all(setup.is_one_world for setup, _ in cast)
    seeds = max((setup.layouts(chosen.seed, chosen.runs) for setup, _ in cast), key=len)
    notes = differing_tasks(both[1].file, cast[0][0].task, cast[1][0].task)
    session.say(*(f"note: {note}" for note in notes))
    benched, minds = [], []
    for each, (setup, rollout) in zip(both, cast, strict=True):
        with session.scorer(setup, rollout, chosen) as scorer:
            scores, seconds, cpu = session.score(scorer, seeds, f"{each.name}: ")
        benched.append(Benched(each.name, setup.task, scores))
        about = {"name": each.name, "file": each.file, "master": setup.master}
        data = outcome.bench_data(setup.task, scores, seeds, seconds, None if chosen.where else cpu)
        minds.append(about | data | {"notes": setup.notes(rollout, *outcome.over_at_once(setup.task, scores))})
    compared = compare(benched[0], benched[1], is_one_world)
    found: dict[str, Any] = {"task": benched[0].task.name, "seed": chosen.seed, "runs": len(seeds), **chosen.by}
    found |= {"minds": minds, **compared.data(), "notes": notes}
    if table:
        rows = {each.name: runs_table(each.task, each.scores, seeds) for each in benched}
        write_file(table, csv_parts(joined(rows)))
        session.say(f"{table}: a row for each of 2 × {len(seeds):,} runs")
    if as_json:
        print_json(found)
    else:
        console().print(comparison_summary(found, compared))


def _cast(session: RunSession, both: Sequence[Contender], chosen: BenchChoice) -> list[tuple[RunSetup, Rollout]]:
    """Who plays what; the second mind on the task of the first."""
    cast: list[tuple[RunSetup, Rollout]] = []
    for each in both:
        task = cast[0][0].task.name if cast else chosen.task
        cast.append(session.prepare(each.file, task, each.master, chosen.interrupt, chosen.workers, chosen.runs))
    return cast
