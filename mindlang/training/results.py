"""What came of a lesson, for its user and for other programs."""

from math import isfinite
from typing import Any

from mindrun.graph.weights import parts
from mindrun.train.lesson_state import LessonState
from mindrun.train.run_folder import WEIGHTS, RunFolder

from mindlang.lock.blobs import digest
from mindlang.number_format import duration, number, rate
from mindlang.training.lock_update import Kept
from mindlang.training.subject import Subject

Result = dict[str, Any]


def result_of(run: RunFolder, subject: Subject, state: LessonState, kept: Kept) -> Result:
    """A finished run as plain data; `weights` has the SHA-256 of what was learnt of each skill.

    `kept` says whether that is in the lock now. Where this had weights before, `compared` are their score and that of
    the new ones on common fresh layouts.
    """
    lesson = run.manifest.lesson
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
        "seconds": round(state.seconds, 3),
        "ticks_per_second": round(state.ticks / max(state.seconds, 1e-9)),
        "faults": state.faults,
        "verdicts": [_finite(verdict) for verdict in state.verdicts[:, 1]],
        "weights": {skill: digest(weights) for skill, weights in learnt.items()},
        "kept": kept.is_new,
        "compared": None if kept.comparison is None else [_finite(kept.comparison.old), _finite(kept.comparison.new)],
        "run": str(run.folder),
    }


def _finite(score: float) -> float | None:
    return float(score) if isfinite(score) else None


def opening(run: RunFolder) -> str:
    """What is about to be taught, in a sentence."""
    lesson = run.manifest.lesson
    known = set(run.manifest.learners) <= set(run.weights)
    origin = f"the weights of {lesson.starts_from}" if lesson.starts_from else "its weights"
    start = "from scratch" if lesson.from_scratch or not known else f"from {origin}"
    where = f"on {lesson.task}" + (f" under {lesson.master}" if lesson.master != lesson.skill else "")
    who = f"{lesson.skill} with its subskills" if lesson.with_subskills else lesson.skill
    return f"{who} {where} {start}, seed {run.manifest.seed}, in {run.folder}"


def closing(result: Result) -> str:
    """What was learnt, in a sentence."""
    generations = "1 generation" if result["bred"] == 1 else f"{result['bred']} generations"
    if result["attempts"] > 1:
        generations += f" in {result['attempts']} attempts"
    cpu = result.get("ticks_per_cpu_second")
    speed = rate(result["ticks_per_second"]) if cpu is None else rate(cpu, "CPU second")
    return (
        f"{result['skill']} has learnt: {number(result['reevaluated'])} on fresh layouts after "
        f"{generations}, in {duration(result['seconds'])} at {speed}"
    )


def outcome(run: RunFolder, result: Result, kept: Kept, lock: str) -> list[str]:
    """What was learnt, what is in the lock now, and where the new weights are if they are not there."""
    learnt = closing(result)
    if kept.is_new:
        worse = kept.comparison is not None and kept.comparison.is_worse
        return [f"{learnt}; weights in {lock}", *[f"but {kept.comparison}"] * worse]
    stay = f"{kept.comparison}, and stay in {lock}"
    return [learnt, stay, f"the new ones: {run.folder / WEIGHTS}; --force puts them there"]
