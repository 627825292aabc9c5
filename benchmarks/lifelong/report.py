"""The lives of agents as numbers, and as tables of a page."""

import re
from collections.abc import Mapping, Sequence
from math import isfinite
from typing import Any

import numpy as np

from benchmarks.lifelong import metrics
from benchmarks.lifelong.sequence import TaskSequence
from benchmarks.lifelong.written import DIGITS

Record = dict[str, Any]  # what came of a lesson
BASELINE = "one per task"
MEASURES = ("performance", "forgetting", "backward", "forward")
REACHED_SHARE = 0.9  # of the reference, from which a task is called learnt
GROUPED_LESSONS = 20  # from which on tasks are not shown one by one
BEGIN, END = "<!-- by benchmarks.lifelong{} -->", "<!-- end of what is by benchmarks.lifelong{} -->"


def numbers(records: Sequence[Record], of: TaskSequence, lessons: int, setup: Mapping[str, Any]) -> dict[str, Any]:
    """All figures: of each agent one number a seed or, by task, their means; None where there is none.

    Lives that have not come to the last of the lessons are left out.
    """
    lives: dict[str, dict[int, list[Record]]] = {}
    for record in records:
        if record["lesson"] <= lessons:
            lives.setdefault(record["agent"], {}).setdefault(record["seed"], []).append(record)
    whole = {name: [life for life in of.values() if len(life) == lessons] for name, of in lives.items()}
    whole = {name: of for name, of in whole.items() if of}
    reference = np.array(of.done)
    for agent in [*whole] if of.is_best_of_all else [BASELINE] * (BASELINE in whole):
        own = np.array([[record["counts"][record["lesson"] - 1] for record in life] for life in whole[agent]])
        reference[:lessons] = np.maximum(reference[:lessons], own.mean(axis=0))
    alone = [_areas(life, reference, setup["ticks"]) for life in whole.get(BASELINE, [])]
    scratch = np.mean(alone, axis=0) if alone else np.full(lessons, np.nan)
    agents = {name: _agent(of, reference, scratch, setup["ticks"]) for name, of in whole.items()}
    found: dict[str, Any] = _plain({"setup": setup, "lessons": lessons, "reference": reference, "agents": agents})
    return found


def _areas(life: Sequence[Record], reference: metrics.Matrix, ticks: float) -> metrics.Matrix:
    return np.array([metrics.area(record["curve"], reference[i], ticks) for i, record in enumerate(life)])


def _agent(lives: Sequence[list[Record]], reference: metrics.Matrix, scratch: metrics.Matrix, ticks: float) -> Any:
    """The figures of an agent, whose lives have a record for each lesson."""
    counts = np.array([[record["counts"] for record in life] for life in lives], float)
    shares = [metrics.performance(each, reference) for each in counts]
    forward = np.array([metrics.forward_transfer(_areas(life, reference, ticks), scratch) for life in lives])
    learnt = REACHED_SHARE * reference
    reached = [[metrics.ticks_to(record["curve"], learnt[i]) for i, record in enumerate(life)] for life in lives]
    p, lost = np.mean(shares, axis=0), [metrics.forgetting(each) for each in shares]
    looked = [lesson for lesson in range(len(p)) if not np.isnan(p[lesson, : lesson + 1]).any()]
    return {
        "seeds": [life[0]["seed"] for life in lives],
        "performance": [metrics.average_performance(each) for each in shares],
        "forgetting": [each.mean() for each in lost],
        "backward": [metrics.backward_transfer(each) for each in shares],
        "forward": forward.mean(axis=1),
        "unchanged": [_unchanged(life) for life in lives],
        "learnt": np.isfinite(reached).mean(axis=1),
        "weights": [life[-1]["weights"] for life in lives],
        "ticks": [sum(record["ticks"] for record in life) for life in lives],
        "seconds": [sum(record["seconds"] + record["seconds_played"] for record in life) for life in lives],
        "after_lessons": [lesson + 1 for lesson in looked],
        "counts_after": counts.mean(axis=0)[looked],
        "performance_after": p[looked],
        "own_counts_by_task": np.diagonal(counts.mean(axis=0)),
        "own_performance_by_task": np.diagonal(p),
        "performance_by_task": p[-1, : len(p)],
        "forgetting_by_task": np.mean(lost, axis=0),
        "forward_by_task": forward.mean(axis=0),
        "ticks_to_learnt_by_task": np.median(reached, axis=0),
    }


def _unchanged(life: Sequence[Record]) -> int:
    """How many earlier tasks have the very score, to the last bit, after the last lesson that they had after theirs."""
    return sum(record["scores"][i] == life[-1]["scores"][i] for i, record in enumerate(life[:-1]))


