"""A proof for reading: what the declaration says, what the weights say, what a run has shown."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from rich.console import Group, RenderableType
from rich.table import Table
from rich.text import Text

from mindlang.compiler.diagnostic import listed
from mindlang.proofs.data import Hashes, rests_on, run_of
from mindlang.proofs.leak import Leak
from mindlang.proofs.paths import MAX_COUNTED_PATHS
from mindlang.proofs.proof import DECLARATION, OfActuator, Proof
from mindlang.proofs.recorded import Recorded

MAX_NAMED_SKILLS = 3  # skills in a list, above which it says how many
MAX_PATH_SKILLS = 6  # skills of a path
MEANINGS = {
    "can be": "keeps still: there are readings for which it has influence, and passes none on",
    "not excluded": "not ruled out: not proved to be impossible, and seen for no readings that were tried",
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
