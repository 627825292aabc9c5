"""A drive taken apart: which skills, with which influence over time, explain its commands, and what is left over.

    for drive, found in taken_apart(subject, [Path("drive.rec")]): ...

A command is a mean of what skills send, weighed by their influence (Eq. 3), so for known readings it is linear in their
shares of influence. In each span of time shares that are 0 or more, and 1 together, are found for which the squared
difference from the recorded commands is least; neighbouring spans are held together a little.
"""

from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import groupby
from pathlib import Path
from string import ascii_uppercase
from typing import Any

import numpy as np
from mindrun.engine.engine import procedure_sources
from mindrun.engine.think import hierarchy, values
from mindrun.graph.graph import Graph
from mindrun.graph.policy import Policy
from mindrun.graph.skill_sets import genes
from mindrun.kinds.functions.function import Stateful
from mindrun.kinds.procedure_text import Sources
from mindrun.kinds.sensors.sensor import directions
from mindrun.numbers.arithmetic import clamp
from mindrun.numbers.arrays import Doubles
from mindrun.terminal.command_line import command_line
from rich.console import Group, RenderableType
from rich.text import Text

from mindlang.compiler.diagnostic import listed
from mindlang.run.drives import Drive, Rows, read_drives
from mindlang.run.summary import aligned
from mindlang.training.subject import Subject

SPAN_TICKS = 2
FEWEST_SPANS = 3  # one after the other that nobody explains: fewer are a change of influence within one of them
SMOOTHNESS_SHARE = 1e-3  # of a squared change of shares from span to span, beside a squared error of a command
SEARCH_STEPS = 1000  # of the search for shares
LEFT_OVER = 0.05  # nobody explains a span with a greater mean error of a command
# Of the squared differences: explained by readings at least, and gained by each more.
TOLD_SHARE, GAINED_SHARE = 0.1, 0.02
LINE_COLUMNS = 76  # of the line of time
MOST_STRETCHES = 20
NOBODY = "."
HEAD = ("ticks", "mostly", "influence", "error")


@dataclass(frozen=True, slots=True)
class Span:
    """Some ticks of a drive, counted from its first row 0, as explained by the `shares` of skills, 1 together.

    `error` is the mean absolute difference from the recorded commands of that actuator of which it is greatest. `by` is
    the skill that has most of it; "" where nobody explains it.
    """

    first: int
    end: int
    shares: Mapping[str, float]
    error: float
    by: str


@dataclass(frozen=True, slots=True)
class Mixture:
    """The commands to some actuators taken apart, which the same skills drive."""

    actuators: tuple[str, ...]
    spans: tuple[Span, ...]

    def share(self, skill: str) -> float:
        """A skill's share of all ticks that anybody explains, 0 where nobody does."""
        ticks = sum(span.end - span.first for span in self.spans if span.by)
        return sum(span.shares[skill] * (span.end - span.first) for span in self.spans if span.by) / max(1, ticks)

    @property
    def left_over(self) -> float:
        """The share of the drive that nobody explains."""
        ticks = sum(span.end - span.first for span in self.spans)
        return sum(span.end - span.first for span in self.spans if not span.by) / ticks

    def stretches(self) -> list[Span]:
        """The spans of the same skill one after the other, as one each, with their mean shares and error."""
        found = []
        for _, group in groupby(self.spans, key=lambda span: span.by):
            each = [*group]
            ticks = np.array([span.end - span.first for span in each])
            shares = {name: float(np.average([s.shares[name] for s in each], weights=ticks)) for name in each[0].shares}
            error = float(np.average([span.error for span in each], weights=ticks))
            found.append(Span(each[0].first, each[-1].end, shares, error, each[0].by))
        return found


def taken_apart(subject: Subject, paths: Iterable[Path]) -> Iterator[tuple[Drive, list[Mixture]]]:
    """The drives in recordings, taken apart into the skills of a mind that are taught or learn nothing.

    MindError where a recording is of another mind, or a procedure cannot be made ready.
    """
    graph = subject.graph
    each = (procedure_sources(graph, subject.folder, name) for name in graph.skill_numbers)
    sources = {key: text for found in each for key, text in found.items()}
    for drive in read_drives(paths, graph):
        yield drive, mixtures(graph, drive, commands_of(subject.policy, sources, drive))


