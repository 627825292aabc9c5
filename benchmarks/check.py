"""What commands that read text cost: python -m benchmarks.check [--against COMMIT] [--rounds N] [--only NAME] [--json].

CPU seconds and wall seconds of a process, the least of all rounds, and how many modules it has imported, of ours and in
all. With --against, a commit's checkout takes turns with this one. The first round makes what is kept, such as Lark's
table of the grammar, and does not count. `10,000 skills` is a hierarchy of so many, each of which influences two.
"""

import argparse
import json
import os
import subprocess
import sys
import tempfile
from contextlib import nullcontext
from pathlib import Path

from benchmarks.rates import ROOT, checkout

COLLECT = "examples/collect/collect.mind"
COMMANDS = {
    "check": ["check", COLLECT],
    "lint": ["lint", COLLECT],
    "fmt": ["fmt", "--check", COLLECT],
    "explain": ["explain", "unread-sensor"],
    "show": ["show", COLLECT],
    "--help": ["--help"],
    "check, 10,000 skills": ["check", "many.mind"],
}
PROGRAM = """
import json, resource, sys, time
began = time.perf_counter()
from mindlang.cli import main
try:
    main()
except SystemExit:
    pass
used = resource.getrusage(resource.RUSAGE_SELF)
ours = sum(name.split(".")[0] in ("mindlang", "mindrun") for name in sys.modules)
print(json.dumps([used.ru_utime + used.ru_stime, time.perf_counter() - began, ours, len(sys.modules)]))
"""
HEAD = """tick 1/60 s
master S0
body Robot is disc
actuator left_wheel is wheel side left neutral 0.5
actuator right_wheel is wheel side right neutral 0.5
sensor eye is range_finder at 0 deg
"""


def many(skills: int = 10_000) -> str:
    """A mind of so many skills, a tree in which every other one also influences one further on."""
    lines = [HEAD]
    for number in range(skills):
        below = [child for child in (2 * number + 1, 2 * number + 2) if child < skills]
        beside = [number + 7] if number % 2 == 0 and number + 7 < skills and number + 7 not in below else []
        lines.append(f"skill S{number} is rule\n  reads eye\n")
        lines += [f"  influences S{child} at eye\n" for child in (*below, *beside)]
        lines += [] if below else ["  drives left_wheel at 1\n"]
    return "".join(lines)


def measured(root: Path, words: list[str], folder: Path) -> list[float]:
    """CPU seconds, wall seconds, modules of ours and all modules of one call of a checkout's `mindc`."""
    there = [str(root / word) if word == COLLECT else word for word in words]
    path = os.pathsep.join(map(str, (root, root / "runtime")))
    environment = os.environ | {"PYTHONPATH": path, "XDG_CACHE_HOME": str(folder)}
    command = [sys.executable, "-c", PROGRAM, *there]
    done = subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True, check=True)
    found: list[float] = json.loads(done.stdout.splitlines()[-1])
    return found


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(
        allow_abbrev=False, description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--against", metavar="COMMIT", help="another commit takes turns with this checkout")
    parser.add_argument("--rounds", type=int, default=10)
    parser.add_argument("--only", choices=COMMANDS, action="append", help="this command alone, or these")
    parser.add_argument("--json", action="store_true")
    options = parser.parse_args()
    found: dict[str, dict[str, list[float]]] = {}
    with checkout(options.against) if options.against else nullcontext(ROOT) as other:
        roots = {"here": ROOT} | ({options.against[:9]: other} if options.against else {})
        with tempfile.TemporaryDirectory() as folder:
            Path(folder, "many.mind").write_text(many())
            for name in options.only or COMMANDS:
                rounds = [
                    {side: measured(root, COMMANDS[name], Path(folder)) for side, root in roots.items()}
                    for _ in range(options.rounds + 1)
                ][1:]
                found[name] = {
                    side: [min(each) for each in zip(*(one[side] for one in rounds), strict=True)] for side in roots
                }
                if not options.json:
                    _print(name, found[name])
    if options.json:
        print(json.dumps(found))


def _print(name: str, sides: dict[str, list[float]]) -> None:
    for side, (cpu, wall, ours, all_) in sides.items():
        ratio = f"  {sides['here'][0] / cpu:.2f} here" if side != "here" else ""
        print(f"{name:<24}{side:<11}{cpu:.3f} CPU s  {wall:.3f} s  {ours:.0f} of {all_:.0f} modules{ratio}", flush=True)


if __name__ == "__main__":
    main()
