"""A proof as plain data, the contents of `--json`, and for reading.

Every claim says what it rests on: the declaration, weights, a run.
"""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import asdict
from typing import TYPE_CHECKING, Any

from mindrun.graph.graph import Graph
from mindrun.graph.named_readings import named_places
from mindrun.numbers.arrays import Singles
from mindrun.terminal.tick_count import ticks as in_words
from rich.console import Group, RenderableType
from rich.table import Table
from rich.text import Text

from mindlang.compiler.diagnostic import listed
from mindlang.proofs.paths import MAX_COUNTED_PATHS, Leak
from mindlang.proofs.proof import DECLARATION, ActuatorClaims, EdgeClaim, Proof, Requirement
from mindlang.proofs.trying import Tried

if TYPE_CHECKING:
    from mindlang.proofs.recorded import Recorded

Data = dict[str, Any]
Hashes = Mapping[str, str]  # the SHA-256 of each skill's weights
MAX_NAMED_SKILLS = 3  # skills in a list, above which it says how many
MAX_PATH_SKILLS = 6  # skills of a path
REQUIRED = {
    "always": "never broken",
    "can be broken": "can be broken, as --json shows",
    "not excluded": "not proved",
}
MEANINGS = {
    "can be": "keeps still: there are readings for which it has influence, and passes none on",
    "not excluded": "not ruled out: not proved to be impossible, and seen for no readings that were tried",
}


def _rests_on(skills: Iterable[str], hashes: Hashes) -> list[str]:
    """The grounds of a claim: the weights of skills, or the declaration alone."""
    return [f"the weights {hashes[skill][:4]}… of {skill}" for skill in skills] or [DECLARATION]


def proof_data(proof: Proof, hashes: Hashes, run: "Recorded | None") -> Data:
    """A whole proof as plain data."""
    them = proof.requirements
    return {
        "master": proof.graph.master,
        "assumes": "every reading is a number from 0 to 1",
        "delta": proof.delta,
        "weights": dict(hashes),
        "unknown": dict(proof.unknown),
        "not_below_master": list(proof.outside),
        "actuators": [_actuator(found, place, proof, hashes, run) for place, found in enumerate(proof.actuators)],
        "edges": [_edge(edge, hashes) for edge in proof.edges],
        **({"requirements": [_requirement(each, proof.graph, hashes) for each in them]} if them else {}),
        "dead_skills": [{"skill": name, "rests_on": _rests_on(why, hashes)} for name, why in proof.dead.items()],
        "run": None if run is None else {"task": run.task, "seed": run.seed, "ticks": run.ticks, "faults": run.faults},
    }


def _actuator(found: ActuatorClaims, place: int, proof: Proof, hashes: Hashes, run: "Recorded | None") -> Data:
    tried, total = found.tried, found.driven.total
    low, high = found.command
    data: Data = {
        "actuator": found.actuator.name,
        "paths": asdict(found.paths) | {"rests_on": [DECLARATION]},
        "leak": found.leak and _leak(found.leak),
        "command": {
            "low": low,
            "high": high,
            "seen": tried.commands,
            "needs_influence_of": 1e-30 if found.is_rough else 0.0,
            "rests_on": _rests_on(found.weights, hashes),
        },
        "neutral": {
            "value": float(found.actuator.kind.neutral),
            "sent": found.neutral,
            "influence": [total.low, total.high if total.high < float("inf") else None],
            "example": _example(proof.graph, tried),
            "rests_on": _rests_on(hashes if found.neutral == "can be" else found.weights, hashes),
        },
    }
    if run is not None:
        said = f"a run of {in_words(run.ticks)} of task {run.task}, seed {run.seed}"
        data["run"] = asdict(run.actuators[place]) | {"rests_on": [said]}
    return data


