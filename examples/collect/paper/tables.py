"""The tables in Markdown: the paper's numbers and ours side by side, and how many attempts of each lesson succeed."""

from collections.abc import Callable, Iterable, Sequence
from math import sqrt
from pathlib import Path
from statistics import fmean, stdev

from logs import Log, logs_of
from measure import champions_do, is_taught, measure, teaching
from protocol import FILES, SUCCESS, Case, Table

from mindlang.number_format import duration

Say = Callable[[str], None]
FRESH_LAYOUTS = 100  # layouts on which each champion is tried


def table(folder: Path, of: Table, runs: int, seed: int, say: Say) -> str:
    """A table of the paper beside what the minds in a folder do on so many layouts."""
    rows = []
    for case in of.cases:
        say(f"table {of.number}: {case.name}, {of.title}")
        rows.append((case.name, str(case.paper), *_ours(folder, case, runs, seed)))
    return _markdown(("", "paper", f"ours, {runs} runs", "its own lessons: generations × attempts"), rows)


def _ours(folder: Path, case: Case, runs: int, seed: int) -> tuple[str, str]:
    if not is_taught(folder, case):
        return "not taught", ""
    return measure(folder, case, runs, seed).text(case.interrupt), _effort(folder, case)


def _effort(folder: Path, case: Case) -> str:
    """How much was taught for a case in its own file, beside what it has from others."""
    logs = logs_of(folder, case.file)
    results = [
        logs[lesson.name].result
        for file, lessons in teaching(folder, case).items()
        for lesson in lessons
        if file.name == case.file and lesson.name in logs
    ]
    attempts = max((result["attempts"] for result in results), default=0)
    return f"{sum(result['generations'] for result in results)} × {attempts}" if results else ""


def attempts(folder: Path, seed: int, say: Say) -> str:
    """How many attempts of the lessons of Scenario 1 have succeeded, each champion tried on fresh layouts."""
    rows = []
    logs = logs_of(folder, FILES[0])
    for lesson in SUCCESS:
        if lesson not in logs:
            continue
        say(f"attempts: {lesson}")
        counts = champions_do(folder, FILES[0], lesson, logs[lesson].champions, FRESH_LAYOUTS, seed)
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
    error = f"{stdev(counts) / sqrt(len(counts)):.1f}" if len(counts) > 1 else "?"
    return f"{fmean(counts):.1f} ± {error}"


def _markdown(head: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    lines = [head, ["---"] * len(head), *rows]
    return "\n".join(f"| {' | '.join(cells)} |" for cells in lines)
