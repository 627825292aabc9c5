"""`mindc robot`: a robot.yaml to fill in.

Examples:
  mindc robot collect.mind
  mindc robot collect.mind -o robot.yaml
"""

from pathlib import Path

import click
from mindrun.terminal.command_line import command_line

from mindlang.cli import _terminal as terminal
from mindlang.cli._options import written


@click.command
@click.argument("file")
@written("-o --output", "PATH", "The file, which is not there yet: -o robot.yaml. Default: standard output.")
def command(file: str, output: Path | None) -> None:
    """Write a robot.yaml for FILE, with pins to fill in.

    `mindc build FILE --robot robot.yaml` says what is still missing. Another driver can be written instead:
    `mindc kinds driver` lists them.
    """
    from mindlang.robot.to_fill_in import robot_yaml

    _, graph = terminal.load_compiled(file).whole
    text, count = robot_yaml(graph, Path(file).stem if file != "-" else "robot")
    if output is None:
        terminal.print_document(text)
    elif output.exists():
        terminal.fail(f"{output} is there: nothing is overwritten.", "Take another name.", terminal.MISUSE)
    else:
        terminal.write_file(output, text.encode())
    where, bundle = output or Path("robot.yaml"), Path(file).with_suffix(".bundle")
    words = "mindc", "build", Path(file), "--robot", where, "-o", bundle
    terminal.tell(f"{count} values to fill in, of which {command_line(*words)} says which are missing")
