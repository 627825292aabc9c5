"""`mindc lint`: what is wrong in these files, and what is hardly meant.

Examples:
  mindc lint collect.mind
  mindc lint .
  mindc lint *.mind --ignore untaught-skill,unread-sensor
  mindc lint collect.mind --fix
  mindc lint examples/collect/*.mind --format sarif > lint.sarif
"""

import sys
from collections.abc import Sequence
from os.path import realpath
from pathlib import Path
from typing import TYPE_CHECKING

import click
from click.shell_completion import CompletionItem

from mindlang.cli._diagnostic_printer import as_data
from mindlang.cli._options import files_of, flag, in_files, named
from mindlang.cli._terminal import FINDINGS, MISUSE, OK, console, fail, print_json, print_report, refusing
from mindlang.compiler.diagnostic import Diagnostic, distinct

if TYPE_CHECKING:
    from mindlang.lint.settings import LintSettings

FORMATS = ("text", "json", "github", "sarif")


def _rules(context: click.Context, parameter: click.Parameter, begun: str) -> list[CompletionItem]:
    """Completions of the last of several codes with commas between them."""
    from mindlang.lint.rules import all_rules

    before, comma, last = begun.rpartition(",")
    return [CompletionItem(f"{before}{comma}{code}") for code in all_rules() if code.startswith(last)]


@click.command
@click.argument("files", nargs=-1, required=True, metavar="FILE_OR_FOLDER…")
@flag("--fix", "Make the fixes that never change what the robot does.")
@named("--select", "CODES", _rules, "Only these rules: --select unread-sensor,edge-at-zero", multiple=True)
@named("--ignore", "CODES", _rules, "Not these rules: --ignore untaught-skill", multiple=True)
@click.option("--format", "as_", type=click.Choice(FORMATS), default="text", show_default=True, help="Of the findings.")
def command(files: tuple[str, ...], fix: bool, select: tuple[str, ...], ignore: tuple[str, ...], as_: str) -> None:
    """Report what is wrong in files, and what is hardly meant so.

    A folder is the .mind files in it and below. `mindc explain CODE` says why. `# noqa: CODE` at the end of a line
    silences it there, mind.toml in whole files or everywhere (docs/lint.md). Ends with 0 when nothing was found, with 1
    when something was, with 2 when a file cannot be read.
    """
    from mindlang.editing.neighbours import minds
    from mindlang.lint.lint import lint_file

    if fix and "-" in files:
        fail("Standard input cannot be mended.", "Leave --fix out, or save it as a file.", MISUSE)
    selected, ignored = _codes(select), _codes(ignore)
    named = files_of(files, ".mind")
    with refusing():
        done = [
            lint_file(file, compiled, _settings(file).codes(Path(realpath(file)), selected, ignored), fix)
            for file, compiled in minds(named).items()
        ]
    found = distinct(diagnostic for each in done for diagnostic in each.diagnostics)
    _print(found, as_)
    if as_ == "text":
        click.echo(_summary(found, sum(each.fixed for each in done)) + in_files(files, named), err=True)
    sys.exit(MISUSE if not all(each.readable for each in done) else FINDINGS if found else OK)


def _settings(file: str) -> "LintSettings":
    """The settings that count for a file; what is wrong in them ends the program."""
    from mindlang.lint.settings import settings_of

    found = settings_of(Path(realpath(file)))
    if found.wrong:
        print_report(found.wrong)
        sys.exit(MISUSE)
    return found


def _codes(said: Sequence[str]) -> list[str]:
    """The codes of an option; one that is none ends the program."""
    from mindlang.lint.settings import why_no_rule

    codes = [code for text in said for code in text.replace(",", " ").split()]
    if said and not codes:
        fail("No rule is named.", "Write for example --select unread-sensor.", MISUSE)
    for code in codes:
        if why := why_no_rule(code):
            fail(*why, MISUSE)
    return codes


def _print(found: Sequence[Diagnostic], as_: str) -> None:
    match as_:
        case "text":
            print_report(found, console())
        case "json":
            print_json({"diagnostics": [as_data(each) for each in found]})
        case "github":
            from mindlang.lint.formats import annotations

            click.echo("".join(annotations(found)), nl=False)
        case "sarif":
            from mindlang.lint.formats import sarif

            print_json(sarif(found))


def _summary(found: Sequence[Diagnostic], made: int) -> str:
    fixable = sum(1 for each in found if each.fix and each.fix.is_safe)
    parts = [f"{len(found)} finding{'s' * (len(found) != 1)}" if found else "nothing found"]
    parts += [f"{made} fixed"] if made else []
    parts += [f"{fixable} can be mended with --fix"] if fixable else []
    return ", ".join(parts)
