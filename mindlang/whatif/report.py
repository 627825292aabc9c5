"""A comparison for reading, and as data: the first tick that differs, and outcome beside outcome."""

from collections.abc import Iterable, Iterator, Sequence
from typing import Any

from mindrun.terminal.tick_count import ticks as in_words
from rich.console import Group, RenderableType
from rich.text import Text

from mindlang.number_format import score
from mindlang.whatif.changed_run import Compared
from mindlang.whatif.difference import Difference
from mindlang.whatif.open_loop import OPEN_LOOP, OpenLoop, Sent
from mindlang.whatif.request import Request

MAX_NAMED_DIFFERENCES = 6  # of one kind in one tick
KINDS = {
    "reading": "read",
    "influence": "influence of",
    "command": "command",
    "robot": "robot's",
    "reward": "",
}


def differences_text(differences: Sequence[Difference]) -> Text:
    """A line for each kind of number: its first tick that differs, and in what."""
    if not differences:
        return Text("nothing differs, to the bit")
    groups: dict[tuple[int, str], list[Difference]] = {}
    for each in differences:
        groups.setdefault((each.tick, each.what), []).append(each)
    ticks = [f"tick {tick:,}" for tick, _ in groups]
    width = max(map(len, ticks))
    lines = (
        Text.assemble((f"{tick:>{width}}", "dim"), "  ", _numbers(what, group))
        for tick, ((_, what), group) in zip(ticks, groups.items(), strict=True)
    )
    return Text("\n").join(lines)


def _numbers(what: str, group: Sequence[Difference]) -> str:
    named = [f"{each.name} {_number(each.was)} → {_number(each.now)}" for each in group[:MAX_NAMED_DIFFERENCES]]
    more = len(group) - len(named)
    return f"{KINDS[what]} {', '.join(named)}".lstrip() + (f" and {more} more" if more else "")


def _number(value: float) -> str:
    return f"{value:.6g}"


def comparison_summary(request: Request, compared: Compared) -> RenderableType:
    """What differs first, and what came of both runs."""
    was, now = compared.was.found, compared.now.found
    return Group(
        Text.assemble((was["task"], "bold"), f" with {was['master']} in charge, seed {was['seed']}"),
        Text(request.words),
        "",
        differences_text(compared.differences),
        "",
        aligned([("", "as it was", "changed"), *_rows(was, now)]),
    )


def comparison_data(request: Request, compared: Compared) -> dict[str, Any]:
    """The contents of `--json`; `differs` has the first tick of each kind of number, the earliest first."""
    was, now = compared.was.found, compared.now.found
    return {
        **{name: was[name] for name in ("task", "master", "seed")},
        "changes": [*request.parts],
        "tick": request.tick,
        "differs": [each.as_data() for each in compared.differences],
        "as_it_was": _outcome(was),
        "changed": _outcome(now),
    }


def recording_summary(request: Request, name: str, found: OpenLoop) -> RenderableType:
    """What the mind would have sent for the readings of a recording."""
    return Group(
        Text.assemble((name, "bold"), f" with {found.master} in charge, {in_words(found.ticks)}"),
        Text(request.words),
        Text(OPEN_LOOP),
        "",
        differences_text(found.differences),
        "",
        aligned([("command", "differs in ticks", "mean", "most", "in tick"), *map(_sent_row, found.sent)]),
    )


def _sent_row(sent: Sent) -> tuple[str, ...]:
    most_tick = f"{sent.most_tick:,}" if sent.ticks else "–"
    return sent.name, f"{sent.ticks:,}", f"{sent.mean:.4g}", f"{sent.most:.4g}", most_tick


def recording_data(request: Request, found: OpenLoop) -> dict[str, Any]:
    """The contents of `--json`: `commands` has by how much each differs over the ticks from the first one changed."""
    return {
        "master": found.master,
        "ticks": found.ticks,
        "changes": [*request.parts],
        "tick": request.tick,
        "open_loop": True,
        "differs": [each.as_data() for each in found.differences],
        "commands": {
            sent.name: {
                "ticks": sent.ticks,
                "mean": sent.mean,
                "most": sent.most,
                "most_tick": sent.most_tick if sent.ticks else None,
            }
            for sent in found.sent
        },
    }


def _outcome(found: dict[str, Any]) -> dict[str, Any]:
    return {name: value for name, value in found.items() if name not in {"task", "master", "seed"}}


def _rows(was: dict[str, Any], now: dict[str, Any]) -> Iterable[tuple[str, str, str]]:
    """Outcome beside outcome: how both ended, what they counted, what each reward line paid."""
    columns = zip(*(_column(found, was, now) for found in (was, now)), strict=True)
    return [(name, before, after) for (name, before), (_, after) in columns]


def _column(found: dict[str, Any], was: dict[str, Any], now: dict[str, Any]) -> Iterator[tuple[str, str]]:
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


def aligned(rows: Sequence[Sequence[str]]) -> Text:
    """Columns, the first to the left and numbers to the right; nothing is padded at the ends of lines."""
    first, *others = (max(map(len, column)) for column in zip(*rows, strict=True))
    lines = (
        Text.assemble(
            (f"{name:<{first}}", "dim"), *(f"  {value:>{width}}" for value, width in zip(values, others, strict=True))
        )
        for name, *values in rows
    )
    return Text("\n").join(lines)
