"""`mindc check`: is everything in these files right?"""

from __future__ import annotations

import sys
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import click

if TYPE_CHECKING:
    from mindlang.compiler.compile import Compiled
    from mindlang.compiler.diagnostic import Diagnostic

EXAMPLES = """\b
Examples:
  mindc check collect.mind
  mindc check examples/*.mind --json
  mindc check collect.break                        against collect.mind beside it
  mindc check collect.mind wheels.break --task Collect
  cat collect.mind | mindc check -
"""


@dataclass(frozen=True, slots=True)
class _Checked:
    """A file, what is wrong with it, and whether it could be read and is whole."""

    file: str
    diagnostics: Sequence[Diagnostic]
    is_readable: bool
    is_whole: bool = True


@click.command(epilog=EXAMPLES)
@click.argument("files", nargs=-1, required=True, metavar="FILE…")
@click.option("--task", metavar="TASK", help="What .break files are about. Default: the task of mindc run.")
@click.option("--json", "as_json", is_flag=True, help="One JSON document instead: mindc check collect.mind --json")
def command(files: tuple[str, ...], task: str | None, as_json: bool) -> None:
    """Read files, and report everything that is wrong in them.

    A file that is no whole mind is read with those that use it, where they are given as well.
    Of procedures the text is read, and nothing is run.
    Breakpoints, NAME.break, are held against the mind that is given with them, or else against NAME.mind beside them.
    Ends with 0 when nothing is wrong, with 1 when something is, with 2 when a file cannot be read.
    """
    from mindlang.breakpoints import SUFFIX
    from mindlang.cli._diagnostic_printer import as_data, print_report
    from mindlang.cli._terminal import FINDINGS, MISUSE, OK, console, print_json, take_back
    from mindlang.editing.neighbours import minds

    for file in files:
        take_back(file)
    breaks = [file for file in files if Path(file).suffix == SUFFIX]
    if task and not breaks:
        raise click.UsageError("--task is for files of breakpoints, and none is given.")
    compiled = minds(file for file in files if file not in breaks)
    checked = [*_minds(compiled), *_breakpoints(breaks, compiled, task)]
    found = [diagnostic for each in checked for diagnostic in each.diagnostics]
    if as_json:
        files_data = [{"file": each.file, "ok": each.is_whole and not each.diagnostics} for each in checked]
        print_json({"files": files_data, "diagnostics": [as_data(diagnostic) for diagnostic in found]})
    elif found:
        print_report(found, console(stderr=True))
        click.echo(f"{len(found)} mistake{'s' if len(found) > 1 else ''}", err=True)
    else:
        click.echo("nothing wrong", err=True)
    sys.exit(MISUSE if not all(each.is_readable for each in checked) else FINDINGS if found else OK)


def _minds(compiled: Mapping[str, Compiled]) -> Iterator[_Checked]:
    from mindlang.compiler.procedures import mistakes

    for file, each in compiled.items():
        yield _Checked(file, (*each.diagnostics, *mistakes(each)), each.readable, bool(each.graph))


def _breakpoints(files: Sequence[str], given: Mapping[str, Compiled], task: str | None) -> Iterator[_Checked]:
    """The files of breakpoints; it is said where one is held against no mind."""
    if not files:
        return
    from mindlang.breakpoints.checking import check_breakpoints, mind_of
    from mindlang.cli._terminal import MISUSE, fail, talk
    from mindlang.run.setup import SetupError

    for file in dict.fromkeys(files):
        mind = mind_of(file, given)
        if mind is None:
            hint = f"mindc check NAME.mind {file} looks for the names in it, too"
            talk.print(f"note: {file} is read without a mind that compiles, line by line; {hint}", markup=False)
        try:
            found = check_breakpoints(file, mind, task)
        except SetupError as error:
            fail(str(error), error.hint, MISUSE)
        yield _Checked(file, found.diagnostics, all(each.span for each in found.diagnostics))
