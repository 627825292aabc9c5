"""Sources that nobody meant well, through the whole compiler: python -m benchmarks.fuzz --count 1000000 --log FILE.

Every case ends in a graph or in messages, within 2 seconds and 1 GiB; formatted, it means the same; and what an editor
asks about it is answered. A run that was ended goes on where its log ends. What is found stands in the log.
`--of examples/maze/maze.mind …` makes mutants of these files alone, `--within 1` says how many seconds each may take.
"""

import argparse
import resource
import shutil
import signal
import sys
import time
import traceback
from collections import Counter
from collections.abc import Callable, Sequence
from pathlib import Path
from random import Random
from tempfile import TemporaryDirectory

from mindrun.files.printable import visible

from benchmarks.sources import mutant_of, source
from mindlang.cli._diagnostic_printer import as_data, plain
from mindlang.compiler.comparison import mind_differences
from mindlang.compiler.compile import Compiled, compile_source
from mindlang.compiler.format import format_splices, formatted
from mindlang.compiler.source import Source, spliced
from mindlang.lint.lint import lint
from mindlang.lock.report import rows
from mindlang.lock.status import NotLearning, status
from mindlang.proofs.proof import prove
from mindlang.server.completing import complete
from mindlang.server.hovering import hover
from mindlang.server.proposals import all_mended, mendings
from mindlang.server.questions import definitions, highlights, outline, references
from mindlang.server.server import EditorSession
from mindlang.server.workspace import Workspace

CPU_SECONDS = 2.0  # seconds of the processor
CASE_SECONDS = 30.0  # after which a case is ended
MAX_MEMORY_KIB = 1 << 20  # KiB of memory, of all that ran before, too
BLOCK_CASES = 1000  # cases between two lines of the log
PARTS = {
    "parts.mind": "tick 1/60 s\nsensor eye is range_finder at 0 90 deg\nsensor charge is battery\n",
    "loop.mind": 'use "loop.mind"\n',
}


Part = Callable[["Place", Compiled, str, Random], None]


class UnsoundError(Exception):
    """Something that must hold of every case, and does not."""


class Place:
    """The folder in which the cases stand, with the files that some of them use, and what stands beside the `minds`."""

    def __init__(self, folder: Path, minds: Sequence[Path] = ()) -> None:
        self.folder = folder.resolve()
        self.main = self.folder / "case.mind"
        self.minds = [mind.read_text(encoding="utf-8") for mind in minds]
        for beside in (path for mind in minds for path in mind.parent.iterdir() if path.suffix in (".mind", ".txt")):
            shutil.copy(beside, self.folder)
        self.texts = {self.folder / name: text for name, text in PARTS.items()}
        for path, text in self.texts.items():
            path.write_text(text, encoding="utf-8")

    def source(self, case: int) -> str:
        """The text of a case: a mutant of one of the minds, where there are any."""
        return mutant_of(self.minds, case) if self.minds else source(case)

    def compiled(self, text: str) -> Compiled:
        """A text compiled as the folder's main file."""
        return compile_source(Source("case.mind", text, self.folder), self.main, self.texts)


def must(holds: bool, what: str) -> None:
    """UnsoundError, with what does not hold."""
    if not holds:
        raise UnsoundError(what)


def check(place: Place, case: int, text: str) -> str:
    """Everything that must hold of a case; "right" or "wrong", as the compiler finds it."""
    found = place.compiled(text)
    must((found.graph is None) == bool(found.diagnostics), "a graph or messages")
    for each in found.diagnostics[:2]:
        must(all(visible(line) == line for line in plain(each).split("\n")), "messages can be printed")
        must(bool(as_data(each)["code"]), "messages have a code")
    random = Random(case)
    for part, one_in in SHARES.items():
        if random.randrange(one_in) == 0:
            part(place, found, text, random)
    return "wrong" if found.graph is None else "right"


def _format(place: Place, found: Compiled, text: str, random: Random) -> None:
    once = formatted(text)
    must(formatted(once) == once, "what is formatted is formatted to itself")
    after = place.compiled(once)
    codes = sorted(each.code for each in found.diagnostics), sorted(each.code for each in after.diagnostics)
    must(codes[0] == codes[1], f"what is formatted means the same: {codes}")
    must(found.graph == after.graph, "what is formatted has the same graph")
    if found.mind and after.mind:
        must(not mind_differences(found.mind, after.mind), "what is formatted does not differ")


