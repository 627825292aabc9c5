"""A mind as a value: loaded, run, simulated, taught, edited and bundled."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path
from time import perf_counter
from typing import Any
from warnings import warn

from mindrun.engine.engine import Engine, procedure_sources
from mindrun.errors import MindError
from mindrun.graph.bundle import Bundle
from mindrun.graph.graph import Graph
from mindrun.graph.policy import Policy
from mindrun.graph.wiring import Wiring
from mindrun.numbers.short_repr import ShortRepr
from mindrun.sim.rollout import Rollout
from mindrun.sim.rollouts import rollout_for
from mindrun.sim.trace import Trace, trace
from mindrun.train.lesson_state import Record
from mindrun.train.training import Watch
from networkx import DiGraph

from mindlang import executors
from mindlang.compiler.compile import Compiled, compile_source
from mindlang.compiler.compile import load as load_file
from mindlang.compiler.diagnostic import Diagnostic
from mindlang.compiler.source import Source
from mindlang.editing import edits
from mindlang.editing.apply import Edited, apply_edit
from mindlang.editing.project import EditError, open_project
from mindlang.editing.summary import broken_sentences, diff, summarise
from mindlang.editing.writing import write
from mindlang.limits import as_layout, as_workers, refuse_too_large, refuse_too_many
from mindlang.lock.ready import ReadyMind, make_ready
from mindlang.run.columns import Column
from mindlang.run.many_runs import run_timed
from mindlang.run.outcome import bench_data, over_at_once
from mindlang.run.recorded_run import record_run
from mindlang.run.setup import RunSetup, master_of, set_up, skill_of, task_of, train_command, unknown, untaught_skills
from mindlang.run.trace_file import trace_table
from mindlang.training.lesson_choice import TrainOptions, chosen_lessons
from mindlang.training.results import Result
from mindlang.training.subject import begin_run, open_subject, refuse_frozen
from mindlang.training.teaching import teach


@dataclass(frozen=True, slots=True, repr=False)
class Mind(ShortRepr):
    """A file of the mind language, and those that it uses, as they were when it was loaded.

    All but `diagnostics` and `is_valid` raise MindError where its text has errors, where a procedure is needed that
    cannot be called, and where weights are that were not taught, or fit no longer; its `hint` says what to do.
    """

    path: Path
    compiled: Compiled

    @property
    def diagnostics(self) -> tuple[Diagnostic, ...]:
        """What is wrong, in the order of the text: each with a code, a message, a hint and where it is."""
        return self.compiled.diagnostics

    @property
    def is_valid(self) -> bool:
        """Whether it compiles, and its procedures can be called."""
        return self.compiled.is_valid

    @property
    def graph(self) -> Graph:
        """The compiled hierarchy, as plain data."""
        graph = self._without_errors().graph
        assert graph
        return graph

    @property
    def hierarchy(self) -> DiGraph:
        """All parts and what flows between them, as a graph of networkx.

        >>> mind = mindlang.load("collect.mind")
        >>> sorted(str(node) for node in networkx.descendants(mind.hierarchy, ("skill", "Grab")))
        ['actuator claw']
        """
        mind = self._without_errors().mind
        assert mind
        return mind.hierarchy

    def policy(self, master: str | None = None) -> Policy:
        """The hierarchy with the weights that `master` (default: the mind's) needs to act."""
        return self._ready(master).policy

    def notes(self, master: str | None = None) -> tuple[str, ...]:
        """A sentence for the skills that were taught in a world that is not the mind's, or is not known."""
        return self._ready(master).notes

    def engine(self, master: str | None = None) -> Engine:
        """The hierarchy as it runs on a robot: readings [graph.width] to commands [actuators], tick by tick."""
        return Engine(self.policy(master), self._folder, master)

    def rollout(
        self, task: str | None = None, master: str | None = None, learners: Sequence[str] = (), workers: int = 1
    ) -> Rollout:
        """Simulated runs of a task (default: that of the master's first lesson), many at once.

        `rollout.score(genomes, seeds)` takes genomes [genomes, weights] of the `learners`, in the order given here, and
        gives scores, counts and lengths as arrays [genomes, seeds].
        """
        (chosen, _), threads = task_of(self.graph, task), as_workers(workers)
        leader = master_of(self.graph, chosen, master)
        for skill in learners:
            skill_of(self.graph, skill)
        ready = make_ready(self.graph, self.compiled.sources, leader)
        if {*untaught_skills(ready)} - {*learners}:
            raise self._untaught(ready)
        return rollout_for(ready.policy, chosen.name, leader, learners, procedures=self._folder, workers=threads)

    def trace(self, task: str | None = None, seed: int = 0, master: str | None = None) -> Trace:
        """One run of a task, tick by tick: `for moment in mind.trace("Collect", 3).moments`."""
        return trace(self.rollout(task, master), as_layout(seed))

    def trace_table(self, task: str | None = None, seed: int = 0, master: str | None = None) -> dict[str, Column]:
        """One run as columns by name, a row for each tick, as `mindc run --trace` has it; pandas takes it as it is."""
        setup = self._set_up(task, master)
        return trace_table(record_run(setup, setup.rollout(), as_layout(seed)))

    def bench(
        self, task: str | None = None, runs: int = 200, seed: int = 1, master: str | None = None, workers: int = 1
    ) -> dict[str, Any]:
        """Many runs of a task on layouts that `seed` draws: each mean with its standard error, as `mindc bench --json`.

        `count_…` is of the events that the task counts, `score_…` of the rewards; `mind.trace` repeats `best_seed`.
        """
        cast = self._set_up(task, master)
        seeds = cast.layouts(seed, runs)
        refuse_too_many(cast.task, runs)
        rollout = cast.rollout(workers=as_workers(workers))
        refuse_too_large(rollout, 1, runs)
        scores, *took = run_timed(rollout, seeds)
        notes = cast.notes(rollout, *over_at_once(cast.task, scores))
        data = bench_data(cast.task, scores, seeds, *took) | {"notes": notes}
        return {"task": cast.task.name, "master": cast.master, "seed": int(seed)} | data

    def train(
        self,
        *skills: str,
        curriculum: str | None = None,
        options: TrainOptions = TrainOptions(),  # noqa: B008  # a frozen value
        seed: int = 0,
        workers: int = 1,
        on: str = executors.THREADS,
        runs: Path | str = "runs",
        on_generation: Callable[[Record], None] = lambda record: None,
        cancelled: Callable[[], bool] = lambda: False,
    ) -> list[Result]:
        """Teach these skills, or what is due of a curriculum (default: the first); what is learnt goes to the lock.

        `on` says who does the attempts: "processes:2", "dask:scheduler.json". `on_generation` is told of each
        generation, after which `cancelled` is asked. Where that says so, or Ctrl-C comes, the run stays in its folder
        under `runs`, and the same call goes on with it, to the same bits. The result of each lesson that has ended.
        """
        if self.graph and not self.path.is_file():  # a mind that does not compile says so first
            raise MindError(f"{self.path} is no file, and what is learnt is kept beside one", "save it, and load that")
        subject = open_subject(self.path, self.compiled)
        chosen = chosen_lessons(self.graph, curriculum, skills, subject.trained)
        results, threads, elsewhere = list[Result](), as_workers(workers), executors.where(on)
        watch = Watch(lambda state, record: on_generation(record), warn, cancelled, perf_counter)
        refuse_frozen(subject, chosen if skills else ())
        for lesson in chosen:
            subject = open_subject(self.path, self.compiled)  # the lesson before has changed the lock
            if not subject.takes(lesson, bool(skills)):
                continue
            by = "mindlang.Mind.train", *skills
            run = begin_run(subject, options.applied(lesson), seed, Path(runs), datetime.now(UTC), by)
            if (result := teach(run, subject, threads, watch, elsewhere)) is None:
                break
            results.append(result)
        return results

    def edit(self, name: str, keep_weights: bool = False, **arguments: Any) -> "EditedMind":
        """One of the edits of `mindc edit`, in memory: `mind.edit("rename", old="proximity", new="whiskers")`.

        Arguments and options are those of the command; EditError, a MindError, where it is impossible.
        """
        if name not in edits.names():
            unknown("edit", name, edits.names())
        of, project = edits.edit(name), open_project(self._without_errors())
        several = {each for each, many in of.arguments if many} | {each.name for each in of.options if each.many}
        said = {k: (v,) if k in several and isinstance(v, str) else v for k, v in arguments.items()}
        return EditedMind(self.path, apply_edit(project, of.function(project, **said), keep_weights))

    def bundle(self, wiring: Wiring | None = None, master: str | None = None) -> Bundle:
        """All that runs on a robot; `mindrun.write_bundle` writes it to one file."""
        policy = self.policy(master)
        return Bundle(policy, procedure_sources(policy.graph, self._folder), wiring)

    @property
    def _folder(self) -> Path:
        return self.path.absolute().parent

    def _set_up(self, task: str | None, master: str | None) -> RunSetup:
        return set_up(str(self.path), self._without_errors(), task, master)

    def _without_errors(self) -> Compiled:
        """What it compiled to; MindError where its text has errors."""
        if self.compiled.graph is None:
            first = next((each for each in self.diagnostics if each.severity == "error"), self.diagnostics[0])
            raise MindError(first.message, first.hint or "mind.diagnostics says all that is wrong, and where")
        return self.compiled

    def _ready(self, master: str | None) -> ReadyMind:
        if master is not None:
            skill_of(self.graph, master)
        ready = make_ready(self.graph, self.compiled.sources, master)
        if ready.refusals:
            raise self._untaught(ready)
        return ready

    def _untaught(self, ready: ReadyMind) -> MindError:
        return MindError(ready.refusals[-1], f"mind.train() teaches it, or: {train_command(self.path, ready)}")


@dataclass(frozen=True, slots=True, repr=False)
class EditedMind(ShortRepr):
    """A mind after an edit, in memory: nothing has been written yet."""

    path: Path
    edited: Edited

    @property
    def diff(self) -> str:
        """The unified diff of all sources."""
        return diff(self.edited)

    @property
    def summary(self) -> list[str]:
        """A sentence for each skill whose weights do not simply stay, and for each mind that would be broken."""
        return [*summarise(self.edited), *broken_sentences(self.edited)]

    def write(self, anyway: bool = False) -> Mind:
        """Write sources, locks and weights together, or nothing; the mind as it is then.

        MindError where a file has changed since it was loaded; where another mind would not compile, unless `anyway`.
        """
        if (broken := broken_sentences(self.edited)) and not anyway:
            raise EditError(f"After this edit {broken[0]}", "write(anyway=True) makes it nevertheless")
        write(self.edited)
        return load(self.path)


def load(path: Path | str) -> Mind:
    """The mind in a file; whatever stands there, nothing is raised for it: `diagnostics` says what is wrong."""
    return Mind(Path(path), load_file(Path(path)))


def loads(text: str, texts: Mapping[Path, str] | None = None, name: str = "text.mind") -> Mind:
    """The mind in a text, as if it stood in the working directory; `texts` are those of files that it uses, by path."""
    path = Path.cwd() / name
    return Mind(path, compile_source(Source(name, text, path.parent), path, texts or {}))
