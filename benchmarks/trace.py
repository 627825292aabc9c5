"""What writing a run down costs: python benchmarks/trace.py [ROUNDS].

Collect of examples/collect, 30,000 ticks in one lane: without a trace, with one in arrays, and as the command
`mindc run` without and with `--trace`, in turns; CPU seconds, and the medians of the ratios.
"""

import resource
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from statistics import median

from mindlang.compiler.compile import load
from mindlang.run.recorded_run import record_run
from mindlang.run.setup import NO_GENOME, set_up

MINDC = (sys.executable, "-c", "from mindlang.cli import main; main()")
COLLECT = Path(__file__).resolve().parent.parent / "examples" / "collect" / "collect.mind"
RUN_SEED = 3


def arrays() -> tuple[Callable[[], object], Callable[[], object]]:
    """A run in this process, without and with its rows."""
    setup = set_up(str(COLLECT), load(COLLECT), "Collect", None)
    rollout = setup.rollout()
    rollout.compile()
    return lambda: rollout.score(NO_GENOME, [RUN_SEED]), lambda: record_run(setup, rollout, RUN_SEED)


def commands(folder: Path) -> tuple[Callable[[], object], Callable[[], object]]:
    """The command that a user types."""
    plain = [*MINDC, "run", str(COLLECT), "--task", "Collect", "--seed", str(RUN_SEED), "-q"]
    traced = [*plain, "--trace", str(folder / "run.csv")]
    return lambda: _run(plain), lambda: _run(traced)


def main() -> None:
    """Measure and print."""
    rounds = int(sys.argv[1]) if len(sys.argv) > 1 else 7
    with tempfile.TemporaryDirectory() as folder:
        for name, sides in {"in arrays": arrays(), "as a command": commands(Path(folder))}.items():
            pairs = [(_seconds(sides[0]), _seconds(sides[1])) for _ in range(rounds + 1)][1:]
            plain, traced = (median(side) for side in zip(*pairs, strict=True))
            ratio = median(after / before for before, after in pairs)
            print(f"{name:14} {plain:.3f} s, with a trace {traced:.3f} s: {ratio:.2f} times")


def _run(command: list[str]) -> None:
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)


def _seconds(work: Callable[[], object]) -> float:
    """CPU seconds of this process and of those that it waited for."""
    before = time.process_time() + _of_children()
    work()
    return time.process_time() + _of_children() - before


def _of_children() -> float:
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


if __name__ == "__main__":
    main()
