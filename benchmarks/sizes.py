"""What benchmarks of minds of several sizes share: how many skills, and what was measured, as a table or as JSON."""

import argparse
import json
from collections.abc import Callable, Sequence
from pathlib import Path
from tempfile import TemporaryDirectory

Figures = dict[str, float]


def measure_sizes(about: str | None, skills: Sequence[int], measured: Callable[[int, Path], Figures]) -> None:
    """Measure minds of so many skills, or of as many as the command line says, in a folder, and print the figures."""
    parser = argparse.ArgumentParser(allow_abbrev=False, description=about)
    parser.add_argument("--skills", type=int, nargs="+", default=skills)
    parser.add_argument("--json", action="store_true")
    options = parser.parse_args()
    with TemporaryDirectory() as folder:
        rows = [measured(each, Path(folder)) for each in options.skills]
    if options.json:
        print(json.dumps(rows))
        return
    widths = {name: max(10, len(name)) for name in rows[0]}
    print("  ".join(f"{name:>{width}}" for name, width in widths.items()))
    for row in rows:
        print("  ".join(_figure(row[name], width) for name, width in widths.items()))


def _figure(value: float, width: int) -> str:
    return f"{value:>{width}.2f}" if value < 100 else f"{value:>{width},.0f}"
