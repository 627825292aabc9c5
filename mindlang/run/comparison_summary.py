"""Two minds on the same layouts, for reading."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from rich.console import Group, RenderableType
from rich.text import Text

from mindlang.number_format import score
from mindlang.run.bench_comparison import Comparison
from mindlang.run.conclusion import PERCENT, SCORE, SUCCESS, amount
from mindlang.run.paired_difference import MAX_RUNS, Difference

Row = tuple[str, ...]


def comparison_summary(found: dict[str, Any], comparison: Comparison) -> RenderableType:
    """Both means of each figure, their difference with its interval, how often which did better, and what that says."""
    runs, seed = found["runs"], found["seed"]
    where = (
        " in its one world"
        if comparison.is_one_world
        else f" on the same layouts, {runs:,} run{'s' * (runs != 1)} from seed {seed}"
    )
    title = Text.assemble((found["task"], "bold"), where)
    minds = [
        Text(f"  {place}  {each['file']} with {each['master']} in charge")
        for place, each in zip("AB", found["minds"], strict=True)
    ]
    ours, theirs = comparison.first.figures(), comparison.second.figures()
    head = ("", "A", "B", "B − A", f"{PERCENT} confidence")
    rows = [
        (name, _mean(name, ours[name].mean()), _mean(name, theirs[name].mean()), *_difference(name, each))
        for name, each in comparison.differences.items()
    ]
    told = () if comparison.is_one_world else [*comparison.differences.items()][:1]
    facts = [Text(line, "dim") for each in told for line in _facts(*each)]
    columns = len(head) - comparison.is_one_world  # of one run nothing is inferred
    return Group(
        title,
        *minds,
        "",
        *_aligned([row[:columns] for row in (head, *rows)]),
        "",
        *facts,
        Text(comparison.conclusion, "bold"),
    )


def _mean(name: str, value: float) -> str:
    if name == SUCCESS:
        return f"{100 * value:.1f} %"
    return score(float(value) if np.isfinite(value) else None)


def _difference(name: str, found: Difference) -> Row:
    """The difference and its interval."""
    if found.mean is None:
        return "–", ""
    sign = "+" if found.mean >= 0 else ""
    if found.low is None or found.high is None:
        return sign + _bound(name, found.mean, found), "no interval"
    return sign + _bound(name, found.mean, found), " to ".join(_bound(name, x, found) for x in (found.low, found.high))


def _bound(name: str, value: float, found: Difference) -> str:
    return f"{100 * value:.1f} %" if name == SUCCESS else amount(name, value, found)


def _facts(name: str, found: Difference) -> list[str]:
    """How many runs did better, and, where they do not tell, what would."""
    more = {SCORE: "B scores more", SUCCESS: "B alone succeeds"}.get(name, f"B has more ({name})")
    less = {SUCCESS: "A alone"}.get(name, "less")
    lines = [f"{more} in {found.more:,} runs, {less} in {found.less:,}, as much in {found.equal:,}"]
    if found.is_widened:
        lines.append(
            f"the interval is as wide as layouts can make it of which {found.runs:,} runs need have no example: "
            f"up to {100 * found.most_that_differ:.2g} % of all"
        )
    if found.detectable is not None and found.mean is not None and not found.leaves_zero_out:
        needed = f"about {found.runs_to_tell:,} runs" if found.runs_to_tell else f"more than {MAX_RUNS:,} runs"
        lines.append(
            f"{found.runs:,} runs tell a difference of {amount(name, found.detectable, found)} four times in five; "
            f"one of {amount(name, abs(found.mean), found)}, as it was here, would take {needed}"
        )
    return lines


def _aligned(rows: Sequence[Row]) -> list[Text]:
    """A line per row: the names to the left, all else to the right."""
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    lines = []
    for number, row in enumerate(rows):
        first, *others = zip(row, widths, strict=True)
        line = f"  {first[0]:<{first[1]}}" + "".join(f"  {text:>{width}}" for text, width in others)
        lines.append(Text(line.rstrip(), "" if number else "dim"))
    return lines
