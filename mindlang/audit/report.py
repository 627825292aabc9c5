"""The report of an audit: as plain data, and as a table to read."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
from rich.console import Group as Rows
from rich.console import RenderableType
from rich.text import Text

from mindlang.audit.findings import Findings
from mindlang.audit.probes import Group
from mindlang.number_format import finite, score
from mindlang.run.summary import aligned, shortened

SHOWN: dict[Group, int] = {"still": 1, "moving": 3, "to and fro": 1, "random": 2, "found": 1, "skill": 5}
NAME_COLUMNS, LINE_COLUMNS = 30, 26


@dataclass(frozen=True, slots=True)
class Row:
    """A policy that was tried, as a row of a report: the line that pays it most, and how much."""

    name: str
    group: Group
    score: float | None
    count: float
    line: str
    paid: float


def audit_data(found: Findings, seed: int) -> dict[str, Any]:
    """What was tried, and what each line paid at least and at most; the findings are told apart."""
    lines = found.evidence.lines
    sums = [{"line": each.text, "least": float(lines[:, i].min()), "most": float(lines[:, i].max())}
            for i, each in enumerate(found.task.rewards)]  # fmt: skip
    rows = [row(found, number) for number in np.argsort(-found.evidence.scores, kind="stable")]
    return {
        "task": found.task.name,
        "seed": seed,
        "policies": [{name: getattr(each, name) for name in Row.__slots__} for each in rows],
        "lines": sums,
        "is_counted": found.is_counted,
    }


def row(found: Findings, number: int) -> Row:
    """A policy as a row."""
    probe, genome = found.evidence.origins[number]
    paid = found.evidence.lines[number]
    most = int(paid.argmax())
    name = f"{probe.name} {genome + 1}" if len(probe.genomes) > 1 else probe.name
    count = float(found.counts[number])
    return Row(
        name,
        probe.group,
        finite(found.evidence.scores[number]),
        count,
        found.task.rewards[most].text,
        float(paid[most]),
    )


def audit_table(found: Findings) -> RenderableType:
    """The best of each group, with what they counted and the line that pays them most."""
    rows = [*_chosen(found)]
    width = max(len(each.line.removeprefix("rewards ")) for each in rows)
    table = aligned(
        [
            (
                shortened(each.name, NAME_COLUMNS),
                score(each.score),
                f"{each.count:.2f}" if found.is_counted else "–",
                score(each.paid),
                shortened(each.line.removeprefix("rewards "), min(width, LINE_COLUMNS)),
            )
            for each in rows
        ],
        (0, 4),
        (found.task.name, "score", "count", "paid", "most by"),
    )
    note = "nothing is counted, so that nothing can be said of points without it"
    return Rows(table, *([] if found.is_counted else [Text(note, "dim")]))


def _chosen(found: Findings) -> Iterator[Row]:
    order = np.argsort(-found.evidence.scores, kind="stable")
    for group, most in SHOWN.items():
        of = [number for number in order if found.evidence.of(group)[number]]
        if group == "still":  # the one at rest; others only move what moves nothing
            of = of and [int(np.flatnonzero(found.evidence.of("still"))[0])]
        alike = {(found.evidence.scores[number], found.counts[number]): number for number in reversed(of)}
        yield from (row(found, int(number)) for number in [*reversed(alike.values())][:most])
