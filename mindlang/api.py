"""A mind as a value: loaded, run, simulated, taught, edited and bundled."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path
from time import perf_counter
from typing import Any

from mindrun.bundle import Bundle
from mindrun.engine import Engine, procedure_sources
from mindrun.errors import MindError
from mindrun.graph import Graph
from mindrun.sim.rollout import Rollout
from mindrun.sim.trace import Run as Trace
from mindrun.sim.trace import trace
from mindrun.train.lesson_state import Record
from mindrun.train.run_folder import read_result
from mindrun.train.training import Watch, train
from mindrun.weights import genes, reachable
from mindrun.wiring import Wiring

from mindlang.compiler.compile import Compiled, compile_source
from mindlang.compiler.compile import load as load_file
from mindlang.compiler.diagnostic import Diagnostic
from mindlang.compiler.source import Source
from mindlang.editing.apply import Edited, apply_edit
from mindlang.editing.project import open_project
from mindlang.edits import edit as edit_named
from mindlang.lock.ready import Ready, make_ready
from mindlang.run.setup import master_of, task_of
from mindlang.training.lesson_choice import TrainOptions, chosen_lessons
from mindlang.training.results import Result
from mindlang.training.subject import begin_run, open_subject
from mindlang.training.teaching import finish, has_ended, rollout_of


@dataclass(frozen=True, slots=True)
class Mind:
    """A file of the mind language, and those that it uses, as they were when it was loaded.

    All but `diagnostics` and `is_valid` raise MindError where the file has errors, and where weights are needed that
    were not taught, or fit no longer; its `hint` says what to do. Weights always come with the graph in whose order
    they are: there is no way to give one mind those of another.
    """

    path: Path
    compiled: Compiled

    @property
    def diagnostics(self) -> tuple[Diagnostic, ...]:
        """What is wrong, in the order of the text: each with a code, a message, a hint and where it is."""
        return self.compiled.diagnostics

    @property
    def is_valid(self) -> bool:
        """Whether it compiles."""
        return self.compiled.graph is not None

    @property
    def graph(self) -> Graph:
        """The compiled hierarchy, as plain data."""
        if self.compiled.graph is None:
            first = next((each for each in self.diagnostics if each.severity == "error"), self.diagnostics[0])
            raise MindError(first.message, first.hint)
        return self.compiled.graph

    def ready(self, master: str | None = None) -> Ready:
        """The hierarchy in the order of its weights, with those that `master` (default: the mind's) needs to act."""
        ready = make_ready(self.graph, self.compiled.sources, master)
        if ready.refusals:
            raise MindError(ready.refusals[-1], f"mind.train() teaches it, or: mindc train {self.path}")
        return ready

    def engine(self, master: str | None = None) -> Engine:
        """The hierarchy as it runs on a robot: readings [graph.width] to commands [actuators], tick by tick."""
        ready = self.ready(master)
        return Engine(ready.policy, self._folder, master)

    def rollout(
        self, task: str | None = None, master: str | None = None, learners: Sequence[str] = (), workers: int = 1
    ) -> Rollout:
        """Simulated runs of a task (default: that of the master's first lesson), many at once.

        `rollout.score(genomes, seeds)` takes genomes [genomes, weights] of the `learners`, one after the other, and
        gives scores, counts and lengths as arrays [genomes, seeds].
        """
        chosen, _ = task_of(self.graph, task)
        leader = master_of(self.graph, chosen, master)
        ready = make_ready(self.graph, self.compiled.sources, leader)
        acting = {skill.name for skill in reachable(ready.policy.graph, leader) if genes(skill)}
        if acting - {*ready.policy.weights, *learners}:
            raise MindError(ready.refusals[-1], f"mind.train() teaches it, or: mindc train {self.path}")
        return Rollout(ready.policy, chosen.name, leader, learners, procedures=self._folder, workers=workers)

    def trace(self, task: str | None = None, seed: int = 0, master: str | None = None) -> Trace:
        """One run of a task, tick by tick: `for moment in mind.trace("Collect", 3).moments`."""
        return trace(self.rollout(task, master), seed)

    def train(
        self,
        *skills: str,
        curriculum: str | None = None,
        options: TrainOptions = TrainOptions(),  # noqa: B008  # a frozen value
        seed: int = 0,
        workers: int = 1,
        runs: Path | str = "runs",
        on_generation: Callable[[Record], None] = lambda record: None,
        cancelled: Callable[[], bool] = lambda: False,
    ) -> list[Result]:
        """Teach these skills, or all of a curriculum (default: the first); what is learnt goes to the lock.

        `on_generation` is told of each generation, after which `cancelled` is asked: where it says so, the run stays in
        its folder under `runs`, and the same call goes on with it. The result of each lesson that has ended.
        """
        results: list[Result] = []
        watch = Watch(lambda state, record: on_generation(record), lambda words: None, cancelled, perf_counter)
        for lesson in chosen_lessons(self.graph, curriculum, skills):
            subject = open_subject(self.path, self.compiled)  # the lesson before has changed the lock
            run = begin_run(
                subject, options.applied(lesson), seed, Path(runs), datetime.now(UTC), ("mindlang.Mind.train",)
            )
            if (result := read_result(run.folder)) is None:
                rollout = rollout_of(run, subject, workers)
                state = train(run, rollout, watch)
                if not has_ended(run, state):
                    break
                result = finish(run, subject, state, rollout, force=False).result
            results.append(result)
        return results

    def edit(self, name: str, keep_weights: bool = False, **arguments: Any) -> Edited:
        """One of the edits of `mindc edit`, made in memory: `mind.edit("rename", old="eye", new="ear")`.

        `mindlang.editing.summary` says what it comes to, `mindlang.editing.writing.write` writes it.
        """
        project = open_project(self.compiled)
        return apply_edit(project, edit_named(name).function(project, **arguments), keep_weights)

    def bundle(self, wiring: Wiring | None = None, master: str | None = None) -> Bundle:
        """All that runs on a robot; `mindrun.bundle.write_bundle` writes it to one file."""
        ready = self.ready(master)
        return Bundle(ready.policy, procedure_sources(ready.policy.graph, self._folder), wiring)

    @property
    def _folder(self) -> Path:
        return self.path.absolute().parent


def load(path: Path | str) -> Mind:
    """The mind in a file; never raises for what stands there: `diagnostics` says what is wrong."""
    return Mind(Path(path), load_file(Path(path)))


def loads(text: str, texts: Mapping[Path, str] | Iterable[tuple[Path, str]] = (), name: str = "text.mind") -> Mind:
    """The mind in a text, as if it stood in the working directory; `texts` are those of files that it uses."""
    path = Path.cwd() / name
    return Mind(path, compile_source(Source(name, text, path.parent), path, dict(texts)))