def _plain(value: Any) -> Any:
    """Numbers and lists as JSON has them, rounded to what they mean; None for what is not finite."""
    match value:
        case Mapping():
            return {key: _plain(each) for key, each in value.items()}
        case np.ndarray() | list() | tuple():
            return [_plain(each) for each in value]
        case float() | np.floating():
            return round(float(value), 6) if isfinite(value) else None
        case np.integer():
            return int(value)
    return value


def tables(found: Mapping[str, Any]) -> tuple[str, str]:
    """A line for each agent with its figures; and what it can do after its lessons, and in the end."""
    rows: list[tuple[str, ...]] = [("agent", *MEASURES, "learnt", "unchanged", "weights")]
    for name, of in found["agents"].items():
        measured = (_mean(of[measure], of.get(f"{measure}_by_task")) for measure in MEASURES)
        learnt, unchanged, weights = (float(np.mean(of[each])) for each in ("learnt", "unchanged", "weights"))
        rows.append((name, *measured, f"{learnt:.0%}", f"{unchanged:.1f}", f"{weights:,.0f}"))
    groups = _groups(found)
    then = [("agent", *groups)]
    for name, of in found["agents"].items():
        last, own = of["counts_after"][-1], of["own_counts_by_task"]
        if len(groups) < found["lessons"]:
            last, own = of["performance_by_task"], of["own_performance_by_task"]
        then.append((name, *(f"{_short(own, tasks)} → {_short(last, tasks)}" for tasks in groups.values())))
    return _markdown(rows), _markdown(then)


def _groups(found: Mapping[str, Any]) -> dict[str, list[int]]:
    """The tasks by their names; where they are many, by the numbers of their lessons, and by their verbs."""
    lessons, names = found["lessons"], found["setup"]["tasks"]
    if lessons <= GROUPED_LESSONS:
        return {names[i]: [i] for i in range(lessons)}
    verbs = [name.rstrip(DIGITS) for name in names[:lessons]]
    parts = [[*range(first, min(first + GROUPED_LESSONS, lessons))] for first in range(0, lessons, GROUPED_LESSONS)]
    of_verbs = {verb: [i for i, each in enumerate(verbs) if each == verb] for verb in sorted({*verbs})}
    return {f"{part[0] + 1} to {part[-1] + 1}": part for part in parts} | of_verbs


def _mean(values: Sequence[float | None], by_task: Sequence[float] | None) -> str:
    """The mean of one number a seed with its standard error, over the tasks where there is one seed; a dash of none."""
    there = [value for value in values if value is not None]
    if not there:
        return "–"
    spread = there if len(there) > 1 else by_task or ()
    error = f" ± {np.std(spread, ddof=1) / len(spread) ** 0.5:.2f}" if len(spread) > 1 else ""
    return f"{round(float(np.mean(there)), 2) + 0.0:.2f}{error}"


def _short(values: Sequence[float], tasks: Sequence[int]) -> str:
    mean = float(np.mean([values[task] for task in tasks]))
    return f"{mean:.2f}" if len(tasks) > 1 else f"{mean:.1f}" if mean < 99.95 else f"{mean:.0f}"


def _markdown(rows: Sequence[Sequence[str]]) -> str:
    head, *body = ("| " + " | ".join(row) + " |" for row in rows)
    return "\n".join([head, "|---" * len(rows[0]) + "|", *body])


def page(text: str, found: Mapping[str, Any], of: str = "", picture: str = "") -> str:
    """The text of a page with these figures between the marks of a sequence, and a picture by its path from there."""
    setup, (first, second) = found["setup"], tables(found)
    seeds = max(len(of["seeds"]) for of in found["agents"].values())
    over, many = ("seeds", f"{seeds} seeds") if seeds > 1 else ("tasks", "1 seed")
    said = (
        f"{many}, {setup['ticks'] / 1e6:g} M ticks a lesson, {setup['layouts']} fresh layouts for each task whenever "
        f"it is tried; ± the standard error over the {over}."
    )
    is_grouped = found["lessons"] > GROUPED_LESSONS
    shown = "p of the tasks, by their lessons and their verbs," if is_grouped else "What each task counts in a run"
    shown += " after its own lesson → after the last one, on the mean:"
    pictures = [f"![What each agent can do after each lesson]({picture})"] * bool(picture)
    begin, end = BEGIN.format(of), END.format(of)
    block = "\n\n".join([begin, said, *pictures, first, shown, second, end])
    return re.sub(f"{begin}.*{end}", lambda _: block, text, flags=re.DOTALL)