def _requirement(found: Requirement, graph: Graph, hashes: Hashes) -> Data:
    example = None if found.readings is None else readings_by_name(graph, found.readings)
    rests = _rests_on((name for name in found.weights if name in hashes), hashes)
    said = {"skill": found.skill, "promise": found.promise.text, "holds": found.holds}
    return {**said, "example": example, "rests_on": rests}


def _leak(leak: Leak) -> Data:
    return {
        "share": leak.share,
        "worst": leak.worst and leak.worst.skill,
        "levels": [asdict(level) for level in leak.levels],
        "rests_on": [DECLARATION],
    }


def _example(graph: Graph, tried: Tried) -> Data | None:
    """Readings for which nothing influences an actuator, and which skills keep still then."""
    if tried.readings is None:
        return None
    return {"still": list(tried.still), "readings": readings_by_name(graph, tried.readings)}


def readings_by_name(graph: Graph, readings: Singles) -> dict[str, list[float]]:
    """Readings [graph.width] by sensor and memory."""
    return {name: readings[rows].tolist() for name, rows in named_places(graph).items()}


def _edge(edge: EdgeClaim, hashes: Hashes) -> Data:
    sends = edge.range
    return {
        "skill": edge.skill,
        "target": edge.target,
        "low": sends.low if sends.sure else 0.0,
        "high": sends.high,
        "seen": sends.seen,
        "rests_on": _rests_on(edge.weights, hashes),
    }


def proof_report(data: Data) -> RenderableType:
    """A whole proof as text."""
    parts: list[RenderableType] = [
        Text.assemble((data["master"], "bold"), " in charge, for any readings from 0 to 1"),
        "",
        _heading(f"Paths, and the worst that leaks of {data['delta']:g} can do", DECLARATION),
        _table(
            ("actuator", "paths", "leaks take", "worst path", "most of it leaks from"), map(_leaks, data["actuators"])
        ),
        "",
        _heading("What each actuator can be sent", "the weights that are named, and the declaration"),
        _table(
            ("actuator", "command", "seen", "neutral, where nothing influences it", "rests on"),
            map(_sent, data["actuators"]),
        ),
    ]
    answers = {found["neutral"]["sent"] for found in data["actuators"]}
    parts += [Text(f"  {words}", "dim") for answer, words in MEANINGS.items() if answer in answers]
    if data["run"] is not None:
        rows = (_shown(found, data["run"]["ticks"]) for found in data["actuators"])
        parts += ["", _heading("What it was sent", data["actuators"][0]["run"]["rests_on"][0])]
        parts += [_table(("actuator", "command", "ticks without influence"), rows)]
    if claims := data.get("requirements"):
        parts += ["", Text("What skills require", "bold")]
        parts += [_table(("promise", "by those above it", "rests on"), map(_required, claims))]
    for title, lines in (("Lines and skills", _lines(data)), ("Not known", _unknown(data["unknown"]))):
        found = list(lines)
        parts += ["", Text(title, "bold"), *found] if found else []
    return Group(*parts)


def _heading(title: str, rests: str) -> Text:
    return Text.assemble((title, "bold"), (f"  rests on {rests}", "dim"))


def _table(columns: Iterable[str], rows: Iterable[Iterable[str]]) -> Table:
    table = Table(box=None, pad_edge=False, padding=(0, 2, 0, 0), header_style="dim")
    for column in columns:
        table.add_column(column, overflow="fold")
    for row in rows:
        table.add_row(*map(Text, row))
    return table