def commands_of(policy: Policy, sources: Sources, drive: Drive) -> dict[str, Doubles]:
    """What each skill that can would have sent to the actuators in a drive [ticks, actuators], NaN where nothing.

    Those that are taught, or learn nothing. WeightsError or ProcedureError where one cannot be made ready.
    """
    found = {}
    for skill in policy.graph.skills:
        if not any(edge.to == "actuator" for edge in skill.edges):
            continue
        if genes(skill) and skill.owner not in policy.weights:
            continue
        ready = hierarchy(policy, sources, skill.name).skills[0]  # the master is first
        if isinstance(ready.compute, Stateful):
            ready.compute.reset()
        sent = np.full((len(drive), len(policy.graph.actuators)), np.nan)
        with np.errstate(all="ignore"):
            for row, readings in zip(sent, drive.readings, strict=True):
                for edge, value in zip(ready.edges, values(ready, readings), strict=True):
                    if edge.drives and value is not None and np.isfinite(value) and edge.to < len(row):
                        row[edge.to] = clamp(value)
        found[skill.name] = sent
    return found


def mixtures(graph: Graph, drive: Drive, sent: Mapping[str, Doubles]) -> list[Mixture]:
    """The commands of a drive taken apart, those together that the same of these skills drive."""
    drivers: dict[tuple[str, ...], list[int]] = {}
    for place in range(len(graph.actuators)):
        names = tuple(name for name, each in sent.items() if np.isfinite(each[:, place]).any())
        if names:
            drivers.setdefault(names, []).append(place)
    return [
        Mixture(
            tuple(graph.actuators[place].name for place in places),
            _spans(drive.commands[:, places], {name: sent[name][:, places] for name in names}),
        )
        for names, places in drivers.items()
    ]


def _spans(commands: Rows, sent: Mapping[str, Doubles]) -> tuple[Span, ...]:
    """The shares of each span of commands [ticks, actuators]."""
    spans = [slice(first, first + SPAN_TICKS) for first in range(0, len(commands), SPAN_TICKS)]
    skills = np.stack([*sent.values()])
    known = np.isfinite(commands) & np.isfinite(skills).all(axis=0)
    target, skills = np.where(known, commands, 0.0), np.where(known, skills, 0.0)
    spans = [span for span in spans if known[span].any()]
    if not spans:
        return ()
    squares, products = [], []
    for span in spans:
        flat = skills[:, span].reshape(len(sent), -1)
        squares.append(flat @ flat.T / known[span].sum())
        products.append(flat @ target[span].ravel() / known[span].sum())
    shares = _shares(np.array(squares), np.array(products))
    errors = []
    for span, share in zip(spans, shares, strict=True):
        off = np.abs(np.tensordot(share, skills[:, span], 1) - target[span])
        errors.append(float((off.sum(axis=0) / np.maximum(1, known[span].sum(axis=0))).max()))
    names, found = [*sent], list[Span]()
    for _, group in groupby(range(len(spans)), key=lambda place: errors[place] > LEFT_OVER):
        places = [*group]
        is_left = errors[places[0]] > LEFT_OVER and len(places) >= FEWEST_SPANS
        for place in places:
            of = dict(zip(names, shares[place].tolist(), strict=True))
            begin, end = spans[place].start, min(spans[place].stop, len(commands))
            found.append(Span(begin, end, of, errors[place], "" if is_left else max(of, key=of.__getitem__)))
    return tuple(found)


