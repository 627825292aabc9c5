"""A run of a lesson from its beginning to its end: who scores its genomes, its result in data and words, remarks."""

from collections import defaultdict
from collections.abc import Callable, Iterator, Sequence
from contextlib import ExitStack, contextmanager, suppress
from functools import partial
from itertools import islice
from typing import Any

import numpy as np
from mindrun.engine.engine import procedure_sources
from mindrun.errors import ProcedureError
from mindrun.graph.policy import Policy
from mindrun.graph.weights import parts
from mindrun.sim.rollout import Rollout
from mindrun.sim.rollouts import rollout_for
from mindrun.sim.trace import joined, trace
from mindrun.terminal.command_line import command_line
from mindrun.train.attempt import Clock, verdict_layouts
from mindrun.train.attempts import AttemptExecutor, StretchThreads
from mindrun.train.kept_segments import KeptSegments, RememberingExecutor
from mindrun.train.lesson_state import LessonState, is_over
from mindrun.train.population import Genomes, founder_count
from mindrun.train.progress import read_progress
from mindrun.train.run_folder import WEIGHTS, RunFolder, keep_result, read_result
from mindrun.train.scoring import Scorer, breeding_generator, layouts
from mindrun.train.training import Watch, train
from numpy.typing import NDArray

from mindlang.compiler.diagnostic import listed
from mindlang.executors import Where, scorer_on
from mindlang.executors.jobs import JobScorer, StretchExecutor, WorkError, assignment_of
from mindlang.limits import refuse_too_large, refuse_too_long
from mindlang.lock.blobs import digest
from mindlang.number_format import duration, finite, short_score, speed
from mindlang.run.edge_flow import edge_flows
from mindlang.run.promises import FEW_TICKS, promises_in
from mindlang.training.lock_update import Kept, keep
from mindlang.training.retention import retention_table
from mindlang.training.standstill import idle_note, idle_ticks
from mindlang.training.subject import Subject

Result = dict[str, Any]
LOOKED_RUNS, MOMENTS_EACH = 4, 500  # that are looked at, and in each run so many, evenly spaced
MAX_CHUNKS = 400  # of a run: 100,000 ticks, which fit into memory
ALIKE_INFLUENCE = 0.01  # so far apart may be numbers that are the same
Edges = set[tuple[int, int]]  # by their skills
Spans = dict[tuple[int, int], tuple[float, float]]  # the least and the most over each edge


