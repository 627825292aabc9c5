"""Outcomes for reading."""

from typing import Any

from rich.console import Group, RenderableType
from rich.table import Table
from rich.text import Text

from mindlang.figures import duration, rate, score
from mindlang.run.outcome import TIME, standard_error


def run_summary(found: dict[str, Any]) -> RenderableType:
    """One run: how it ended, what it counted, and what each reward line paid."""
    ended = f"ended by {found['ended_by']}" if found["ended_by"] else "lasted its time"
    facts = _facts(
        ("seed", str(found["seed"])),
        ("counted", _counted(found, f"{found['counts']} ×")),
        ("ticks", f"{found['ticks']:,} of {found['of_ticks']:,}, {ended}"),
        ("faults", _faults(found)),
    )
    sums = _grid()
    for text, paid in found["by_line"].items():
        sums.add_row(score(paid), Text(text))
    sums.add_row(Text(score(found["score"]), "bold"), Text("score", "bold"))
    return Group(_title(found), facts, "", sums)


def bench_summary(found: dict[str, Any]) -> RenderableType:
    """Many runs: means with their standard errors, how they ended, how fast they were."""
    runs = found["runs"]
    means = f"{found['count_mean']:.2f} ± {standard_error(found['count_std'], runs):.2f}"
    earned = score(found["score_mean"])
    if found["score_std"] is not None:
        earned += f" ± {standard_error(found['score_std'], runs):.2f}"
    ended = ", ".join(
        f"{'lasted its time' if name == TIME else name}: {n / runs:.0%}" for name, n in found["ended"].items()
    )
    facts = _facts(
        ("runs", f"{runs} from seed {found['seed']}"),
        ("counted", _counted(found, f"{means}  ")),
        ("score", earned),
        ("run time", f"{found['runtime_mean']:.1%} of the task's ticks"),
        ("ended by", ended),
        ("best run", f"seed {found['best_seed']}"),
        ("worst run", f"seed {found['worst_seed']}"),
        ("speed", f"{rate(found['ticks_per_second'])} on {found['workers']}, in {duration(found['seconds'])}"),
        ("faults", _faults(found)),
    )
    return Group(_title(found), facts)


def _title(found: dict[str, Any]) -> Text:
    return Text.assemble((found["task"], "bold"), f" with {found['master']} in charge")


def _counted(found: dict[str, Any], count: str) -> str:
    return f"{count} {' and '.join(found['counted'])}" if found["counted"] else ""


def _faults(found: dict[str, Any]) -> str:
    return f"{found['faults']:,} values were not finite numbers, and not sent" if found["faults"] else ""


def _facts(*rows: tuple[str, str]) -> Table:
    table = _grid()
    for name, value in rows:
        if value:
            table.add_row(Text(name, "dim"), Text(value))
    return table


def _grid() -> Table:
    table = Table.grid(padding=(0, 2))
    table.add_column(justify="right")
    table.add_column()
    return table
