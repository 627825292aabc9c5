"""The outcome of one run, and of many, as plain data: the contents of `--json`."""

from collections import Counter
from collections.abc import Sequence
from math import sqrt
from typing import Any

import numpy as np
from mindrun.graph.draws import drawn_in_words, drawn_numbers
from mindrun.graph.graph import Task
from mindrun.graph.run_scores import Scores, paid_by_text, score_of
from mindrun.graph.tasks import robots_in
from mindrun.kinds.registry import phrase
from mindrun.sim.codes import BROKEN_OFF, GOING_ON, LOST
from mindrun.train.scoring import succeeded
from numpy.typing import NDArray

from mindlang.compiler.resolve.goals import GOAL_POINTS, PREFERENCE_POINTS
from mindlang.number_format import finite
from mindlang.run.paired_difference import unseen_share

TIME = "time"
PREFERS = "prefers"
GOAL_WORDS = ("wants", "avoids", "keeps", "then", PREFERS)  # with which the line of a goal begins
LEAST_SHARE = 1 - 1e-9  # of a goal that is met, for rounding
NOTHING = np.zeros(0)
OTHERWISE = {LOST: "flight out of bounds", BROKEN_OFF: "its environment"}  # beyond 1e9 units, or nowhere; truncated


def events(task: Task) -> list[str]:
    return [phrase(event) for event in task.events]


def ends(task: Task) -> list[str]:
    """The ends of a task as they are written."""
    return [
        end.text if end.event is None else f"{end.times} " * (end.times > 1) + phrase(task.events[end.event])
        for end in task.ends
    ]


def ended_by(task: Task, number: int) -> str | None:
    """The end that came, by its number there; None where a run lasted its time, or goes on."""
    return ends(task)[number] if 0 <= number < len(task.ends) else OTHERWISE.get(number)


def met_goals(task: Task, scores: Scores) -> list[dict[str, Any]]:
    """How much of each goal of a task was met in the runs of one genome, 0 to 1, and in what share of them all of it.

    Of what the task prefers, how much in the mean alone. Nothing where it has no goals.
    """
    lines = {reward.text: i for i, reward in enumerate(task.rewards) if reward.text.partition(" ")[0] in GOAL_WORDS}
    preferred = [text for text in lines if text.startswith(PREFERS)]
    found = []
    for text, i in lines.items():
        points = (
            PREFERENCE_POINTS / len(preferred) if text in preferred else GOAL_POINTS / (len(lines) - len(preferred))
        )
        share = scores.by_line[0, :, i] / points
        met = None if text in preferred else float((share > LEAST_SHARE).mean())
        found.append({"goal": text, **spread("", share), "met": met})
    return found


def over_at_once(task: Task, scores: Scores) -> list[str]:
    """A note where runs of one genome were over in their first tick: what ends them is so where they begin."""
    ended = scores.ended_by[0][(scores.ticks[0] == 1) & (task.ticks > 1)]
    by = Counter(ended[(ended >= 0) & (ended < len(task.ends))].tolist())
    runs = scores.ticks.shape[1]
    return [
        f"{times:,} of {runs:,} runs {'was' if times == 1 else 'were'} over in the first tick, by "
        f"{ended_by(task, number)}: nothing has decided {'it' if times == 1 else 'them'} but where they begin"
        for number, times in by.most_common()
    ]


def run_data(task: Task, scores: Scores) -> dict[str, Any]:
    """The single run of `scores`, as `data_so_far` has it, and whether it succeeded, where that can be."""
    ended = ended_by(task, int(scores.ended_by[0, 0]))
    return {
        **data_so_far(task, scores.by_line[0, 0], scores.by_event[0, 0], int(scores.ticks[0, 0]), ended),
        **({"succeeded": bool(succeeded(task, scores)[0, 0])} if task.can_succeed else {}),
        "faults": int(scores.faults[0, 0]),
    }


def data_so_far(
    task: Task, paid: NDArray[np.float64], times: NDArray[np.integer], ticks: int, ended: str | None
) -> dict[str, Any]:
    """The outcome of a run by a tick, by what each line has paid [rewards] and how often each event happened [events].

    A sum that is not a finite number is None, `counts` the sum of `by_event` if any.
    """
    counted = [events(task)[event] for event in task.counts]
    counts = [int(times[event]) for event in task.counts]
    return {
        **rewards_data(task, paid),
        "counts": sum(counts) if counts else None,
        "counted": counted,
        "by_event": dict(zip(counted, counts, strict=True)),
        "ticks": ticks,
        "of_ticks": task.ticks,
        "ended_by": ended,
    }


