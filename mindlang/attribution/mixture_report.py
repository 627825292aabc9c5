"""A drive taken apart, as plain data (the contents of `--json`) and as text."""

from collections import Counter
from collections.abc import Iterator, Sequence
from string import ascii_uppercase
from typing import Any

from mindrun.graph.graph import Graph
from mindrun.terminal.command_line import command_line
from rich.console import Group, RenderableType
from rich.text import Text

from mindlang.attribution.mixture import FEWEST_SPANS, LEFT_OVER, SPAN_TICKS, Mixture, telling_readings
from mindlang.compiler.diagnostic import listed
from mindlang.run.drives import Drive
from mindlang.run.summary import aligned

LINE_COLUMNS = 76  # of the line of time
MOST_STRETCHES = 20
NOBODY = "."


def mixture_data(graph: Graph, drive: Drive, found: Sequence[Mixture]) -> list[dict[str, Any]]:
    """The mixtures of a drive; ticks are counted from 1, and are the rows of the recording."""
    return [
        {
            "drive": drive.name,
            "ticks": [drive.first + 1, drive.first + len(drive)],
            "actuators": [*each.actuators],
            "skills": {name: each.share(name) for name in each.spans[0].shares},
            "left_over": each.left_over,
            "stretches": [
                {
                    "ticks": [drive.first + span.first + 1, drive.first + span.end],
                    "by": span.by,
                    "shares": dict(span.shares),
                    "error": span.error,
                }
                for span in each.stretches()
            ],
            "told_by": telling_readings(graph, drive, each),
        }
        for each in found
        if each.spans
    ]


def mixture_text(found: Sequence[dict[str, Any]], recording: str, file: str) -> RenderableType:
    """Who explains which ticks of a drive, and the skill that could be taught for what nobody does."""
    return Group(*(part for each in found for part in _lines(each, recording, file)))


def _lines(found: dict[str, Any], recording: str, file: str) -> Iterator[RenderableType]:
    first, last = found["ticks"]
    names = sorted(found["skills"], key=lambda name: -found["skills"][name])
    letters = dict(zip(names, ascii_uppercase, strict=False))
    yield Text.assemble((listed(found["actuators"], "and"), "bold"), f" in ticks {first:,} to {last:,} of {recording}")
    yield Text(
        f"left over: {FEWEST_SPANS * SPAN_TICKS} ticks or more that no mean of these is within {LEFT_OVER:g} of", "dim"
    )
    yield ""
    rows = [(letters.get(name, "?"), name, f"{found['skills'][name]:.0%}") for name in names]
    yield aligned([*rows, (NOBODY, "left over", f"{found['left_over']:.0%}")], (0, 1), ("", "", "influence"))
    yield ""
    yield Text(_line_of_time(found, letters))
    yield ""
    stretches = sorted(found["stretches"], key=lambda each: each["ticks"][0] - each["ticks"][1])[:MOST_STRETCHES]
    yield aligned([_row(each) for each in sorted(stretches, key=lambda each: each["ticks"])], (0, 1), HEAD)
    if (more := len(found["stretches"]) - len(stretches)) > 0:
        yield Text(f"and {more:,} shorter ones: --json has all", "dim")
    if found["left_over"] > 0:
        yield ""
        yield from _proposal(found, recording, file)


HEAD = ("ticks", "mostly", "influence", "error")


def _row(each: dict[str, Any]) -> tuple[str, str, str, str]:
    first, last = each["ticks"]
    share = f"{each['shares'][each['by']]:.0%}" if each["by"] else ""
    return f"{first:,}..{last:,}", each["by"] or "nobody", share, f"{each['error']:.3f}"


def _line_of_time(found: dict[str, Any], letters: dict[str, str]) -> str:
    """A letter for each part of the drive: whose most of it is."""
    first, last = found["ticks"]
    parts = [Counter[str]() for _ in range(LINE_COLUMNS)]
    for each in found["stretches"]:
        for tick in range(each["ticks"][0], each["ticks"][1] + 1):
            parts[(tick - first) * LINE_COLUMNS // (last - first + 1)][each["by"]] += 1
    return "".join(letters.get(part.most_common(1)[0][0], NOBODY) if part else " " for part in parts)


def _proposal(found: dict[str, Any], recording: str, file: str) -> Iterator[RenderableType]:
    if not found["told_by"]:
        yield Text("What is left over can be told by none of the readings that were recorded.")
        return
    told, driven = listed(found["told_by"], "and"), found["actuators"]
    yield Text(f"What is left over can be told by {told}. A skill for it, and how it learns:")
    lines = ["skill New is mlp", *(f"  reads {name}" for name in found["told_by"])]
    yield Text("\n".join(f"  {line}" for line in [*lines, *(f"  drives {name}" for name in driven)]))
    yield Text(f"  {command_line('mindc', 'imitate', file, 'New', recording)}")
