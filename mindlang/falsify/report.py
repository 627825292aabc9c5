"""The outcome of a search for failures: as plain data, as text to read, and as a file of hard layouts."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from rich.console import Group, RenderableType
from rich.text import Text

from mindlang.falsify.failures import Rate
from mindlang.falsify.numbers import Number
from mindlang.falsify.region import Box
from mindlang.falsify.search import Found
from mindlang.number_format import finite, score
from mindlang.run.outcome import TIME, ended_by
from mindlang.run.summary import Row, aligned, shortened

WORST_RUNS = 10  # that are told
MAX_HARD_SEEDS = 1000  # of a file
ENOUGH_HARD_SEEDS = 100  # of a file, below which there are some of the search in it
DRAWN_COLUMNS = 30  # for the numbers of a run, and for their names above them


def found_data(found: Found, seed: int) -> dict[str, Any]:
    """The failures on any layouts, by what ended them, the worst runs of all, and the region that fails most."""
    criterion, every = found.criterion, found.runs
    failed = criterion.failed(every.scores)
    region = found.region and {
        "numbers": region_words(found.numbers, found.region.box),
        **rate_data(found.region.rate),
        "share_of_layouts": found.region.share,
    }
    return {
        "fails": criterion.words,
        **rate_data(found.rate),
        "searched": int(sum(len(each.places) for each in (*found.rounds, *found.checked))),
        "searched_failures": int(failed.sum()) - found.rate.failures,
        "first_failure": int(np.argmax(failed)) + 1 if failed.any() else None,
        "by_end": criterion.causes(found.uniform.scores) or criterion.causes(every.scores),
        "worst": [_run(found, place, seed) for place in hard_runs(found)[:WORST_RUNS]],
        "numbers": [each.within(each.low, each.high) for each in found.numbers],
        "region": region,
    }


def rate_data(rate: Rate) -> dict[str, Any]:
    return {"runs": rate.runs, "failures": rate.failures, "rate": rate.share, "low": rate.low, "high": rate.high}


def region_words(numbers: Sequence[Number], box: Box) -> list[str]:
    """The numbers that a box bounds more than the task does, each as `friction 0.1 to 0.3`."""
    ends = zip(numbers, box.low.tolist(), box.high.tolist(), strict=True)
    return [each.within(low, high) for each, low, high in ends if low > each.low or high < each.high]


def hard_runs(found: Found) -> list[int]:
    """The runs that failed on any layouts, the worst first; behind them those of the search, till there are enough."""
    scores, uniform = found.runs.scores, len(found.uniform.places)
    order = found.criterion.worst_first(scores)[: int(found.criterion.failed(scores).sum())]
    own = order[order < uniform][:MAX_HARD_SEEDS].tolist()
    return [*own, *order[order >= uniform][: max(0, ENOUGH_HARD_SEEDS - len(own))].tolist()]


def _run(found: Found, place: int, seed: int) -> dict[str, Any]:
    every, task = found.runs, found.criterion.task
    scores = every.scores
    drawn = zip(found.numbers, every.drawn[place].tolist(), strict=True)
    return {
        "layout": f"{seed}/{every.places[place]}",
        "seed": int(every.seeds[place]),
        "score": finite(scores.total[0, place]),
        "counts": int(scores.counts[0, place]) if task.counts else None,
        "ticks": int(scores.ticks[0, place]),
        "ended_by": ended_by(task, int(scores.ended_by[0, place])),
        "drawn": {each.name: each.value(value) for each, value in drawn},
    }


def hard_text(found: Found, command: str) -> str:
    """A file of hard layouts: a seed a line, the worst first, below what they are and which command found them."""
    every, task = found.runs, found.criterion.task
    seeds = [int(every.seeds[place]) for place in hard_runs(found)]
    head = [
        f"layouts of {task.name} on which a run {found.criterion.words}, the worst first",
        command,
        "a seed a line: for mindc run --seed, and for a lesson with hard 25% of this file",
    ]
    return "".join([*(f"# {line}\n" for line in head), *(f"{seed}\n" for seed in seeds)])


def found_summary(data: dict[str, Any]) -> RenderableType:
    """The failures in numbers, the worst runs in a table, the region in words."""
    share = f"{data['failures']:,} of {data['runs']:,} runs, {_percent(data)}"
    more = f"{data['searched_failures']:,} of {data['searched']:,} where numbers are as in the worst"
    facts: list[Row] = [
        ("fails", f"a run that {data['fails']}"),
        ("failed", Text.assemble((share, "bold"))),
        *([("searched", more)] if data["searched"] else []),
        *([("ended by", ", ".join(f"{name} {times:,}" for name, times in _ends(data)))] if data["by_end"] else []),
        *_region(data),
    ]
    parts: list[RenderableType] = [Text(f"{data['task']} under {data['master']}", "bold"), aligned(facts, (0, 1))]
    if data["worst"]:
        names = shortened(", ".join(data["worst"][0]["drawn"]), DRAWN_COLUMNS)
        parts += ["", aligned(map(_row, data["worst"]), (0, 3, 4), ("worst", "score", "ticks", "ended by", names))]
        parts.append(Text(f"{data['repeat']} SEED repeats one", "dim"))
    return Group(*parts)


def _percent(data: dict[str, Any]) -> str:
    return f"{data['rate']:.2%} ({data['low']:.2%} to {data['high']:.2%} with 95 % confidence)"


def _ends(data: dict[str, Any]) -> list[tuple[str, int]]:
    return [("their time" if name == TIME else name, times) for name, times in data["by_end"].items()]


def _region(data: dict[str, Any]) -> list[tuple[str, str]]:
    if not data["numbers"]:
        return []
    region = data["region"]
    if region is None:
        return [("region", "none found that fails at least twice as often as all layouts")]
    rate = f"{region['share_of_layouts']:.2%} of all layouts; of {region['runs']:,} fresh runs in it fail"
    rows = [("" if place else "region", words) for place, words in enumerate(region["numbers"])]
    return [*rows, ("", rate), ("", _percent(region))]


def _row(run: dict[str, Any]) -> list[str | Text]:
    ended, drawn = run["ended_by"] or "its time", shortened(", ".join(run["drawn"].values()), DRAWN_COLUMNS)
    return [run["layout"], score(run["score"]), f"{run['ticks']:,}", ended, drawn]
