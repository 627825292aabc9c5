"""A proof as plain data, the contents of `--json`, and for reading.

Every claim says what it rests on: the declaration, weights, a run.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any

from mindrun.graph.graph import Graph
from mindrun.terminal.tick_count import ticks as in_words
from rich.console import Group, RenderableType
from rich.table import Table
from rich.text import Text

from mindlang.compiler.diagnostic import listed
from mindlang.proofs.leak import Leak
from mindlang.proofs.paths import MAX_COUNTED_PATHS
from mindlang.proofs.proof import DECLARATION, OfActuator, OfEdge, Proof
from mindlang.proofs.trying import Tried

if TYPE_CHECKING:
    from mindlang.proofs.recorded import Recorded

Hashes = Mapping[str, str]  # the SHA-256 of each skill's weights
MAX_NAMED_SKILLS = 3  # skills in a list, above which it says how many
MAX_PATH_SKILLS = 6  # skills of a path
MEANINGS = {
    "can be": "keeps still: there are readings for which it has influence, and passes none on",
    "not excluded": "not ruled out: not proved to be impossible, and seen for no readings that were tried",
}


def rests_on(skills: Iterable[str], hashes: Hashes) -> list[str]:
    """What a claim rests on, beside the declaration."""
    return [f"the weights {hashes[skill][:4]}… of {skill}" for skill in skills] or [DECLARATION]


def run_of(run: Recorded) -> str:
    """A run, in words."""
    return f"a run of {in_words(run.ticks)} of task {run.task}, seed {run.seed}"


def as_data(proof: Proof, hashes: Hashes, run: Recorded | None) -> dict[str, Any]:
    """A whole proof as plain data."""
    return {
        "master": proof.graph.master,
        "assumes": "every reading is a number from 0 to 1",
        "delta": proof.delta,
        "weights": dict(hashes),
        "unknown": dict(proof.unknown),
        "not_below_master": list(proof.outside),
        "actuators": [_actuator(found, place, proof, hashes, run) for place, found in enumerate(proof.actuators)],
        "edges": [_edge(edge, hashes) for edge in proof.edges],
        "dead_skills": [{"skill": name, "rests_on": rests_on(why, hashes)} for name, why in proof.dead.items()],
        "run": None if run is None else {"task": run.task, "seed": run.seed, "ticks": run.ticks, "faults": run.faults},
    }


def _actuator(found: OfActuator, place: int, proof: Proof, hashes: Hashes, run: Recorded | None) -> dict[str, Any]:
    tried, total = found.tried, found.driven.total
    low, high = found.command
    data: dict[str, Any] = {
        "actuator": found.actuator.name,
        "paths": {
            "count": found.paths.count,
            "first": [list(path) for path in found.paths.first],
            "rests_on": [DECLARATION],
        },
        "leak": found.leak and _leak_data(found.leak),
        "command": {
            "low": low,
            "high": high,
            "seen": tried and tried.commands,
            "needs_influence_of": 1e-30 if found.is_rough else 0.0,
            "rests_on": rests_on(found.weights, hashes),
        },
        "neutral": {
            "value": float(found.actuator.kind.neutral),
            "sent": found.neutral,
            "influence": [total.low, total.high if total.high < float("inf") else None],
            "example": _example(proof.graph, tried),
            "rests_on": rests_on(hashes if found.neutral == "can be" else found.weights, hashes),
        },
    }
    if run is not None:
        undriven = run.actuators[place]
        data["run"] = {
            "neutral_ticks": undriven.ticks,
            "first_tick": undriven.first,
            "commands": list(undriven.commands),
            "rests_on": [run_of(run)],
        }
    return data


def _leak_data(leak: Leak) -> dict[str, Any]:
    return {
        "share": leak.share,
        "worst": leak.worst and leak.worst.skill,
        "levels": [{"skill": level.skill, "share": level.share, "into": list(level.into)} for level in leak.levels],
        "rests_on": [DECLARATION],
    }


def _example(graph: Graph, tried: Tried | None) -> dict[str, Any] | None:
    """Readings for which nothing influences an actuator, and which skills keep still then."""
    if tried is None or tried.readings is None:
        return None
    values = tried.readings.tolist()
    readings = {sensor.name: values[sensor.start : sensor.start + sensor.width] for sensor in graph.sensors}
    return {"still": list(tried.still), "readings": readings | {m.name: [values[m.start]] for m in graph.memories}}


def _edge(edge: OfEdge, hashes: Hashes) -> dict[str, Any]:
    sends = edge.range
    return {
        "skill": edge.skill,
        "target": edge.target,
        "low": sends.low if sends.sure else 0.0,
        "high": sends.high,
        "seen": sends.seen,
        "rests_on": rests_on(edge.weights, hashes),
    }


def report(proof: Proof, hashes: Hashes, run: Recorded | None) -> RenderableType:
    """A whole proof as text."""
    parts: list[RenderableType] = [
        Text.assemble((proof.graph.master, "bold"), " in charge, for any readings from 0 to 1"),
        "",
        _heading(f"Paths, and the worst that leaks of {proof.delta:g} can do", DECLARATION),
        _leaks(proof),
        "",
        _heading("What each actuator can be sent", "the weights that are named, and the declaration"),
        _commands(proof, hashes),
        *_legend(proof),
    ]
    if run is not None:
        parts += ["", _heading("What it was sent", run_of(run)), _run(proof, run)]
    for title, lines in (("Lines and skills", _lines(proof, hashes)), ("Not known", _unknown(proof))):
        found = list(lines)
        parts += ["", Text(title, "bold"), *found] if found else []
    return Group(*parts)


def _heading(title: str, rests: str) -> Text:
    return Text.assemble((title, "bold"), (f"  rests on {rests}", "dim"))


def _table(*columns: str) -> Table:
    table = Table(box=None, pad_edge=False, padding=(0, 2, 0, 0), header_style="dim")
    for column in columns:
        table.add_column(column, overflow="fold")
    return table


def _leaks(proof: Proof) -> Table:
    table = _table("actuator", "paths", "leaks take", "worst path", "most of it leaks from")
    for found in proof.actuators:
        count = f"{found.paths.count:,}" if found.paths.count < MAX_COUNTED_PATHS else "10^15 or more"
        table.add_row(Text(found.actuator.name), count, *map(Text, _leak(found.leak)))
    return table


def _leak(leak: Leak | None) -> tuple[str, str, str]:
    if leak is None:
        return "", "none", ""
    names = [level.skill for level in leak.levels]
    path = (
        names
        if len(names) <= MAX_PATH_SKILLS
        else [*names[: MAX_PATH_SKILLS // 2], "…", *names[-MAX_PATH_SKILLS // 2 :]]
    )
    worst = leak.worst
    cause = "" if worst is None else f"{worst.skill} {worst.share:.1%}, into {some(worst.into)}"
    return f"{leak.share:.1%}", " → ".join(path), cause


def _commands(proof: Proof, hashes: Hashes) -> Table:
    table = _table("actuator", "command", "seen", "neutral, where nothing influences it", "rests on")
    for found in proof.actuators:
        seen = _span(*found.tried.commands) if found.tried and found.tried.commands else ""
        table.add_row(
            Text(found.actuator.name), _span(*found.command), seen, Text(_neutral(found)), Text(_rests(found, hashes))
        )
    return table


def _neutral(found: OfActuator) -> str:
    value = f"{found.actuator.kind.neutral:g}"
    match found.neutral:
        case "always":
            return f"always {value}: nothing can influence it"
        case "never":
            return "never"
        case "can be":
            assert found.tried
            return f"{value} where {some(found.tried.still)} keep{'s' * (len(found.tried.still) == 1)} still"
    return f"{value}, not ruled out"


def _legend(proof: Proof) -> Iterator[Text]:
    """What the words in the table mean, where it has them."""
    answers = {found.neutral for found in proof.actuators}
    for answer, words in MEANINGS.items():
        if answer in answers:
            yield Text(f"  {words}", "dim")


def _rests(found: OfActuator, hashes: Hashes) -> str:
    names = list(hashes) if found.neutral == "can be" else list(found.weights)
    few = (
        listed(rests_on(names, hashes), "and")
        if len(names) <= MAX_NAMED_SKILLS - 1
        else f"the weights of {len(names)} skills"
    )
    return few + ", where Σ influence is 0 or at least 1e-30" * found.is_rough


def _run(proof: Proof, run: Recorded) -> Table:
    table = _table("actuator", "command", "ticks without influence")
    for found, shown in zip(proof.actuators, run.actuators, strict=True):
        first = f", the first of them tick {shown.first:,}" if shown.first else ""
        often = f"{shown.ticks:,} ({shown.ticks / run.ticks:.1%}){first}"
        table.add_row(Text(found.actuator.name), _span(*shown.commands), often)
    return table


def _lines(proof: Proof, hashes: Hashes) -> Iterator[Text]:
    """What is dead, and what is always fully on though it could be learnt not to be."""
    for edge in proof.edges:
        rests = listed(rests_on(edge.weights, hashes), "and")
        if edge.range.is_dead:
            yield _line(f"{edge.skill} never influences {edge.target}", rests)
        elif edge.range.low >= 1 and edge.range.sure and edge.weights:
            yield _line(f"{edge.skill} always influences {edge.target} fully", rests)
    for name, weights in proof.dead.items():
        yield _line(f"{name} never has influence", listed(rests_on(weights, hashes), "and"))
    if proof.outside:
        yield _line(f"{some(proof.outside)}: not below {proof.graph.master}", DECLARATION)


def _line(claim: str, rests: str) -> Text:
    return Text.assemble(f"  {claim}", (f"  rests on {rests}", "dim"))


def _unknown(proof: Proof) -> Iterator[Text]:
    for why in dict.fromkeys(proof.unknown.values()):
        names = [name for name, reason in proof.unknown.items() if reason == why]
        yield _line_of(names, why)


def _line_of(names: Sequence[str], why: str) -> Text:
    if len(names) == 1:
        return Text(f"  {names[0]} {why}: what it sends is taken to be from 0 to 1")
    plural = why.replace("is ", "are ").replace("has ", "have ")
    return Text(f"  {some(names)} {plural}: what they send is taken to be from 0 to 1")


def some(names: Iterable[str]) -> str:
    """Names, one at least, as a sentence lists them; of many the first, and how many more."""
    found = list(names)
    if len(found) > MAX_NAMED_SKILLS + 1:
        found = [*found[:MAX_NAMED_SKILLS], f"{len(found) - MAX_NAMED_SKILLS:,} more"]
    return listed(found, "and")


def _span(low: float, high: float) -> str:
    least, most = f"{low:.3g}", f"{high:.3g}"
    return least if least == most else f"{least} to {most}"