def rollout_of(run: RunFolder, subject: Subject, workers: int) -> Rollout:
    """The rollout that scores the genomes of a run; MindError where memory or a year would not suffice."""
    lesson = run.manifest.lesson
    rollout = rollout_for(
        Policy(subject.graph, run.weights),
        lesson.task,
        lesson.master,
        run.manifest.learners,
        procedures=subject.folder,
        workers=workers,
    )
    learner = lesson.learner
    first = founder_count(learner)
    side_by_side = min(rollout.workers, learner.attempts)
    refuse_too_large(rollout.on(-(-rollout.workers // side_by_side)), first, learner.layouts, side_by_side)
    refuse_too_long(rollout, (first + learner.population * (lesson.generations - 1)) * learner.layouts)
    return rollout


def make_again(run: RunFolder, rollout: Rollout) -> None:
    """Make a run of a first genome twice; what is not the same again is in the rollout's `notes`."""
    seed = run.manifest.seed
    [genome] = rollout.draw(1, breeding_generator(seed, 0, 0))
    rollout.make_again(genome, int(layouts(seed, 0, 0, 1)[0]))


@contextmanager
def workers_of(
    run: RunFolder,
    subject: Subject,
    rollout: Rollout,
    where: Where | None,
    workers: int,
    say: Callable[[str], object],
    clock: Clock,
) -> Iterator[tuple[Scorer, RememberingExecutor | None]]:
    """The scorer of a run's genomes, and the executor of its attempts where there are several that go side by side.

    They `say` what they wait for, and are sent away in the end, whatever they do. What they cannot do is a WorkError,
    whose hint says how the run goes on.
    """
    lesson, policy = run.manifest.lesson, Policy(subject.graph, run.weights)
    cast = lesson.task, lesson.master, subject.folder, run.manifest.learners
    # Attempts of a lesson that ends with the first that passes go one by one here: the others would be for nothing.
    has_several, goes_on = lesson.learner.attempts > 1, rollout.workers > 1 and not lesson.needs
    scored = scorer_on(where, rollout, partial(assignment_of, policy, *cast), workers, say)
    try:
        with scored as scorer, ExitStack() as end:
            course = run.course(rollout.genome_length)
            stretches: AttemptExecutor
            if has_several and where and isinstance(scorer, JobScorer):
                stretches = StretchExecutor(course, scorer.jobs, rollout)
            elif has_several and goes_on and not where:
                stretches = threads = StretchThreads(course, rollout.workers, rollout.on, clock)
                end.callback(threads.close)
            else:
                yield scorer, None
                return
            kept = KeptSegments(run.folder, run.manifest.identity, course)
            end.callback(kept.save)
            yield rollout, RememberingExecutor(stretches, kept, clock)
    except WorkError as error:
        resume = f"what was saved is intact; to go on: {command_line('mindc', 'train', '--resume', run.folder)}"
        raise WorkError(str(error), "; ".join(filter(None, (error.hint, resume)))) from error


def teach(run: RunFolder, subject: Subject, workers: int, watch: Watch, where: Where | None = None) -> Result | None:
    """Go on with a run to its end, and put what it has taught into the lock; None where `watch` stopped it.

    A run that has ended before gives its result. Its attempts are done `where` it is said, else in so many threads; in
    environments with more than one worker in so many processes.
    """
    if (result := read_result(run.folder)) is not None:
        return result
    rollout = rollout_of(run, subject, workers)
    make_again(run, rollout)
    for note in rollout.notes:
        watch.warn(note)
    processes = workers if workers > 1 else 0  # what was registered in this one is not known in others
    with workers_of(run, subject, rollout, where, processes, watch.warn, watch.clock) as (scorer, executor):
        state = train(run, scorer, watch, executor)
        if not is_over(run.manifest.lesson, state):
            return None
        return finish(run, subject, state, scorer, False, workers, rollout.notes)[0]


def finish(
    run: RunFolder,
    subject: Subject,
    state: LessonState,
    scorer: Scorer,
    force: bool,
    workers: int,
    notes: Sequence[str],
) -> tuple[Result, Kept]:
    """Put what a run has taught into the lock, unless what is there does better; with `force` even then.

    The result has the `notes`, and more on what was learnt. MindError where nothing was, or the lock is damaged.
    """
    kept = keep(run, subject, state, scorer, force, workers)
    result = result_of(run, subject, state, kept)
    more = remarks(run, subject, state.kept[0]) if kept.is_new else []
    result["notes"] = [*notes, *more, *result["notes"]]
    keep_result(run.folder, result)
    return result, kept


def opening(run: RunFolder) -> str:
    """A sentence that says what is about to be taught."""
    lesson = run.manifest.lesson
    known = set(run.manifest.learners) <= set(run.weights)
    origin = f"the weights of {lesson.starts_from}" if lesson.starts_from else "its weights"
    start = "from scratch" if lesson.from_scratch or not known else f"from {origin}"
    where = f"on {lesson.task}" + (f" under {lesson.master}" if lesson.master != lesson.skill else "")
    who = f"{lesson.skill} with its subskills" if lesson.with_subskills else lesson.skill
    return f"{who} {where} {start}, seed {run.manifest.seed}, in {run.folder}"


def result_of(run: RunFolder, subject: Subject, state: LessonState, kept: Kept) -> Result:
    """A finished run as plain data; `weights` has the SHA-256 of what was learnt of each skill.

    `kept` says whether that is in the lock now. Where this had weights before, `compared` are their score and that of
    the new ones on common fresh layouts; `earlier` are lessons of which it has changed skills, before and after.
    `idle_ticks` came after the last gain; `notes` say so where they are many.
    """
    lesson, records = run.manifest.lesson, read_progress(run.folder)
    learnt = parts(subject.graph, run.manifest.learners, state.kept[0])
    return {
        "lesson": run.manifest.name,
        "curriculum": lesson.curriculum,
        "skill": lesson.skill,
        "task": lesson.task,
        "master": lesson.master,
        "generations": lesson.generations,
        "bred": state.generations,
        "population": lesson.learner.population,
        "attempts": state.attempt,
        "seed": run.manifest.seed,
        "best": state.best,
        "reevaluated": state.reevaluated,
        "ticks": state.ticks,
        "idle_ticks": idle_ticks(records),
        "seconds": round(state.seconds, 3),
        "ticks_per_second": round(state.ticks / max(state.seconds, 1e-9)),
        "faults": state.faults,
        "verdicts": [finite(verdict) for verdict in state.verdicts[:, 1]],
        "weights": {skill: digest(weights) for skill, weights in learnt.items()},
        "kept": kept.is_new,
        "compared": [finite(score) for score in (kept.comparison.old, kept.comparison.new)]
        if kept.comparison
        else None,
        "earlier": [
            {"lesson": each.lesson.name, "before": each.before, "after": finite(each.after)} for each in kept.earlier
        ],
        "run": str(run.folder),
        "notes": [*filter(None, [idle_note(records)])],
    }


def outcome(run: RunFolder, result: Result, kept: Kept, lock: str) -> list[str]:
    """Lines that say what was learnt, what is in the lock now, and where the new weights are if they are not there."""
    generations = "1 generation" if result["bred"] == 1 else f"{result['bred']} generations"
    if result["attempts"] > 1:
        generations += f" in {result['attempts']} attempts"
    lowest = run.manifest.lesson.learner.lowest
    where = "fresh layouts" if lowest == 1 else f"the lowest {100 * lowest:g}% of fresh layouts"
    learnt = (
        f"{result['skill']} has learnt: {short_score(result['reevaluated'])} on {where} after "
        f"{generations}, in {duration(result['seconds'])} at {speed(result)}"
    )
    if kept.is_new:
        worse = kept.comparison is not None and kept.comparison.is_worse
        return [
            f"{learnt}; weights in {lock}",
            *[f"but {kept.comparison}"] * worse,
            *(retention_table(kept.earlier) if kept.earlier else []),
        ]
    stay = f"{kept.comparison}, and stay in {lock}"
    return [learnt, stay, f"the new ones: {run.folder / WEIGHTS}; --force puts them there"]


def remarks(run: RunFolder, subject: Subject, genome: Genomes) -> list[str]:
    """A sentence for each master among the learners that lets a subskill never act, or never lets it go.

    And one for each promise that a learner breaks itself, in a few fresh runs of its lesson. None where a procedure
    beside them can only be run in the simulator.
    """
    lesson, learners, graph = run.manifest.lesson, run.manifest.learners, subject.graph
    learnt = {
        (index, edge.target)
        for index, skill in enumerate(graph.skills)
        for edge in skill.edges
        if skill.owner in learners and edge.to == "skill" and edge.output is not None
    }
    promising = {skill.name for skill in graph.skills if skill.promises and skill.owner in learners}
    if not learnt and not promising:
        return []
    policy = Policy(graph, {**run.weights, **parts(graph, learners, genome)})
    rollout = rollout_for(policy, lesson.task, lesson.master, procedures=subject.folder)
    seeds = verdict_layouts(run.manifest.seed, lesson.generations).tolist()
    found = list[str]()
    with suppress(ProcedureError):
        found += _held(_spans(rollout, subject, policy, lesson.master, seeds, learnt), subject) if learnt else []
    with suppress(ProcedureError):
        found += _broken(rollout, lesson.master, seeds, promising) if promising else []
    return found


def _held(spans: Spans, subject: Subject) -> list[str]:
    skills, held = subject.graph.skills, defaultdict[str, dict[str, list[str]]](lambda: defaultdict(list))
    for (master, subskill), (least, most) in spans.items():
        if most - least < ALIKE_INFLUENCE:
            does = "never influences {}" if most < ALIKE_INFLUENCE else f"always influences {{}} with {most:.2f}"
            held[skills[master].name][does].append(skills[subskill].name)
    return [
        f"{master} {listed([does.format(listed(names, 'and')) for does, names in of.items()], 'and')}, in "
        f"{LOOKED_RUNS} runs: more attempts may find one that decides; mindc prove says whether this one can"
        for master, of in held.items()
    ]


def _spans(
    rollout: Rollout, subject: Subject, policy: Policy, master: str, seeds: Sequence[int], learnt: Edges
) -> Spans:
    """The numbers that learners send to subskills by their weights, while they have influence, in a few fresh runs."""
    found: Spans = {}
    sources = procedure_sources(policy.graph, subject.folder, master)
    for seed in seeds[:LOOKED_RUNS]:
        ticks = joined(islice(trace(rollout, seed).chunks, MAX_CHUNKS))
        flows = edge_flows(policy, sources, master, ticks)
        flow = flows.flow_at(np.unique(np.linspace(0, len(ticks) - 1, MOMENTS_EACH).astype(np.int64)))
        value = np.where(flow.carried > 0, flow.value, 0.0)
        for place, link in enumerate(flows.links):
            between = link.source, link.target[1]
            sent: NDArray[np.float64] = value[flow.behind[:, place] > 0, place]
            if link.target[0] == "skill" and between in learnt and len(sent):
                least, most = found.get(between, (np.inf, -np.inf))
                found[between] = min(least, float(sent.min())), max(most, float(sent.max()))
    return found


def _broken(rollout: Rollout, master: str, seeds: Sequence[int], promising: set[str]) -> list[str]:
    return [
        f"{each['skill']} breaks its own promise in {each['broken_runs_by_skill']} of {each['runs']} runs, "
        f"{each['promise']}: let the task pay for it, or promise less"
        for each in promises_in(rollout, master, seeds[: 1 if rollout.is_one_world else None], FEW_TICKS)
        if each["skill"] in promising and each.get("broken_runs_by_skill")
    ]
