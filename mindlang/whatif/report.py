"""A comparison for reading, and as data: the first tick that differs, and outcome beside outcome."""

from collections.abc import Iterator, Sequence
from itertools import groupby
from typing import Any

from mindrun.graph.draws import drawn_in_words
from mindrun.terminal.tick_count import ticks as in_words
from rich.console import Group, RenderableType
from rich.text import Text

from mindlang.number_format import score
from mindlang.run.summary import aligned
from mindlang.whatif.comparison import Compared, TickDifference
from mindlang.whatif.open_loop import OPEN_LOOP, OpenLoop
from mindlang.whatif.request import Request

MAX_NAMED_DIFFERENCES = 6  # of one kind in one tick
KINDS = {"reading": "read ", "influence": "influence of ", "command": "command ", "robot": "robot's ", "reward": ""}


def differences_text(differences: Sequence[TickDifference]) -> Text:
    """A line for each kind of number: its first tick that differs, and in what."""
    if not differences:
        return Text("nothing differs, to the bit")
    groups = groupby(differences, lambda each: (each.tick, each.what))
    rows = [(Text(f"tick {tick:,}", "dim"), KINDS[what] + _numbers([*group])) for (tick, what), group in groups]
    return aligned(rows, left=(1,))


def _numbers(group: Sequence[TickDifference]) -> str:
    named = [f"{each.name} {each.was:.6g} → {each.now:.6g}" for each in group[:MAX_NAMED_DIFFERENCES]]
    more = len(group) - len(named)
    return ", ".join(named) + (f" and {more} more" if more else "")


def comparison_summary(request: Request, compared: Compared) -> RenderableType:
    """A text: what differs first, and what came of both runs."""
    was, now = compared.was.found, compared.now.found
    columns = zip(*(_column(found, was, now) for found in (was, now)), strict=True)
    return Group(
        Text.assemble(
            (was["task"], "bold"),
            f" with {was['master']} in charge, seed {was['seed']}{drawn_in_words(was.get('drawn', {}))}",
        ),
        Text(request.words),
        "",
        differences_text(compared.differences),
        "",
        _table([("", "as it was", "changed"), *((name, before, after) for (name, before), (_, after) in columns)]),
    )


def _column(found: dict[str, Any], was: dict[str, Any], now: dict[str, Any]) -> Iterator[tuple[str, str]]:
    """The figures of one run by name, for a table of both; – for what only the other one has."""
    yield "ticks", f"{found['ticks']:,}"
    yield "ended by", found["ended_by"] or "time"
    if "succeeded" in was or "succeeded" in now:
        yield "success", "yes" if found.get("succeeded") else "no"
    for event in {**was["by_event"], **now["by_event"]}:
        yield event, str(found["by_event"].get(event, "–"))
    if was["faults"] or now["faults"]:
        yield "faults", f"{found['faults']:,}"
    for line in {**was["by_line"], **now["by_line"]}:
        yield line, score(found["by_line"][line]) if line in found["by_line"] else "–"
    yield "score", score(found["score"])


def comparison_data(request: Request, compared: Compared) -> dict[str, Any]:
    """The contents of `--json`; `differs` has the first tick of each kind of number, the earliest first."""
    was, now = compared.was.found, compared.now.found
    of_both = {name: was[name] for name in ("task", "master", "seed")}
    was, now = ({name: value for name, value in found.items() if name not in of_both} for found in (was, now))
    differs = [each.as_data() for each in compared.differences]
    return {**of_both, **_asked(request), "differs": differs, "as_it_was": was, "changed": now}


def recording_summary(request: Request, name: str, found: OpenLoop) -> RenderableType:
    """A text: what the mind would have sent for the readings of a recording."""
    rows = [
        (actuator, f"{of['ticks']:,}", f"{of['mean']:.4g}", f"{of['most']:.4g}", _tick(of["most_tick"]))
        for actuator, of in found.sent.items()
    ]
    return Group(
        Text.assemble((name, "bold"), f" with {found.master} in charge, {in_words(found.ticks)}"),
        Text(request.words),
        Text(OPEN_LOOP),
        "",
        differences_text(found.differences),
        "",
        _table([("command", "differs in ticks", "mean", "most", "in tick"), *rows]),
    )


def recording_data(request: Request, found: OpenLoop) -> dict[str, Any]:
    """The contents of `--json`: `commands` has by how much each differs over the ticks from the first one changed."""
    return {
        "master": found.master,
        "ticks": found.ticks,
        **_asked(request),
        "open_loop": True,
        "differs": [each.as_data() for each in found.differences],
        "commands": found.sent,
    }


def _tick(number: int | None) -> str:
    return f"{number:,}" if number else "–"


def _asked(request: Request) -> dict[str, Any]:
    return {"changes": [*request.parts], "tick": request.tick}


def _table(rows: Sequence[Sequence[str]]) -> Text:
    return aligned([(Text(name, "dim"), *values) for name, *values in rows], left=(0,))