def rewards_data(task: Task, paid: NDArray[np.float64]) -> dict[str, Any]:
    by_line = paid_by_text(task.rewards, paid)
    return {"score": finite(score_of(paid)), "by_line": {text: finite(value) for text, value in by_line.items()}}


def run_names(task: Task, master: str, seed: int, robot: int = 0) -> dict[str, Any]:
    """The task, the master and the seed of a run, the robot that is watched where there are several, what is drawn."""
    watched = {"robot": robot} if robots_in(task) > 1 else {}
    drawn = {"drawn": dict(drawn_numbers(task.draws, seed))} if task.draws else {}
    return {"task": task.name, "master": master, "seed": seed, **watched, **drawn}


def seed_words(found: dict[str, Any]) -> str:
    """The words `seed 3, robot 2, side 1` of a run with these `run_names`."""
    return f"seed {found['seed']}{robot_words(found)}{drawn_in_words(found.get('drawn', {}))}"


def robot_words(found: dict[str, Any]) -> str:
    """The words `, robot 2` of a run in whose world are several; empty for any other."""
    return f", robot {found['robot']}" if "robot" in found else ""


def bench_data(
    task: Task, scores: Scores, seeds: Sequence[int], seconds: float, cpu_seconds: float | None = None
) -> dict[str, Any]:
    """All runs of one genome; the best and the worst run are named by their number, from 1 on, and seed;
    None where no run has a score that is a finite number.

    A `std` is that of the sample, how far single runs are apart; a `standard_error` how far the mean may be off. One
    run knows neither, and where nothing is counted there is no count: None. Of the `cpu_seconds` of all processors
    nobody may know.
    """
    totals, ticks = scores.total[0], int(scores.ticks.sum())
    scored = np.flatnonzero(np.isfinite(totals))
    found = [int(scored[place(totals[scored])]) for place in (np.argmax, np.argmin)] if len(scored) else [None, None]
    named = dict(zip(("best", "worst"), found, strict=True))
    happened, ended = events(task), Counter(scores.ended_by[0].tolist())
    numbers = [*range(len(task.ends)), *OTHERWISE, GOING_ON]
    return {
        "runs": len(seeds),
        **spread("count_", scores.counts[0] if task.counts else NOTHING),
        "counted": [happened[event] for event in task.counts],
        "by_event": {happened[event]: spread("", scores.by_event[0, :, event]) for event in task.counts},
        **({"success": _success(succeeded(task, scores)[0].astype(float))} if task.can_succeed else {}),
        **({"goals": goals} if (goals := met_goals(task, scores)) else {}),
        "runtime_mean": float(scores.ticks[0].mean() / task.ticks),
        "ended": {ended_by(task, number) or TIME: ended[number] for number in numbers if ended[number]},
        **spread("score_", totals),
        **{f"{name}_run": None if run is None else run + 1 for name, run in named.items()},
        **{f"{name}_seed": None if run is None else int(seeds[run]) for name, run in named.items()},
        **{
            f"{name}_drawn": None if run is None else dict(drawn_numbers(task.draws, seeds[run]))
            for name, run in named.items()
            if task.draws
        },
        "faults": int(scores.faults.sum()),
        "ticks": ticks,
        "seconds": round(seconds, 3),
        "ticks_per_second": round(ticks / max(seconds, 1e-9)),
        "cpu_seconds": None if cpu_seconds is None else round(cpu_seconds, 3),
        "ticks_per_cpu_second": None if cpu_seconds is None else round(ticks / max(cpu_seconds, 1e-3)),
    }


def _success(runs: NDArray[np.float64]) -> dict[str, float | None]:
    """The share of runs that succeeded; where it is all or none, also of how many of all layouts that may be true.

    `at_least` and `at_most` are that share with 95 % confidence, None where a standard error says how far it may be
    off, or one run knows neither.
    """
    share, unseen = spread("", runs), unseen_share(len(runs))
    is_all_or_none = share["standard_error"] == 0
    low, high = (1 - unseen, 1.0) if share["mean"] else (0.0, unseen)
    return {**share, "at_least": low if is_all_or_none else None, "at_most": high if is_all_or_none else None}


def spread(of: str, values: NDArray[Any]) -> dict[str, float | None]:
    """The mean of values, their standard deviation and the standard error of the mean, named so; None where unknown."""
    deviation = float(values.std(ddof=1)) if len(values) > 1 and np.isfinite(values).all() else None
    error = None if deviation is None else deviation / sqrt(len(values))
    mean = finite(values.mean()) if len(values) else None
    return {f"{of}mean": mean, f"{of}std": deviation, f"{of}standard_error": error}
