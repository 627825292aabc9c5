"""The tables in Markdown: the paper's numbers and ours side by side, and how many attempts of each lesson succeed."""

from collections.abc import Callable, Iterable, Sequence
from math import sqrt
from pathlib import Path
from statistics import fmean, stdev

from logs import Log, logs_of
from measure import champions_do, measure, read_champions
from protocol import FILES, SUCCESS, Table

from mindlang.figures import duration

Say = Callable[[str], None]
FRESH = 100  # layouts on which each champion is tried


def table(folder: Path, of: Table, runs: int, seed: int, say: Say) -> str:
    """A table of the paper beside what the minds in a folder do on so many layouts."""
    rows = []
    for case in of.cases:
        say(f"table {of.number}: {case.name}, {of.title}")
        ours = measure(folder, case, runs, seed)
        rows.append((case.name, str(case.paper), ours.text(case.interrupt) if ours else "not taught"))
    return _markdown(("", "paper", f"ours, {runs} runs"), rows)


def attempts(folder: Path, seed: int, say: Say) -> str:
    """How many attempts of the lessons of Scenario 1 have succeeded, each champion tried on fresh layouts."""
    rows = []
    for lesson, log in logs_of(folder, FILES[0]).items():
        say(f"attempts: {lesson}")
        counts = champions_do(folder, FILES[0], lesson, read_champions(log.champions), FRESH, seed)
        succeeded = sum(count >= SUCCESS[lesson] for count in counts)
        rows.append((
            lesson, f"{SUCCESS[lesson]:g}", f"{succeeded} of {len(counts)}", _spread(counts), f"{max(counts):.1f}",
        ))  # fmt: skip
    return _markdown(("lesson", "succeeds from", "succeeded", "counted, mean of the attempts", "best"), rows)


def lessons(folder: Path) -> str:
    """How each lesson was taught: how long, from which seed, what it took."""
    return _markdown(
        ("file", "lesson", "generations", "attempts", "seed", "score of the kept", "ticks", "time"),
        [_lesson(file, log) for file in FILES for log in logs_of(folder, file).values()],
    )


def _lesson(file: str, log: Log) -> tuple[str, ...]:
    result = log.result
    return (
        file,
        log.lesson,
        str(result["generations"]),
        str(result["attempts"]),
        str(result["seed"]),
        f"{result['reevaluated']:.1f}",
        f"{result['ticks'] / 1e6:,.0f} M",
        duration(result["seconds"]),
    )


def _spread(counts: Sequence[float]) -> str:
    error = stdev(counts) / sqrt(len(counts)) if len(counts) > 1 else 0.0
    return f"{fmean(counts):.1f} ± {error:.1f}"


def _markdown(head: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    lines = [head, ["---"] * len(head), *rows]
    return "\n".join(f"| {' | '.join(cells)} |" for cells in lines)