def _lint(place: Place, found: Compiled, text: str, random: Random) -> None:
    for each in lint(found):
        must(plain(each) != "", "findings can be printed")
        if each.fix and each.fix.is_safe:
            after = place.compiled(spliced(found.sources[0], each.fix.splices))
            must(after.graph is not None, f"{each.fix.title} breaks nothing")


def _status(place: Place, found: Compiled, text: str, random: Random) -> None:
    if found.graph:
        rows(found.graph, [each.path for each in found.sources])


def _prove(place: Place, found: Compiled, text: str, random: Random) -> None:
    if found.graph and all(isinstance(each, NotLearning) for each in status(found.graph, {}).values()):
        prove(found.graph, {}, 0.01)


def _answers(place: Place, found: Compiled, text: str, random: Random) -> None:
    """What an editor asks about three places."""
    path, wire = place.main, EditorSession()
    workspace = Workspace({**place.texts, path: text})
    view = workspace.view(path)
    for each in view.findings:
        wire.diagnostic(each)
    if file := view.file(path):
        for declaration in file.declarations:
            outline(wire, declaration)
    all_mended(view, path, workspace.texts)
    format_splices(Source("case.mind", text, place.folder))
    for _ in range(3):
        offset = random.randrange(len(text) + 1)
        hover(view, path, offset)
        complete(view, path, text, offset)
        definitions(view, path, offset)
        references(workspace, view, path, offset, with_declaration=False)
        highlights(view, path, offset)
        list(mendings(view, path, offset, offset))


SHARES: dict[Part, int] = {_format: 6, _lint: 3, _status: 12, _prove: 40, _answers: 40}  # one in so many cases


def ran(place: Place, case: int, within: float) -> tuple[str, str, float]:
    """What became of a case in a word, what there is to say of it, and how long it took in seconds of the processor."""
    begin = time.process_time()
    signal.setitimer(signal.ITIMER_PROF, CASE_SECONDS)
    try:
        became = check(place, case, place.source(case))
    except Exception as error:
        last = traceback.extract_tb(error.__traceback__)[-1]
        where = f"{Path(last.filename).name}:{last.lineno}"
        return type(error).__name__, f"{where} {error}"[:300], time.process_time() - begin
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0)
    taken = time.process_time() - begin
    if taken > within:
        return "Slow", f"{taken:.1f} s", taken
    if (memory := resource.getrusage(resource.RUSAGE_SELF).ru_maxrss) > MAX_MEMORY_KIB:
        return "Large", f"{memory >> 10} MiB", taken
    return became, "", taken


def run(cases: range, minds: Sequence[Path], within: float, tell: Callable[[str], None]) -> Counter[str]:
    """The cases one by one; what became of how many of them."""
    signal.signal(signal.SIGPROF, _ended)
    total: Counter[str] = Counter()
    slowest = 0.0
    with TemporaryDirectory() as folder:
        place = Place(Path(folder), minds)
        for case in cases:
            became, why, taken = ran(place, case, within)
            total[became] += 1
            slowest = max(slowest, taken)
            if why:
                tell(f"found {case} {became} {why!r}")
            if (case + 1 - cases.start) % BLOCK_CASES == 0 or case + 1 == cases.stop:
                tell(f"done {case + 1} {time.process_time():.0f} s, slowest {slowest:.2f} s, {dict(total)}")
    return total


def _ended(*_: object) -> None:
    raise TimeoutError(f"longer than {CASE_SECONDS:g} s")


def ended_at(log: Path) -> int | None:
    """The case at which an earlier run of a log was ended."""
    lines = log.read_text(encoding="utf-8").splitlines() if log.exists() else []
    return next((int(line.split()[1]) for line in reversed(lines) if line.startswith("done ")), None)


def main() -> None:
    """Run, and end with 1 where something was found."""
    parser = argparse.ArgumentParser(allow_abbrev=False, description=__doc__)
    parser.add_argument("--from", dest="start", type=int, default=0, help="the first case")
    parser.add_argument("--count", type=int, default=10_000)
    parser.add_argument("--of", type=Path, nargs="+", default=(), help="make mutants of these files alone")
    parser.add_argument("--within", type=float, default=CPU_SECONDS, help="seconds of the processor for a case")
    parser.add_argument("--log", type=Path, help="what is written on, and where a run goes on that was ended")
    options = parser.parse_args()
    begin = (options.log and ended_at(options.log)) or options.start
    cases = range(begin, options.start + options.count)
    with options.log.open("a", buffering=1, encoding="utf-8") if options.log else sys.stdout as log:
        total = run(cases, options.of, options.within, lambda line: print(line, file=log))
    sys.exit(1 if total.keys() - {"right", "wrong"} else 0)


if __name__ == "__main__":
    main()