def _leaks(found: Data) -> Iterator[str]:
    """An actuator, how many paths lead to it, and the worst of them."""
    count, leak = found["paths"]["count"], found["leak"]
    yield from (found["actuator"], f"{count:,}" if count < MAX_COUNTED_PATHS else "10^15 or more")
    if leak is None:
        yield from ("", "none", "")
        return
    names = [level["skill"] for level in leak["levels"]]
    ends = [*names[: MAX_PATH_SKILLS // 2], "…", *names[-MAX_PATH_SKILLS // 2 :]]
    worst = next((level for level in leak["levels"] if level["skill"] == leak["worst"]), None)
    yield f"{leak['share']:.1%}"
    yield " → ".join(names if len(names) <= MAX_PATH_SKILLS else ends)
    yield f"{worst['skill']} {worst['share']:.1%}, into {some_names(worst['into'])}" if worst else ""


def _required(found: Data) -> tuple[str, str, str]:
    """A promise, whether those above its skill can break it, and what that rests on."""
    return f"{found['skill']} {found['promise']}", REQUIRED[found["holds"]], listed(found["rests_on"], "and")


def _sent(found: Data) -> Iterator[str]:
    """An actuator, what it can be sent and was seen to be, when it is neutral, and what that rests on."""
    command, neutral = found["command"], found["neutral"]
    yield found["actuator"]
    yield _span(command["low"], command["high"])
    yield _span(*command["seen"]) if command["seen"] else ""
    match neutral["sent"]:
        case "always":
            yield f"always {neutral['value']:g}: nothing can influence it"
        case "never":
            yield "never"
        case "can be":
            still = neutral["example"]["still"]
            yield f"{neutral['value']:g} where {some_names(still)} keep{'s' * (len(still) == 1)} still"
        case _:
            yield f"{neutral['value']:g}, not ruled out"
    rests = neutral["rests_on"]
    few = listed(rests, "and") if len(rests) < MAX_NAMED_SKILLS else f"the weights of {len(rests)} skills"
    yield few + ", where Σ influence is 0 or at least 1e-30" * bool(command["needs_influence_of"])


def _shown(found: Data, ticks: int) -> Iterator[str]:
    """An actuator, what it was sent in a run of so many ticks, and how often nothing influenced it."""
    run = found["run"]
    first = f", the first of them tick {run['first_tick']:,}" if run["first_tick"] else ""
    yield from (found["actuator"], _span(*run["commands"]))
    yield f"{run['neutral_ticks']:,} ({run['neutral_ticks'] / ticks:.1%}){first}"


def _lines(data: Data) -> Iterator[Text]:
    """Lines on edges and skills that are dead, edges that their weights keep at 1, and skills outside the hierarchy."""
    for edge in data["edges"]:
        if edge["high"] <= 0:
            yield _line(f"{edge['skill']} never influences {edge['target']}", edge["rests_on"])
        elif edge["low"] >= 1 and edge["rests_on"] != [DECLARATION]:
            yield _line(f"{edge['skill']} always influences {edge['target']} fully", edge["rests_on"])
    for dead in data["dead_skills"]:
        yield _line(f"{dead['skill']} never has influence", dead["rests_on"])
    if outside := data["not_below_master"]:
        yield _line(f"{some_names(outside)}: not below {data['master']}", [DECLARATION])


def _line(claim: str, rests: Sequence[str]) -> Text:
    return Text.assemble(f"  {claim}", (f"  rests on {listed(rests, 'and')}", "dim"))


def _unknown(unknown: Mapping[str, str]) -> Iterator[Text]:
    for why in dict.fromkeys(unknown.values()):
        names = [name for name, reason in unknown.items() if reason == why]
        if len(names) == 1:
            yield Text(f"  {names[0]} {why}: what it sends is taken to be from 0 to 1")
        else:
            plural = why.replace("is ", "are ").replace("has ", "have ")
            yield Text(f"  {some_names(names)} {plural}: what they send is taken to be from 0 to 1")


def some_names(names: Iterable[str]) -> str:
    """Names, one at least, as a sentence lists them; of many the first, and how many more."""
    found = list(names)
    if len(found) > MAX_NAMED_SKILLS + 1:
        found = [*found[:MAX_NAMED_SKILLS], f"{len(found) - MAX_NAMED_SKILLS:,} more"]
    return listed(found, "and")


def _span(low: float, high: float) -> str:
    least, most = f"{low:.3g}", f"{high:.3g}"
    return least if least == most else f"{least} to {most}"
