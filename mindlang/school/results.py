"""What came of a lesson, for its user and for other programs."""

from typing import Any

from mindrun.train.lesson import State
from mindrun.train.run_folder import Run

from mindlang.figures import duration, number, rate

Result = dict[str, Any]


def result_of(run: Run, state: State, weights: str) -> Result:
    """A finished run as plain data; `weights` is the SHA-256 of what was learnt."""
    lesson = run.manifest.lesson
    return {
        "lesson": run.manifest.name,
        "curriculum": lesson.curriculum,
        "skill": lesson.skill,
        "task": lesson.task,
        "master": lesson.master,
        "generations": lesson.generations,
        "population": lesson.learner.population,
        "attempts": lesson.learner.attempts,
        "seed": run.manifest.seed,
        "best": state.best,
        "reevaluated": state.reevaluated,
        "ticks": state.ticks,
        "seconds": round(state.seconds, 3),
        "ticks_per_second": round(state.ticks / max(state.seconds, 1e-9)),
        "faults": state.faults,
        "weights": weights,
        "run": str(run.folder),
    }


def opening(run: Run) -> str:
    """What is about to be taught, in a sentence."""
    lesson = run.manifest.lesson
    start = "from its weights" if lesson.skill in run.weights else "from scratch"
    where = f"on {lesson.task}" + (f" under {lesson.master}" if lesson.master != lesson.skill else "")
    return f"{lesson.skill} {where} {start}, seed {run.manifest.seed}, in {run.folder}"


def closing(result: Result) -> str:
    """What was learnt, in a sentence."""
    generations = "1 generation" if result["generations"] == 1 else f"{result['generations']} generations"
    return (
        f"{result['skill']} has learnt: {number(result['reevaluated'])} on fresh layouts after "
        f"{generations}, in {duration(result['seconds'])} at {rate(result['ticks_per_second'])}"
    )
