"""Wall time of `mindc check` and `mindc --help`, as a user waits for it: python benchmarks/check.py [--json]."""

import argparse
import json
import subprocess
import sys
import time
from pathlib import Path
from statistics import median

COLLECT = Path(__file__).parent.parent / "examples" / "collect" / "collect.mind"
COMMANDS = {"mindc check collect.mind": ["check", str(COLLECT)], "mindc --help": ["--help"]}


def seconds(arguments: list[str]) -> float:
    """How long one call takes, from the start of the process to its end."""
    begin = time.perf_counter()
    program = "from mindlang.cli import main; main()"
    subprocess.run([sys.executable, "-c", program, *arguments], check=True, capture_output=True)
    return time.perf_counter() - begin


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(allow_abbrev=False, description=__doc__)
    parser.add_argument("--runs", type=int, default=10)
    parser.add_argument("--json", action="store_true")
    options = parser.parse_args()
    found = {}
    for name, arguments in COMMANDS.items():
        taken = [seconds(arguments) for _ in range(options.runs)]
        found[name] = {"median": median(taken), "min": min(taken), "max": max(taken)}
    if options.json:
        print(json.dumps(found))
    for name, spread in () if options.json else found.items():
        print(f"{name}: {spread['median']:.3f} s  ({spread['min']:.3f} .. {spread['max']:.3f})")


if __name__ == "__main__":
    main()
