"""`mindc check`: is everything in these files right?

Examples:
  mindc check collect.mind
  mindc check .
  mindc check examples/*.mind --json
  mindc check collect.break                    against collect.mind beside it
  mindc check collect.mind wheels.break --task Collect
  mindc check day.break ball.bundle            on the robot that it drives
  cat collect.mind | mindc check -
"""

import sys
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import click
from mindrun.terminal.command_line import command_line

from mindlang.breakpoints import SUFFIX
from mindlang.cli._diagnostic_printer import as_data
from mindlang.cli._options import SKILLS, TASKS, files_of, in_files, json_flag, named
from mindlang.cli._terminal import FINDINGS, MISUSE, OK, is_asked, print_json, print_report, refusing, tell
from mindlang.compiler.diagnostic import Diagnostic, distinct

if TYPE_CHECKING:
    from mindlang.compiler.compile import Compiled


@dataclass(frozen=True, slots=True)
class _Checked:
    """A file, what is wrong with it, and whether it could be read and is whole."""

    file: str
    diagnostics: Sequence[Diagnostic]
    is_readable: bool
    is_whole: bool = True


@click.command
@click.argument("files", nargs=-1, required=True, metavar="FILE_OR_FOLDER…")
@named("--task", "TASK", TASKS, "What .break files are about. Default: as of mindc run.")
@named("--master", "SKILL", SKILLS, "Who is in charge then. Default: as of mindc run.")
@json_flag("One JSON document instead: mindc check collect.mind --json")
def command(files: tuple[str, ...], task: str | None, master: str | None) -> None:
    """Read files, and report everything that is wrong in them.

    A folder is the .mind and .break files in it and below; hidden folders, runs and build are left out.
    A file that is no whole mind is read with those that use it, where they are given as well.
    Of procedures the text is read, and nothing is run.
    Breakpoints, NAME.break, are held against the mind that is given with them, or else against NAME.mind beside them;
    with the BUNDLE that drives a robot, against what it will record (with --task in a dry run).
    Ends with 0 when nothing is wrong, with 1 when something is, with 2 when a file cannot be read.
    """
    from mindlang.editing.neighbours import minds

    named = files_of(files, ".mind", SUFFIX)
    breaks = [file for file in named if Path(file).suffix == SUFFIX]
    if (task or master) and not breaks:
        raise click.UsageError("--task and --master are for files of breakpoints, and none is given.")
    bundles = [file for file in named if breaks and Path(file).suffix == ".bundle"]
    compiled = minds(file for file in named if file not in (*breaks, *bundles))
    checked = [_Checked(file, each.diagnostics, each.readable, bool(each.graph)) for file, each in compiled.items()]
    checked += [*_breakpoints(breaks, bundles, compiled, task, master)]
    found = distinct(diagnostic for each in checked for diagnostic in each.diagnostics)
    _note_speeds(compiled)
    if is_asked("as_json"):
        of_files = [{"file": each.file, "ok": each.is_whole and not each.diagnostics} for each in checked]
        print_json({"files": of_files, "diagnostics": [as_data(diagnostic) for diagnostic in found]})
    elif found:
        print_report(found)
        click.echo(f"{len(found)} mistake{'s' if len(found) > 1 else ''}{in_files(files, named)}", err=True)
    else:
        click.echo(f"nothing wrong{in_files(files, named)}", err=True)
    sys.exit(MISUSE if not all(each.is_readable for each in checked) else FINDINGS if found else OK)


def _note_speeds(compiled: "Mapping[str, Compiled]") -> None:
    """Say which robots are so fast that a tick of theirs cannot be simulated whole."""
    from mindlang.lint.top_speed import farthest_step, simulated_step

    for file, each in compiled.items():
        if each.graph and (far := farthest_step(each.graph))[0] > (most := simulated_step(each.graph)):
            moves = f"its robot moves {far[0]:.3g} units in a tick of {far[1]} at full thrust"
            hint = f"{command_line('mindc', 'lint', Path(file))} says what helps"
            tell(f"note: {file}: {moves}; beside a wall {most:.3g} of them are simulated; {hint}")


def _breakpoints(
    files: Sequence[str], bundles: Sequence[str], given: "Mapping[str, Compiled]", task: str | None, master: str | None
) -> Iterator[_Checked]:
    """The files of breakpoints, each against every bundle, or else a mind; it is said where there is neither."""
    if not files:
        return
    if bundles:
        from mindrun.graph.bundle import read_bundle  # which needs numpy

    from mindlang.breakpoints.resolve import load_breakpoints
    from mindlang.breakpoints.subject import mind_of, subject_of_bundle, subject_of_mind

    for file in dict.fromkeys(files):
        mind = None if bundles else mind_of(file, given)
        with refusing(MISUSE):
            subjects = [subject_of_bundle(read_bundle(Path(path)), task, master) for path in bundles]
            subjects += [subject_of_mind(mind, task, master)] if mind else []
        if not subjects:
            hint = f"{command_line('mindc', 'check', 'NAME.mind', Path(file))} looks for the names in it, too"
            tell(f"note: {file} is read without a mind that compiles, line by line; {hint}")
        for subject in subjects or (None,):
            found = load_breakpoints(file, subject).diagnostics
            yield _Checked(file, found, all(each.span for each in found))
