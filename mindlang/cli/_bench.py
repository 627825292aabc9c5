"""The four benches of `mindc bench`: one mind, two minds, changed worlds, the credit of each skill."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import asdict, dataclass, replace
from functools import partial
from pathlib import Path
from typing import Any

from mindrun.graph.policy import Policy
from mindrun.graph.run_scores import Scores
from rich.console import Group

from mindlang.cli import _options as options
from mindlang.cli import _terminal as terminal
from mindlang.cli._session import Prepared, Ran, RunSession
from mindlang.executors import Where, scorer_on
from mindlang.executors.jobs import assignment_of
from mindlang.lock.status import make_ready
from mindlang.run.comparison import WHOLE, Benched, compare_minds, credit_of, differing_tasks, given_back, silenced
from mindlang.run.outcome import bench_data, over_at_once
from mindlang.run.paired_difference import CONFIDENCE_LEVEL
from mindlang.run.promises import FEW_TICKS, MAX_COUNTED_TICKS, promises_in
from mindlang.run.roles import roles_data, roles_text
from mindlang.run.summary import bench_summary, comparison_summary, credit_summary, worlds_summary
from mindlang.run.tables import Table, csv_parts, joined, runs_table
from mindlang.run.worlds import World, figure, world_rows, worlds

MAX_COMPARED = 2  # minds, or masters


@dataclass(frozen=True, slots=True)
class Contender:
    """A mind that runs, the master it is asked to run under, and what it is called beside another."""

    file: str
    master: str | None
    name: str


def contenders(files: Sequence[str], masters: Sequence[str]) -> list[Contender]:
    """The contenders: one mind, two minds, each with its own master if it has one, or one mind under two masters."""
    if len(files) > MAX_COMPARED or len(masters) > MAX_COMPARED:
        terminal.fail(
            "Two are compared, not more.",
            "mindc bench A.mind B.mind, or one FILE with --master X --master Y",
            terminal.MISUSE,
        )
    count = max(len(files), len(masters))
    asked: Sequence[str | None] = masters or [None]
    both = [(files[i % len(files)], asked[i % len(asked)]) for i in range(count)]
    if len(files) == 1:
        names = [str(master) for _, master in both]
    else:
        names = [f"{file} with {master}" if len(masters) == MAX_COMPARED else file for file, master in both]
    if len({*names}) < count:
        names = [f"{name} ({place})" for name, place in zip(names, "AB", strict=True)]
    return [Contender(*each, name) for each, name in zip(both, names, strict=True)]


@dataclass(frozen=True, slots=True)
class Bench:
    """The runs to make, the workers that make them, so many of this machine or those of --on, and the output."""

    session: RunSession
    workers: int
    task: str | None
    runs: int
    seed: int
    where: Where | None
    interrupt: bool
    table: Path | None

    def measure(self, who: Sequence[Contender]) -> None:
        """Run one mind, and print its means."""
        (prepared,) = self._prepared(who)
        setup = prepared.setup
        task, seeds = setup.task, setup.layouts(self.seed, self.runs)
        self.session.note(*setup.world_notes)
        scores, data = self._score(prepared, seeds)
        self.session.note(*over_at_once(task, scores))
        found = {"task": task.name, "master": setup.master, "seed": self.seed, **self._by(), **data}
        self._write(lambda: runs_table(task, scores, seeds), f"{len(seeds):,} runs")
        terminal.print_result(found, lambda: Group(bench_summary(found), *roles_text(found)))

    def compare(self, who: Sequence[Contender]) -> None:
        """Run both on the same layouts, the second on the task of the first, and print what differs."""
        ready = self._prepared(who)
        tasks = [each.setup.task for each in ready]
        seeds = max((each.setup.layouts(self.seed, self.runs) for each in ready), key=len)
        notes = differing_tasks(who[1].file, *tasks)
        self.session.note(*notes)
        benched, minds = [], []
        for each, prepared in zip(who, ready, strict=True):
            scores, data = self._score(prepared, seeds, f"{each.name}: ")
            benched.append(Benched(each.name, prepared.setup.task, scores))
            minds.append(_named(each, prepared) | data)
        compared = compare_minds(benched[0], benched[1], all(each.setup.is_one_world for each in ready))
        found: dict[str, Any] = {"task": tasks[0].name, "seed": self.seed, "runs": len(seeds), **self._by()}
        found |= {"minds": minds, **compared.data(), "notes": notes}
        self._write(
            lambda: joined({each.name: runs_table(each.task, each.scores, seeds) for each in benched}),
            f"2 × {len(seeds):,} runs",
        )
        terminal.print_result(found, lambda: comparison_summary(found, compared))

    def in_worlds(self, who: Sequence[Contender]) -> None:
        """Run each mind as it was taught and in changed worlds, on the same layouts, and print what is left there."""
        ready = self._prepared(who)
        cast = [(each, *there) for each, here in zip(who, ready, strict=True) for there in self._worlds(here)]
        task = ready[0].setup.task.name
        found: dict[str, dict[str, Any]] = {}
        tables: dict[str, dict[str, Table]] = {}
        with self.session.counting(f"{task} in changed worlds", sum(len(seeds) for *_, seeds in cast)) as ran:
            for each, world, prepared, seeds in cast:
                scores, data = self._score(prepared, seeds, f"{each.name}, {world.name}: ", ran)
                found.setdefault(world.name, {})[each.name] = {"changes": world.changes, **data}
                if self.table:
                    tables.setdefault(world.name, {})[each.name] = runs_table(prepared.setup.task, scores, seeds)
        data = {"task": task, "seed": self.seed, "runs": self.runs, **self._by()}
        data |= {"minds": [*map(_named, who, ready)], "worlds": world_rows(found)}
        self._write(
            lambda: joined({name: joined(each) for name, each in tables.items()}, "world"),
            f"{len(cast)} × {self.runs:,} runs",
        )
        terminal.print_result(data, lambda: worlds_summary(data))

    def credit(self, who: Sequence[Contender]) -> None:
        """Run a mind whole, then without each of its skills on the same layouts, and print what each is worth.

        With another mind the skills are not silent in turn, but have the weights that they have there.
        """
        if len({each.file for each in who}) < len(who):
            terminal.fail("Credit is given under one master.", "mindc bench FILE --credit", terminal.MISUSE)
        (whole,) = self._prepared(who[:1])
        setup, policy = whole.setup, whole.setup.ready.policy
        task, seeds = setup.task, setup.layouts(self.seed, self.runs)
        if len(who) == 1:
            minds = silenced(policy, setup.master)
        else:
            other = terminal.load_compiled(who[1].file)
            minds = given_back(policy, make_ready(other.whole[1], other.sources).policy, setup.master)
        if not minds:
            none = f"No skill of {setup.master} in {who[0].file} has other weights in {who[1].file}."
            terminal.fail(none, code=terminal.MISUSE)
        cast = {WHOLE: whole} | {name: self._elsewhere(whole, each) for name, each in minds.items()}
        scores: dict[str, Scores] = {}
        data: dict[str, dict[str, Any]] = {}
        with self.session.counting(f"{task.name} without each skill", len(seeds) * len(cast)) as ran:
            for name, each in cast.items():
                scores[name], data[name] = self._score(each, seeds, f"without {name}: " if name else "", ran)
        figured = figure(data[WHOLE])[0]
        credited = credit_of(task, scores, figured)
        left = "without" if len(who) == 1 else f"as in {who[1].file}"
        found = {"task": task.name, "master": setup.master, "seed": self.seed, **self._by(), **data[WHOLE]}
        found |= {"figure": figured, "confidence": CONFIDENCE_LEVEL, "left": left}
        found |= {"skills": [{"skill": name, **data[name], "credit": asdict(each)} for name, each in credited.items()]}
        self._write(
            lambda: joined({name: runs_table(task, each, seeds) for name, each in scores.items()}, left),
            f"{len(cast)} × {len(seeds):,} runs",
        )
        terminal.print_result(found, lambda: credit_summary(found, credited))

    def _worlds(self, here: Prepared) -> Iterator[tuple[World, Prepared, list[int]]]:
        """The worlds for a mind, each with the simulator that makes its runs, and their seeds."""
        setup = here.setup
        for world in worlds(setup.ready.policy.graph, setup.task, setup.master):
            there = self._elsewhere(here, replace(setup.ready.policy, graph=world.graph))
            yield world, there, there.setup.layouts(self.seed, self.runs)

    def _elsewhere(self, here: Prepared, policy: Policy) -> Prepared:
        """A mind that is prepared, with another policy in the place of its own, and the simulator for that."""
        setup, quiet = here.setup.with_policy(policy), replace(self.session, quiet=True)
        return here._replace(setup=setup, rollout=quiet.simulator(setup, self.interrupt, self.workers, self.runs))

    def _prepared(self, who: Sequence[Contender]) -> list[Prepared]:
        """Each mind and the simulator for it, all of them with the task of the first."""
        ready: list[Prepared] = []
        for each in who:
            task = ready[0].setup.task.name if ready else self.task
            chosen = options.RunChoice(task, self.seed, each.master, self.interrupt)
            ready.append(self.session.prepare(each.file, chosen, self.workers, self.runs))
        return ready

    def _score(
        self, prepared: Prepared, seeds: Sequence[int], whose: str = "", ran: Ran | None = None
    ) -> tuple[Scores, dict[str, Any]]:
        """The score of each run, and the data of all of them; notes and progress are as in `RunSession.score`.

        Promises are counted over fewer runs where these are some of many, of which `ran` is told, and roles in none.
        """
        setup, rollout = prepared
        cast = setup.ready.policy, setup.task.name, setup.master, setup.folder
        assignment = partial(assignment_of, *cast, interrupt=self.interrupt)
        with scorer_on(self.where, rollout, assignment, self.workers, self.session.say) as scorer:
            scores, seconds, cpu = self.session.score(scorer, seeds, whose, ran)
        data = bench_data(setup.task, scores, seeds, seconds, None if self.where else cpu)
        data |= {"notes": setup.notes(rollout, *over_at_once(setup.task, scores))}
        with terminal.procedures_talk():
            promises = promises_in(rollout, setup.master, seeds, FEW_TICKS if ran else MAX_COUNTED_TICKS)
            roles = {} if ran else roles_data(rollout, seeds)
        return scores, data | ({"promises": promises} if promises else {}) | roles

    def _by(self) -> dict[str, int | str]:
        """The workers that make the runs, as data."""
        return {"workers": self.workers} if self.where is None else {"on": f"{self.where}"}

    def _write(self, rows: Callable[[], Table], runs: str) -> None:
        if self.table:
            terminal.write_file(self.table, csv_parts(rows()))
            self.session.say(f"{self.table}: a row for each of {runs}")


def _named(who: Contender, ready: Prepared) -> dict[str, Any]:
    return {"name": who.name, "file": who.file, "master": ready.setup.master}
