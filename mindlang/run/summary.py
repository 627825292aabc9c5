"""Outcomes for reading."""

from collections.abc import Sequence
from typing import Any

from mindrun.sim.outside.making import GAVE_NO_NUMBER
from rich.console import Group, RenderableType
from rich.text import Text

from mindlang.number_format import duration, rate, score
from mindlang.run.outcome import TIME


def run_summary(found: dict[str, Any]) -> RenderableType:
    """One run: how it ended, what it counted, and what each reward line paid."""
    ended = f"ended by {found['ended_by']}" if found["ended_by"] else "lasted its time"
    ended += ", a success" * found.get("succeeded", False)
    facts = _facts(
        ("seed", str(found["seed"])),
        *_counted({event: f"{times} × " for event, times in found["by_event"].items()}),
        ("ticks", f"{found['ticks']:,} of {found['of_ticks']:,}, {ended}"),
        ("faults", _faults(found)),
    )
    sums = [(Text(score(paid)), text) for text, paid in found["by_line"].items()]
    total = (Text(score(found["score"]), "bold"), "score")
    return Group(_title(found), facts, "", _aligned([*sums, total]))


def bench_summary(found: dict[str, Any]) -> RenderableType:
    """Many runs: means with their standard errors, how they ended, how fast they were."""
    runs = found["runs"]
    cores = "core" if found.get("workers") == 1 else "cores"
    who = f"by {found['on']}" if "on" in found else f"on {found['workers']} {cores}"
    error = "; ± is the standard error of the mean" if runs > 1 else ""
    ended = ", ".join(
        f"{'lasted its time' if name == TIME else name}: {n / runs:.0%}" for name, n in found["ended"].items()
    )
    best, worst = (f"{found['seed']}/{found[run]}" if found[run] else "" for run in ("best_run", "worst_run"))
    facts = _facts(
        ("runs", f"{runs} from seed {found['seed']}{error}"),
        *_counted({event: f"{_mean(spread, '')}   " for event, spread in found["by_event"].items()}),
        ("success", _share(found["success"]) if "success" in found else ""),
        ("score", _mean(found, "score_")),
        ("run time", f"{found['runtime_mean']:.1%} of the task's ticks"),
        ("ended by", ended),
        ("best run", best and f"seed {best}: mindc run --seed {best} repeats it"),
        ("worst run", worst and f"seed {worst}"),
        ("speed", f"{_rate(found)} {who}, in {duration(found['seconds'])}"),
        ("faults", _faults(found)),
    )
    return Group(_title(found), facts)


def _rate(found: dict[str, Any]) -> str:
    """How many ticks a second of a processor made, the same on a busy machine; of a clock's where that is not known."""
    cpu = found["ticks_per_cpu_second"]
    return rate(found["ticks_per_second"]) if cpu is None else rate(cpu, "CPU second")


def _title(found: dict[str, Any]) -> Text:
    return Text.assemble((found["task"], "bold"), f" with {found['master']} in charge")


def _mean(found: dict[str, Any], of: str) -> str:
    error = found[f"{of}standard_error"]
    if error == 0:
        return f"{score(found[f'{of}mean'])} in every run"
    return score(found[f"{of}mean"]) + (f" ± {error:.2f}" if error is not None else "")


def _share(found: dict[str, Any]) -> str:
    """A share of the runs; where it is all or none, which of all layouts that may be true of instead of ± 0."""
    error, mean = found["standard_error"], found["mean"]
    if found["at_least"] is not None:
        bound = f"at least {found['at_least']:.1%}" if mean else f"at most {found['at_most']:.1%}"
        return f"{mean:.1%} of the runs, {bound} of all layouts (95 % confidence)"
    return f"{mean:.1%}" + (f" ± {error:.1%}" if error is not None else "") + " of the runs"


def _counted(counts: dict[str, str]) -> list[tuple[str, str]]:
    """A row for each event, of which the first is named."""
    width = max(map(len, counts.values()), default=0)
    rows = [f"{count:>{width}}{event}" for event, count in counts.items()]
    return [("" if i else "counted", row) for i, row in enumerate(rows)]


def _faults(found: dict[str, Any]) -> str:
    faults = found.get("faults", 0)  # of a run that was stopped nobody knows them
    values = "value was not a finite number" if faults == 1 else "values were not finite numbers"
    is_its = any(GAVE_NO_NUMBER in note for note in found.get("notes", ()))
    why = "the environment gave such itself, as the note says" if is_its else "a division by zero?"
    return f"{faults:,} {values}: {why}" if faults else ""


def _facts(*rows: tuple[str, str]) -> Text:
    return _aligned([(Text(name, "dim"), value) for name, value in rows if value])


def _aligned(rows: Sequence[tuple[Text, str]]) -> Text:
    """A line per row, the first column to the right; nothing is padded at the ends of lines."""
    width = max(len(first) for first, _ in rows)
    return Text("\n").join(Text.assemble(" " * (width - len(first)), first, f"  {second}") for first, second in rows)
