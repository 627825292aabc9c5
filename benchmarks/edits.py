"""Wall time of edits of a file with 10,000 skills, from the call to the diff: python benchmarks/edits.py [--json]."""

import argparse
import json
import subprocess
import sys
import time
from pathlib import Path
from statistics import median
from tempfile import TemporaryDirectory

HEAD = """\
tick 1/60 s
master S0

body Robot is disc size 2 density 2
actuator left is wheel side left thrust 80 neutral 0.5
sensor proximity is range_finder at 0 90 deg range 12
sensor battery is battery
"""
EDITS = {
    "check, for comparison": ["check"],
    "rename": ["edit", "rename", "S1", "Renamed", "--noun", "skill"],
    "connect": ["edit", "connect", "S5", "battery"],
    "encapsulate": ["edit", "encapsulate", "S1", "Above", "--with", "S9", "--reads", "battery"],
    "rename --write": ["edit", "rename", "S2", "Other", "--noun", "skill", "--write"],
}


def tree(skills: int) -> str:
    """A mind in which each skill influences two others."""
    lines = [HEAD]
    for number in range(skills):
        below = [child for child in (2 * number + 1, 2 * number + 2) if child < skills]
        lines += [f"skill S{number} is mlp hidden 2", "  reads proximity"]
        lines += [f"  influences S{child}" for child in below] or ["  drives left"]
        lines.append("")
    return "\n".join(lines)


def seconds(arguments: list[str], path: Path) -> float:
    """How long one call takes, from the start of the process to its end."""
    command, *others = arguments
    begin = time.perf_counter()
    program = "from mindlang.cli import main; main()"
    subprocess.run([sys.executable, "-c", program, command, *others, str(path)], check=True, capture_output=True)
    return time.perf_counter() - begin


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(allow_abbrev=False, description=__doc__)
    parser.add_argument("--skills", type=int, default=10_000)
    parser.add_argument("--runs", type=int, default=3)
    parser.add_argument("--json", action="store_true")
    options = parser.parse_args()
    found = {}
    with TemporaryDirectory() as folder:
        path = Path(folder) / "big.mind"
        for name, arguments in EDITS.items():
            taken = []
            for _ in range(options.runs):
                path.write_text(tree(options.skills), encoding="utf-8")
                taken.append(seconds(arguments, path))
            found[name] = {"median": median(taken), "min": min(taken), "max": max(taken)}
    if options.json:
        print(json.dumps(found))
    for name, taken_ in () if options.json else found.items():
        print(f"{name}: {taken_['median']:.2f} s  ({taken_['min']:.2f} .. {taken_['max']:.2f})")


if __name__ == "__main__":
    main()
