"""`mindc check`: is everything in these files right?"""

import sys

import click

EXAMPLES = """\b
Examples:
  mindc check collect.mind
  mindc check examples/*.mind --json
  cat collect.mind | mindc check -
"""


@click.command(epilog=EXAMPLES)
@click.argument("files", nargs=-1, required=True, metavar="FILE…")
@click.option("--json", "as_json", is_flag=True, help="One JSON document instead: mindc check collect.mind --json")
def command(files: tuple[str, ...], as_json: bool) -> None:
    """Read files, and report everything that is wrong in them.

    A file that is no whole mind is read with those that use it, where they are given as well.
    Of procedures the text is read, and nothing is run.
    Ends with 0 when nothing is wrong, with 1 when something is, with 2 when a file cannot be read.
    """
    from mindlang.cli._diagnostic_printer import as_data, print_report
    from mindlang.cli._terminal import FINDINGS, MISUSE, OK, console, print_json, take_back
    from mindlang.compiler.procedures import mistakes
    from mindlang.editing.neighbours import minds

    for file in files:
        take_back(file)
    compiled = minds(files)
    each = {file: (*result.diagnostics, *mistakes(result)) for file, result in compiled.items()}
    found = [diagnostic for diagnostics in each.values() for diagnostic in diagnostics]
    if as_json:
        print_json(
            {
                "files": [{"file": file, "ok": bool(compiled[file].graph) and not each[file]} for file in compiled],
                "diagnostics": [as_data(diagnostic) for diagnostic in found],
            }
        )
    elif found:
        print_report(found, console(stderr=True))
        click.echo(f"{len(found)} mistake{'s' if len(found) > 1 else ''}", err=True)
    else:
        click.echo("nothing wrong", err=True)
    readable = all(result.readable for result in compiled.values())
    sys.exit(MISUSE if not readable else FINDINGS if found else OK)
