"""What every command takes for files twice and four times as long, in many shapes: python -m benchmarks.doubling.

Printed are the milliseconds for LINES, twice and four times as many, and how much more the second doubling adds than
the first: 2 is linear, 4 is quadratic. Only what is above 2.8 is printed.
"""

import argparse
import gc
import re
import time
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from io import StringIO
from pathlib import Path
from tempfile import TemporaryDirectory

from mindrun.graph.codec import encode
from rich.console import Console

from benchmarks.call_count import CallCount
from benchmarks.shapes import SHAPES
from mindlang.cli._diagnostic_printer import as_data
from mindlang.cli._terminal import print_report
from mindlang.cli.status import report
from mindlang.compiler.comparison import mind_differences
from mindlang.compiler.compile import Compiled, compile_source
from mindlang.compiler.drawing import dot, tree
from mindlang.compiler.format import format_splices, formatted
from mindlang.compiler.source import Source
from mindlang.editing.apply import apply_edit
from mindlang.editing.edits import edit
from mindlang.editing.project import EditError, open_project
from mindlang.editing.summary import diff, summarise
from mindlang.editing.unified_diff import unified
from mindlang.lint.lint import apply_safe_fixes, lint
from mindlang.lock.report import rows
from mindlang.proofs.proof import prove
from mindlang.server.changing import perform
from mindlang.server.completing import complete
from mindlang.server.hovering import hover
from mindlang.server.proposals import Selection, all_mended, mendings, proposals
from mindlang.server.questions import definitions, highlights, matching_declarations, outline, references
from mindlang.server.server import EditorSession

LINEAR_RATIO = 2.8  # what shapes with names of more digits, or that change into one another, come to by themselves
_EVEN = re.compile(r"(?<![\d.])\d*[02468](?![\d.])")  # not in 0.5


class Case:
    """A text as the main file of a folder of its own, compiled once."""

    def __init__(self, folder: Path, text: str) -> None:
        self.path, self.text = folder.resolve() / "mind.mind", text
        self.path.write_text(text, encoding="utf-8")
        self.compiled = self.compile(text)

    def compile(self, text: str) -> Compiled:
        """A text compiled as this file."""
        return compile_source(Source("mind.mind", text, self.path.parent), self.path)

    def session(self) -> EditorSession:
        """An editor that has the file open, and has been told what is found in it."""
        session = EditorSession()
        session.set(self.path.as_uri(), 1, self.text)
        list(session.news())
        return session


def _lint(case: Case) -> None:
    lint(case.compiled)


def _fix(case: Case) -> None:
    apply_safe_fixes(case.compiled.sources[0], lambda source: lint(case.compile(source.text)))


def _check(case: Case) -> None:
    print_report(case.compile(case.text).diagnostics, Console(file=StringIO()))


def _json(case: Case) -> None:
    [as_data(each) for each in case.compiled.diagnostics]


def _show(case: Case) -> None:
    if case.compiled.mind:
        Console(file=StringIO()).print(tree(case.compiled.mind))
        dot(case.compiled.mind)
        encode(case.compiled.graph)


def _status(case: Case) -> None:
    if case.compiled.graph:
        console = Console(file=StringIO())
        console.print(report(rows(case.compiled.graph, [case.path]), console))


def _prove(case: Case) -> None:
    if case.compiled.graph:
        with suppress(KeyError):  # weights that are not there
            prove(case.compiled.graph, {}, 0.01)


def _diff(case: Case) -> None:
    """Against the text with a 9 before each even number: names that differ by their numbers still do."""
    other = case.compile(_EVEN.sub(r"9\g<0>", case.text))
    if case.compiled.mind and other.mind:
        mind_differences(case.compiled.mind, other.mind)


def _fmt(case: Case) -> None:
    unified("mind.mind", case.text, formatted(case.text))


def _edits(*names: str) -> Callable[[Case], None]:
    said: Mapping[str, dict[str, object]] = {
        "rename": {"old": "eye", "new": "other", "noun": "sensor"},
        "remove": {"what": ("sensor", "s1")},
        "encapsulate": {"skill": "Go", "new": "Above", "reads": ("eye",)},
        "connect": {"skill": "Go", "target": "mood"},
        "add": {"lines": ("sensor new is battery",)},
    }

    def made(case: Case) -> None:
        if case.compiled.graph:
            project = open_project(case.compiled)
            for name in names:
                with suppress(EditError):
                    edited = apply_edit(project, edit(name).function(project, **said[name]), keep_weights=False)
                    summarise(edited)
                    diff(edited)

    return made


