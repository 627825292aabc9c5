"""The lives of agents as numbers, as a table for a terminal, and as tables of a page."""

import re
from collections.abc import Mapping, Sequence
from math import isfinite
from typing import Any

import numpy as np

from benchmarks.lifelong import metrics
from benchmarks.lifelong.agents import DONE_COUNTS, TASKS

Record = dict[str, Any]  # what came of a lesson
BASELINE = "one per task"
MEASURES = ("performance", "forgetting", "backward", "forward")
REACHED_SHARE = 0.9  # of the reference, from which a task is called learnt
SHORT = ("GTO", "GTDZ", "Avoid", "GTO+A", "GTDZ+A", "Collect", "GTP+A", "CWP")
BEGIN, END = "<!-- by benchmarks.lifelong -->", "<!-- end of what is by benchmarks.lifelong -->"


def numbers(records: Sequence[Record], lessons: int, setup: Mapping[str, Any]) -> dict[str, Any]:
    """All figures: of each agent one number a seed or, by task, their means; None where there is none.

    Lives that have not come to the last of the lessons are left out.
    """
    lives: dict[str, dict[int, list[Record]]] = {}
    for record in records:
        if record["lesson"] <= lessons:
            lives.setdefault(record["agent"], {}).setdefault(record["seed"], []).append(record)
    whole = {name: [life for life in of.values() if len(life) == lessons] for name, of in lives.items()}
    whole = {name: of for name, of in whole.items() if of}
    reference, scratch = _reference(whole.get(BASELINE, []), lessons, setup["ticks"])
    agents = {name: _agent(of, reference, scratch, setup["ticks"]) for name, of in whole.items()}
    found: dict[str, Any] = _plain({"setup": setup, "lessons": lessons, "reference": reference, "agents": agents})
    return found


def _reference(baseline: Sequence[list[Record]], lessons: int, ticks: float) -> tuple[metrics.Matrix, metrics.Matrix]:
    """What a network taught one task alone counts there, at least what is called done; and the areas of its curves."""
    done = np.array(DONE_COUNTS)
    if not baseline:
        return done, np.full(lessons, np.nan)
    alone = np.array([[record["counts"][record["lesson"] - 1] for record in life] for life in baseline]).mean(axis=0)
    reference = np.concatenate([np.maximum(done[:lessons], alone), done[lessons:]])
    return reference, np.mean([_areas(life, reference, ticks) for life in baseline], axis=0)


def _areas(life: Sequence[Record], reference: metrics.Matrix, ticks: float) -> metrics.Matrix:
    return np.array([metrics.area(record["curve"], reference[i], ticks) for i, record in enumerate(life)])


def _agent(lives: Sequence[list[Record]], reference: metrics.Matrix, scratch: metrics.Matrix, ticks: float) -> Any:
    """The figures of an agent, whose lives have a record for each lesson."""
    counts = np.array([[record["counts"] for record in life] for life in lives], float)
    shares = [metrics.performance(each, reference) for each in counts]
    forward = np.array([metrics.forward_transfer(_areas(life, reference, ticks), scratch) for life in lives])
    needed = REACHED_SHARE * reference
    reached = np.array(
        [[metrics.ticks_to(record["curve"], needed[i]) for i, record in enumerate(life)] for life in lives]
    )
    return {
        "seeds": [life[0]["seed"] for life in lives],
        "performance": [metrics.average_performance(p) for p in shares],
        "forgetting": [metrics.forgetting(p).mean() for p in shares],
        "backward": [metrics.backward_transfer(p) for p in shares],
        "forward": forward.mean(axis=1),
        "unchanged": [_unchanged(life) for life in lives],
        "learnt": np.isfinite(reached).mean(axis=1),
        "weights": [life[-1]["weights"] for life in lives],
        "ticks": [sum(record["ticks"] for record in life) for life in lives],
        "seconds": [sum(record["seconds"] + record["seconds_played"] for record in life) for life in lives],
        "counts_by_task": counts.mean(axis=0),
        "performance_by_task": np.mean(shares, axis=0),
        "forgetting_by_task": np.mean([metrics.forgetting(p) for p in shares], axis=0),
        "isolated_forgetting": np.mean([metrics.isolated_forgetting(p) for p in shares], axis=0),
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


def table(found: Mapping[str, Any]) -> str:
    """The figures for a terminal: a line for each agent, and what each task counted after its lesson and in the end."""
    rows = [("agent", *MEASURES, "learnt", "weights"), *map(_line, found["agents"].items())]
    tasks = SHORT[: found["lessons"]]
    then = [("count after it → in the end", *tasks), *map(_changes, found["agents"].items())]
    return f"{_aligned(rows)}\n\n{_aligned(then)}"


def _aligned(rows: Sequence[Sequence[str]]) -> str:
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    return "\n".join(
        "  ".join([row[0].ljust(widths[0]), *(cell.rjust(w) for cell, w in zip(row[1:], widths[1:], strict=True))])
        for row in rows
    )


def _line(agent: tuple[str, Any]) -> tuple[str, ...]:
    name, of = agent
    return (
        name,
        *(_mean(of[measure]) for measure in MEASURES),
        _mean(of["learnt"], "{:.0%}", False),
        f"{np.mean(of['weights']):,.0f}",
    )


def _mean(values: Sequence[float | None], form: str = "{:.2f}", has_error: bool = True) -> str:
    """The mean of one number a seed, with its standard error; a dash where there are none."""
    there = [value for value in values if value is not None]
    if not there:
        return "–"
    mean = form.format(float(np.mean(there)) + 0.0)
    error = np.std(there, ddof=1) / len(there) ** 0.5 if len(there) > 1 and has_error else None
    return mean if error is None else f"{mean} ± {form.format(error)}"


def _changes(agent: tuple[str, Any]) -> tuple[str, ...]:
    name, counts = agent[0], agent[1]["counts_by_task"]
    return name, *(f"{_short(counts[i][i])} → {_short(counts[-1][i])}" for i in range(len(counts)))


def _short(count: float) -> str:
    return f"{count:.1f}" if count < 99.95 else f"{count:.0f}"


def page(text: str, found: Mapping[str, Any], picture: str = "") -> str:
    """The text of a page with the tables of these figures between its marks, and a picture by its path from there."""
    setup = found["setup"]
    rows: list[tuple[str, ...]] = [("agent", *MEASURES, "learnt", "unchanged", "weights")]
    for name, of in found["agents"].items():
        *most, weights = _line((name, of))
        rows.append((*most, _mean(of["unchanged"], "{:.1f}", False), weights))
    tasks = [("agent", *TASKS[: found["lessons"]]), *map(_changes, found["agents"].items())]
    seeds = max(len(of["seeds"]) for of in found["agents"].values())
    said = (
        f"{seeds} seeds, {setup['ticks'] / 1e6:g} M ticks a lesson, {setup['layouts']} fresh layouts for each task "
        "after each lesson; ± the standard error over the seeds."
    )
    counted = "What each task counts in a run after its own lesson → after the last one, on the mean over the seeds:"
    pictures = [f"![What each agent can do after each lesson]({picture})"] * bool(picture)
    block = "\n\n".join([BEGIN, said, *pictures, _markdown(rows), counted, _markdown(tasks), END])
    return re.sub(f"{BEGIN}.*{END}", lambda _: block, text, flags=re.DOTALL)


def _markdown(rows: Sequence[Sequence[str]]) -> str:
    head, *body = ("| " + " | ".join(row) + " |" for row in rows)
    return "\n".join([head, "|---" * len(rows[0]) + "|", *body])
