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
from mindlang.editing.apply import Edited, apply_edit, write
from mindlang.editing.project import EditError, open_project
from mindlang.editing.summary import broken_sentences, diff, summarise
from mindlang.limits import LAYOUT_BOUNDS, WORKER_BOUNDS, bounded_int, refuse_too_large, refuse_too_many
from mindlang.lock.status import ReadyMind, make_ready
from mindlang.run.chosen_task import master_of, robot_of, skill_of, task_of, unknown
from mindlang.run.outcome import bench_data, over_at_once
from mindlang.run.recorded_run import record_run
from mindlang.run.roles import roles_data
from mindlang.run.setup import RunSetup, run_timed, set_up, train_command, untaught_skills
from mindlang.run.tables import Column, trace_table
from mindlang.training.lesson_choice import TrainOptions, lessons_to_teach
from mindlang.training.subject import begin_run
from mindlang.training.teaching import Result, teach


@dataclass(frozen=True, slots=True, repr=False)
class Mind(ShortRepr):
    """A file of the mind language, and those that it uses, as they were when it was loaded.

    All but `diagnostics` and `is_valid` raise MindError where its text has errors, where a procedure is needed that
    cannot be called, and where weights are that were not taught, or fit no longer; its `hint` says what to do.

    >>> mind = mindlang.load("collect.mind")
    >>> mind.is_valid
    True
    """

    path: Path
    compiled: Compiled

    @property
    def diagnostics(self) -> tuple[Diagnostic, ...]:
        """All that is wrong, in the order of the text: each with a code, a message, a hint and where it is.

        >>> [each.code for each in mindlang.loads("master Nobody").diagnostics]
        ['no-tick', 'no-body', 'unknown-skill']
        """
        return self.compiled.diagnostics

    @property
    def is_valid(self) -> bool:
        """True if it compiles, and its procedures can be called.

        >>> mind.is_valid
        True
        """
        return self.compiled.is_valid

    @property
    def graph(self) -> Graph:
        """The compiled hierarchy, as plain data.

        >>> mind.graph.master, [actuator.name for actuator in mind.graph.actuators]
        ('Collect', ['left_wheel', 'right_wheel', 'claw'])
        """
        return self._without_errors().whole[1]

    @property
    def hierarchy(self) -> DiGraph:
        """All parts and what flows between them, as a graph of networkx.

        >>> sorted(str(node) for node in networkx.descendants(mind.hierarchy, ("skill", "Grab")))
        ['actuator claw']
        """
        return self._without_errors().whole[0].hierarchy

    def policy(self, master: str | None = None) -> Policy:
        """The hierarchy with the weights that `master` (default: the mind's) needs to act.

        >>> sorted(mind.policy("GoToObject").weights)
        ['GoToObject']
        """
        return self._ready(master).policy

    def notes(self, master: str | None = None) -> tuple[str, ...]:
        """A sentence for the skills that were taught in a world that is not the mind's.

        >>> mind.notes()
        ()
        """
        return self._ready(master).notes

    def engine(self, master: str | None = None) -> Engine:
        """The hierarchy as it runs on a robot: readings [graph.width] to commands [actuators], tick by tick.

        >>> engine = mind.engine()
        >>> engine.tick(numpy.full(mind.graph.width, 0.5)).shape
        (3,)
        """
        return Engine(self.policy(master), self._folder, master)

    def rollout(
        self, task: str | None = None, master: str | None = None, learners: Sequence[str] = (), workers: int = 1
    ) -> Rollout:
        """Simulated runs of a task (default: that of the master's first lesson), many at once.

        `rollout.score(genomes, seeds)` takes genomes [genomes, weights] of the `learners`, in the order given here, and
        gives scores, counts and lengths as arrays [genomes, seeds].

        >>> rollout = mind.rollout("GoToObject", learners=["GoToObject"])
        >>> genomes = numpy.zeros((2, rollout.genome_length), numpy.float32)
        >>> rollout.score(genomes, seeds=[1, 2, 3]).total.shape
        (2, 3)
        """
        (chosen, _), threads = task_of(self.graph, task), bounded_int("workers", WORKER_BOUNDS, workers)
        leader = master_of(self.graph, chosen, master)
        for skill in learners:
            skill_of(self.graph, skill)
        ready = make_ready(self.graph, self.compiled.sources, leader)
        if {*untaught_skills(ready)} - {*learners}:
            raise self._untaught(ready)
        return rollout_for(ready.policy, chosen.name, leader, learners, procedures=self._folder, workers=threads)

    def trace(self, task: str | None = None, seed: int = 0, master: str | None = None, robot: int = 0) -> Trace:
        """One run of a task, tick by tick; of several robots in its world, that of a number.

        >>> [*mind.trace("Avoid", seed=3).moments][-1].tick
        10000
        """
        rollout = self.rollout(task, master)
        return trace(rollout, bounded_int("seed", LAYOUT_BOUNDS, seed), robot=robot_of(rollout.task, robot))

    def trace_table(
        self, task: str | None = None, seed: int = 0, master: str | None = None, robot: int = 0
    ) -> dict[str, Column]:
        """One run as columns by name, a row for each tick, as `mindc run --trace` has it; pandas takes it as it is.

        >>> int(mind.trace_table("Collect", seed=3)["event delivery of object"].sum())
        12
        """
        setup = self._set_up(task, master, robot)
        return trace_table(record_run(setup, setup.rollout(), bounded_int("seed", LAYOUT_BOUNDS, seed)))

    def bench(
        self, task: str | None = None, runs: int = 200, seed: int = 1, master: str | None = None, workers: int = 1
    ) -> dict[str, Any]:
        """Many runs of a task on layouts that `seed` draws: each mean with its standard error, as `mindc bench --json`.

        `count_…` is of the events that the task counts, `score_…` of the rewards; `mind.trace` repeats `best_seed`.
        Of several robots `roles` says who does what.

        >>> found = mind.bench("Collect", runs=20)
        >>> found["runs"], found["count_mean"]
        (20, 11.45)
        """
        setup = self._set_up(task, master)
        seeds = setup.layouts(seed, runs)
        refuse_too_many(setup.task, runs)
        rollout = setup.rollout(workers=bounded_int("workers", WORKER_BOUNDS, workers))
        refuse_too_large(rollout, 1, runs)
        scores, *took = run_timed(rollout, seeds)
        notes = setup.notes(rollout, *over_at_once(setup.task, scores))
        data = bench_data(setup.task, scores, seeds, *took) | {"notes": notes}
        data |= roles_data(rollout, seeds)
        return {"task": setup.task.name, "master": setup.master, "seed": int(seed)} | data

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

        >>> [result] = mind.train("GoToObject", options=mindlang.TrainOptions(generations=1, attempts=1))
        >>> result["skill"], result["generations"]
        ('GoToObject', 1)
        """
        if self.graph and not self.path.is_file():  # a mind that does not compile says so first
            raise MindError(f"{self.path} is no file, and what is learnt is kept beside one", "save it, and load that")
        threads = bounded_int("workers", WORKER_BOUNDS, workers)
        results, elsewhere = list[Result](), executors.where(on)
        watch = Watch(lambda state, record: on_generation(record), warn, cancelled, perf_counter)
        by = "mindlang.Mind.train", *skills
        for subject, lesson in lessons_to_teach(self.path, self.compiled, curriculum, skills, options):
            run = begin_run(subject, lesson, seed, Path(runs), datetime.now(UTC), by)
            if (result := teach(run, subject, threads, watch, elsewhere)) is None:
                break
            results.append(result)
        return results

    def edit(self, name: str, keep_weights: bool = False, **arguments: Any) -> "EditedMind":
        """One of the edits of `mindc edit`, in memory.

        Arguments and options are those of the command; EditError, a MindError, where it is impossible.

        >>> mind.edit("rename", old="proximity", new="whiskers").summary
        ['6 trained skills keep what was learnt']
        """
        if name not in edits.names():
            unknown("edit", name, edits.names())
        of, project = edits.edit(name), open_project(self._without_errors())
        several = {each for each, many in of.arguments if many} | {each.name for each in of.options if each.many}
        said = {k: (v,) if k in several and isinstance(v, str) else v for k, v in arguments.items()}
        return EditedMind(self.path, apply_edit(project, of.function(project, **said), keep_weights))

    def bundle(self, wiring: Wiring | None = None, master: str | None = None) -> Bundle:
        """All that runs on a robot; `mindrun.write_bundle` writes it to one file.

        >>> mind.bundle(master="Avoid").graph.master
        'Avoid'
        """
        policy = self.policy(master)
        return Bundle(policy, procedure_sources(policy.graph, self._folder), wiring)

    @property
    def _folder(self) -> Path:
        return self.path.absolute().parent

    def _set_up(self, task: str | None, master: str | None, robot: int = 0) -> RunSetup:
        return set_up(str(self.path), self._without_errors(), task, master, robot=robot)

    def _without_errors(self) -> Compiled:
        """The compiled mind; MindError where its text has errors."""
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
    """A mind after an edit, in memory: nothing has been written yet.

    >>> edited = mind.edit("rename", old="proximity", new="whiskers")
    >>> mind = edited.write()
    >>> mind.graph.sensors[0].name
    'whiskers'
    """

    path: Path
    edited: Edited

    @property
    def diff(self) -> str:
        """The unified diff of all sources.

        >>> print(mind.edit("rename", old="claw", new="hand").diff.splitlines()[0])
        --- a/collect.mind
        """
        return diff(self.edited)

    @property
    def summary(self) -> list[str]:
        """A sentence for each skill whose weights do not simply stay, and for each mind that would be broken.

        >>> mind.edit("rename", old="claw", new="hand").summary
        ['6 trained skills keep what was learnt']
        """
        return [*summarise(self.edited), *broken_sentences(self.edited)]

    def write(self, anyway: bool = False) -> Mind:
        """Write sources, locks and weights together, or nothing; the mind as it is then.

        MindError where a file has changed since it was loaded; where another mind would not compile, unless `anyway`.

        >>> mind.edit("rename", old="claw", new="hand").write().graph.actuators[2].name
        'hand'
        """
        if (broken := broken_sentences(self.edited)) and not anyway:
            raise EditError(f"After this edit {broken[0]}", "write(anyway=True) makes it nevertheless")
        write(self.edited)
        return load(self.path)


def load(path: Path | str) -> Mind:
    """The mind in a file; whatever stands there, nothing is raised for it: `diagnostics` says what is wrong.

    >>> mindlang.load("collect.mind").is_valid
    True
    >>> mindlang.load("nowhere.mind").diagnostics[0].code
    'unreadable'
    """
    return Mind(Path(path), load_file(Path(path)))


def loads(text: str, texts: Mapping[Path, str] | None = None, name: str = "text.mind") -> Mind:
    """The mind in a text, as if it stood in the working directory; `texts` are those of files that it uses, by path.

    >>> mindlang.loads("master Nobody").is_valid
    False
    """
    path = Path.cwd() / name
    return Mind(path, compile_source(Source(name, text, path.parent), path, texts or {}))