def _shares(squares: Doubles, products: Doubles) -> Doubles:
    """The shares [spans, skills], each 0 or more and 1 together, of the least squared error.

    Of each span `squares` [skills, skills] and `products` [skills] are those of the skills' commands. Found by
    accelerated projected gradients (Nesterov).
    """
    spans, skills = products.shape
    step = 1 / (max(np.linalg.norm(each, 2) for each in squares) + 4 * SMOOTHNESS_SHARE)
    shares = ahead = np.full((spans, skills), 1 / skills)
    pace = 1.0
    for _ in range(SEARCH_STEPS):
        slope = np.einsum("sij,sj->si", squares, ahead) - products
        between = SMOOTHNESS_SHARE * np.diff(ahead, axis=0)
        slope[:-1] -= between
        slope[1:] += between
        moved, faster = _on_simplex(ahead - step * slope), (1 + np.sqrt(1 + 4 * pace * pace)) / 2
        ahead = moved + (pace - 1) / faster * (moved - shares)
        shares, pace = moved, faster
    return shares


def _on_simplex(points: Doubles) -> Doubles:
    """The nearest points [n, skills] whose numbers are 0 or more, and 1 together."""
    falling = -np.sort(-points, axis=1)
    above = np.cumsum(falling, axis=1) - 1
    count = (falling - above / np.arange(1, points.shape[1] + 1) > 0).sum(axis=1)
    level = above[np.arange(len(points)), count - 1] / count
    found: Doubles = np.maximum(points - level[:, None], 0.0)
    return found


def telling_readings(graph: Graph, drive: Drive, of: Mixture) -> list[str]:
    """The sensors by which the commands that nobody explains can be told, the most telling first; none where none can.

    One after the other the sensor is taken with whose readings, their squares, or for a direction its sine and cosine,
    a linear function explains most of the commands in every second span, fitted in the others.
    """
    left = [(number, span) for number, span in enumerate(of.spans) if not span.by]
    rows = np.concatenate([np.arange(span.first, span.end) for _, span in left]) if left else np.zeros(0, int)
    is_tested = np.repeat([place % 2 == 1 for place, _ in enumerate(left)], [s.end - s.first for _, s in left])
    places = [place for place, each in enumerate(graph.actuators) if each.name in of.actuators]
    wanted, features = drive.commands[rows][:, places].astype(float), _features(graph, drive, rows)
    is_known = np.isfinite(wanted).all(axis=1)
    if not is_tested[is_known].any() or is_tested[is_known].all():
        return []
    chosen: list[str] = []
    best = TOLD_SHARE - GAINED_SHARE
    while rest := [name for name in features if name not in chosen]:
        parts = {name: [features[each] for each in (*chosen, name)] for name in rest}
        told = {name: _explained(of, wanted, is_known & ~is_tested, is_known & is_tested) for name, of in parts.items()}
        name = max(told, key=told.__getitem__)
        if told[name] < best + GAINED_SHARE:
            break
        chosen, best = [*chosen, name], told[name]
    return chosen


def _features(graph: Graph, drive: Drive, rows: "np.ndarray[tuple[int], np.dtype[np.int64]]") -> dict[str, Doubles]:
    """The numbers [rows, n] of each sensor that has readings in all these rows."""
    around = directions({sensor.name: sensor.kind for sensor in graph.sensors})
    found = {}
    for sensor in graph.sensors:
        read = drive.readings[rows, sensor.place].astype(float)
        if np.isfinite(read).all():
            turned = 2 * np.pi * read
            parts = [np.sin(turned), np.cos(turned)] if sensor.name in around else [read, read * read]
            found[sensor.name] = np.concatenate(parts, axis=1)
    return found


def _explained(features: Sequence[Doubles], wanted: Doubles, fitted: Doubles, tested: Doubles) -> float:
    """The share of the squared differences from the mean that is gone in rows that were not fitted."""
    inputs = np.concatenate([np.ones((len(wanted), 1)), *features], axis=1)
    weights = np.linalg.lstsq(inputs[fitted], wanted[fitted], rcond=1e-6)[0]
    off, spread = wanted[tested] - inputs[tested] @ weights, wanted[tested] - wanted[fitted].mean(axis=0)
    before = float(np.square(spread).sum())
    return 1 - float(np.square(off).sum()) / before if before > 0 else 0.0


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