def _opened(case: Case) -> None:
    case.session()


def _asked(case: Case) -> None:
    """Every question at the first declaration and at the end."""
    workspace = case.session().workspace
    view = workspace.view(case.path)
    for offset in (case.text.find("eye") + 1, len(case.text)):
        hover(view, case.path, offset)
        complete(view, case.path, case.text, offset)
        definitions(view, case.path, offset)
        references(workspace, view, case.path, offset, with_declaration=True)
        highlights(view, case.path, offset)


def _acted(case: Case) -> None:
    """What an editor can do about all that is found, and at the master."""
    session = case.session()
    workspace = session.workspace
    view = workspace.view(case.path)
    for _, fix in mendings(view, case.path, 0, len(case.text)):
        session.workspace_edit(fix.splices, {})
    all_mended(view, case.path, workspace.texts)
    if case.compiled.graph:
        at = max(case.text.find("skill Go"), 0)
        proposals(Selection(open_project(case.compiled), case.path, at, at))
        with suppress(EditError):
            outcome = perform(workspace, case.path, "rename", {"old": "eye", "new": "other", "noun": "sensor"})
            session.workspace_edit(outcome.change.splices, {})


def _outlined(case: Case) -> None:
    session = case.session()
    if file := session.workspace.view(case.path).file(case.path):
        for declaration in file.declarations:
            outline(session, declaration)
    matching_declarations(session.workspace, [case.path.parent], "g")
    for splice in format_splices(Source("mind.mind", case.text, case.path.parent)):
        session.text_edit(splice)


COMMANDS: Mapping[str, Callable[[Case], None]] = {
    "check": _check,
    "check --json": _json,
    "lint": _lint,
    "lint --fix": _fix,
    "fmt": _fmt,
    "show": _show,
    "status": _status,
    "prove": _prove,
    "diff": _diff,
    "edit": _edits("rename", "remove", "encapsulate", "connect", "add"),
    "lsp: open": _opened,
    "lsp: ask": _asked,
    "lsp: act": _acted,
    "lsp: outline": _outlined,
}


def seconds(command: str, shape: str, lines: int) -> float:
    """What a command takes of the processor for a shape of so many lines."""
    with TemporaryDirectory() as folder:
        case = Case(Path(folder), SHAPES[shape](lines))
        gc.collect()
        begin = time.process_time()
        COMMANDS[command](case)
        return time.process_time() - begin


def calls(command: str, shape: str, lines: int) -> int:
    """How many functions a command calls for a shape of so many lines: its work, on any machine."""
    with TemporaryDirectory() as folder:
        case = Case(Path(folder), SHAPES[shape](lines))
        COMMANDS[command](case)  # what is remembered from now on
        with CallCount() as count:
            COMMANDS[command](case)
    return count.number


def growth(figures: Sequence[float]) -> float:
    """How much more the second doubling adds than the first: 2 where it is linear, 4 where it is quadratic."""
    first, second, third = figures
    return (third - second) / max(second - first, third / 10)


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(allow_abbrev=False, description=__doc__)
    parser.add_argument("--lines", type=int, default=1000)
    parser.add_argument("--only", default="", help="shapes whose names hold this")
    parser.add_argument("--calls", action="store_true", help="count calls of functions instead of milliseconds")
    parser.add_argument("--all", action="store_true", help="also what is linear")
    options = parser.parse_args()
    for shape in SHAPES:
        for command in COMMANDS if options.only in shape else ():
            measure = calls if options.calls else lambda *of: 1000 * seconds(*of)
            taken = [measure(command, shape, factor * options.lines) for factor in (1, 2, 4)]
            is_slow = growth(taken) > LINEAR_RATIO and taken[2] > 50
            if options.all or is_slow:
                figures = "".join(f"{each:10.0f}" for each in taken)
                print(f"{shape:32}{command:14}{figures}{growth(taken):8.1f}{' !' * is_slow}", flush=True)


if __name__ == "__main__":
    main()
