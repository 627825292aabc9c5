"""A comparison for reading, and as data: the first tick that differs, and outcome beside outcome."""

from collections.abc import Iterable, Iterator, Sequence
from typing import Any

from rich.console import Group, RenderableType
from rich.text import Text

from mindlang.number_format import score
from mindlang.whatif.changed_run import Compared
from mindlang.whatif.difference import Difference
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
        beside([("", "as it was", "changed"), *_rows(was, now)]),
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


def _outcome(found: dict[str, Any]) -> dict[str, Any]:
    return {name: value for name, value in found.items() if name not in {"task", "master", "seed"}}


def _rows(was: dict[str, Any], now: dict[str, Any]) -> Iterable[tuple[str, str, str]]:
    """Outcome beside outcome: how both ended, what they counted, what each reward line paid."""
    columns = zip(_column(was, was, now), _column(now, was, now), strict=True)
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


def beside(rows: Sequence[tuple[str, str, str]]) -> Text:
    """Three columns, numbers to the right; nothing is padded at the ends of lines."""
    first, second, third = (max(len(row[i]) for row in rows) for i in range(3))
    lines = (
        Text.assemble((f"{name:<{first}}", "dim"), f"  {was:>{second}}  {now:>{third}}".rstrip())
        for name, was, now in rows
    )
    return Text("\n").join(lines)
