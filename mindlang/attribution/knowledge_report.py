"""What memories know of what was drawn: as plain data, and as a table with a small curve for each."""

from typing import Any

from rich.console import Group, RenderableType
from rich.text import Text

from mindlang.attribution.knowledge import Knowledge, Probe, since
from mindlang.run.summary import aligned

BARS = "▁▂▃▄▅▆▇█"


def probe_data(found: Probe) -> dict[str, Any]:
    """Each memory and state: since when it is known, and score and chance by tick."""
    return {
        "of": found.of,
        "runs": found.runs,
        "measure": "share right" if found.values else "variance explained",
        "values": [*found.values],
        "knows": [_known(each) for each in found.found],
    }


def _known(each: Knowledge) -> dict[str, Any]:
    best = int(each.score.argmax()) if len(each.score) else None
    return {
        "noun": each.noun,
        "name": each.name,
        "since": next(since(each), None),
        "known_ticks": each.ticks[each.is_known].tolist(),
        "best": None if best is None else float(each.score[best]),
        "best_tick": None if best is None else int(each.ticks[best]),
        "last": None if best is None else float(each.score[-1]),
        "chance": None if best is None else float(each.chance.mean()),
        "ticks": each.ticks.tolist(),
        "scores": each.score.tolist(),
        "chances": each.chance.tolist(),
    }


def probe_summary(data: dict[str, Any]) -> RenderableType:
    """A row for each memory and state, the curve of its score from 0 to 1 over the ticks at the right."""
    what = f"{data['of']}, {data['measure']}, {data['runs']:,} runs of {data['task']} under {data['master']}"
    rows = [
        (
            f"{each['noun']} {each['name']}",
            "–" if each["since"] is None else f"{each['since']:,}",
            _share(each["last"]),
            _share(each["best"]),
            "–" if each["best_tick"] is None else f"{each['best_tick']:,}",
            _share(each["chance"]),
            _curve(each["scores"]),
        )
        for each in data["knows"]
    ]
    last = max((each["ticks"][-1] for each in data["knows"] if each["ticks"]), default=1)
    head = "", "since", "at last", "best", "in tick", "chance", f"ticks 1 to {last:,}"
    said = "since: known from that tick on to the last; – where it is not, at last"
    return Group(Text(what, "bold"), aligned(rows, (0, 6), head), Text(said, "dim"))


def _share(value: float | None) -> str:
    return "–" if value is None else f"{max(0.0, value):.0%}"


def _curve(scores: list[float]) -> str:
    return "".join(BARS[min(len(BARS) - 1, int(max(0.0, score) * len(BARS)))] for score in scores)
