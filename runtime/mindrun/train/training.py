"""A run from where it stands to its end: generations, their log, a checkpoint every two seconds."""

from collections.abc import Callable
from dataclasses import dataclass, replace

from mindrun.errors import system_errors_as
from mindrun.train import RunError, checkpoint
from mindrun.train.attempt import Clock
from mindrun.train.attempts import Ahead, AttemptExecutor, InThisThread, side_by_side
from mindrun.train.champion_log import ChampionLog
from mindrun.train.lesson_state import Course, LessonState, Record, begin, is_reachable
from mindrun.train.population import Genomes
from mindrun.train.progress import ProgressLog
from mindrun.train.run_folder import RunFolder, claim, keep_champions, keep_weights
from mindrun.train.scoring import Scorer

CHECKPOINT_SECONDS = 2.0  # between two checkpoints
NO_ROOM = "what was saved last is intact: make room, then go on with --resume"


@dataclass(frozen=True, slots=True)
class Watch:
    """An observer: told of each generation and each warning, asked between generations whether to stop."""

    report: Callable[[LessonState, Record], None]
    warn: Callable[[str], None]
    stop: Callable[[], bool]
    clock: Clock
    count_ahead: Callable[[Ahead], None] = lambda ahead: None  # told what others have done ahead, before it is reported
    save_every: float = CHECKPOINT_SECONDS


def train(run: RunFolder, scorer: Scorer, watch: Watch, executor: AttemptExecutor | None = None) -> LessonState:
    """Go on with a run until its lesson is finished or `watch` says stop; the state, which is then saved.

    Generation after generation here, or its attempts side by side where there is an `executor`. RunError where another
    process has the run, its checkpoints are damaged, or the disk takes no more.
    """
    course = run.course(scorer.genome_length)
    with system_errors_as(RunError, f"cannot write to {run.folder}", NO_ROOM), claim(run.folder):
        now = _standing(run, course, watch)
        with ProgressLog(run.folder, now) as progress, ChampionLog(run.folder, now, watch.warn) as champions:
            saved, seconds, began = watch.clock(), now.seconds, watch.clock()
            stretches = executor or InThisThread(course, scorer, watch.clock)
            for step in side_by_side(course, stretches, now, watch.stop):
                now = step.state
                if executor:  # the seconds of several at once are not the sum of their own
                    now = replace(now, seconds=seconds + watch.clock() - began)
                watch.count_ahead(step.ahead)
                for record, champion in zip(step.records, step.champions, strict=True):
                    progress.append(record)
                    champions.append(champion, (record.attempt, record.generation))
                    watch.report(now, record)
                if watch.clock() - saved >= watch.save_every:
                    _save(run, now, progress, champions)
                    saved = watch.clock()
            _save(run, now, progress, champions)
        if len(genomes := best(now)):
            keep_weights(run.folder, genomes[0])
        if len(now.champions):
            keep_champions(run.folder, now.champions)
    return now


def best(state: LessonState) -> Genomes:
    """The best weights so far [0 or 1, weights]: of the attempts that have ended, else of this one."""
    return state.kept if len(state.kept) else state.now.champion


def _standing(run: RunFolder, course: Course, watch: Watch) -> LessonState:
    found = checkpoint.load(run.folder, run.manifest.identity)
    if found is None:
        return begin(course)
    state, warning = found
    if not is_reachable(course, state):
        raise RunError(
            f"{run.folder / checkpoint.NAME} is damaged: no run of this lesson comes to where it stands",
            "start the lesson again without --resume",
        )
    if warning:
        watch.warn(warning)
    return state


def _save(run: RunFolder, state: LessonState, *logs: ProgressLog | ChampionLog) -> None:
    for log in logs:
        log.sync()
    checkpoint.save(run.folder, state, run.manifest.identity)
