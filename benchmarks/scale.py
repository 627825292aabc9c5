"""Seconds and memory of parse, check, lint and fmt, up to 10,000 skills: python benchmarks/scale.py [--json].

Each is a process of its own, from its start to its end; parse is timed inside one, by itself, in MB of source a second.
"""

import os
import subprocess
import sys
import time
from pathlib import Path

from benchmarks.edits import tree
from benchmarks.sizes import measure_sizes

PROGRAM = "from mindlang.cli import main; main()"
PARSE = """
import gc, sys, time
from pathlib import Path
from mindlang.cli import GARBAGE_COLLECTION_OBJECTS, YOUNG_COLLECTIONS
from mindlang.compiler.diagnostic import Findings
from mindlang.compiler.parse import parse
from mindlang.compiler.source import Source
gc.set_threshold(GARBAGE_COLLECTION_OBJECTS, YOUNG_COLLECTIONS)
text = Path(sys.argv[1]).read_text()
parse(Source("warm", text[:2000]), Findings())
begin = time.perf_counter()
parse(Source("big", text), Findings())
print(time.perf_counter() - begin)
"""


def run(arguments: list[str]) -> tuple[float, float, str]:
    """Seconds, MiB and what is printed by a Python process."""
    begin = time.perf_counter()
    process = subprocess.Popen([sys.executable, "-c", *arguments], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
    assert process.stdout
    said = process.stdout.read().decode()
    _, status, usage = os.wait4(process.pid, 0)
    assert os.waitstatus_to_exitcode(status) in (0, 1), arguments
    return time.perf_counter() - begin, usage.ru_maxrss / 1024, said


def measured(skills: int, folder: Path) -> dict[str, float]:
    """All figures of one size."""
    path = folder / "big.mind"
    path.write_text(tree(skills), encoding="utf-8")
    _, memory, seconds = run([PARSE, str(path)])
    found = {
        "skills": skills,
        "kB": path.stat().st_size / 1e3,
        "parse s": float(seconds),
        "parse MB/s": path.stat().st_size / 1e6 / float(seconds),
        "parse MiB": memory,
    }
    for name in ("check", "lint", "fmt"):
        found[f"{name} s"], found[f"{name} MiB"], _ = run([PROGRAM, name, str(path), *["--check"] * (name == "fmt")])
    return found


if __name__ == "__main__":
    measure_sizes(__doc__, [1250, 2500, 5000, 10_000], measured)
