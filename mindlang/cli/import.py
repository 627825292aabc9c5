# ruff: noqa: N999 (the word that is typed)
"""`mindc import`: files of other programs, made into those of a mind.

Examples:
  mindc import map apec2016.txt -o walls.txt
  mindc import map map.yaml -o walls.txt
"""

from pathlib import Path

import click

from mindlang.cli import Suggesting
from mindlang.cli import _terminal as terminal
from mindlang.cli._options import PATH, written


@click.group(cls=Suggesting)
def command() -> None:
    """Make files of other programs into those of a mind."""


@command.command("map")
@click.argument("file", type=PATH)
@written("-o --output", "PATH", "The text. Default: standard output.")
def import_map(file: Path, output: Path | None) -> None:
    """Make a map of FILE: the text that `contains walls is map from "walls.txt"` reads.

    FILE is a maze of a micromouse contest, drawn with + or o, - and |, S where the robot starts and G at the goal; or
    map.yaml of ROS, with its picture (PGM or PNG) beside it. What was done and rounded is said, and the lines of a
    mind in which the map stands.

    Examples:
      mindc import map apec2016.txt -o walls.txt
      mindc import map map.yaml -o walls.txt
    """
    from mindrun.errors import MindError
    from mindrun.kinds.things.map import START

    if output and output.absolute() == file.absolute():
        terminal.fail(f"{output} is what is read.", "Write another name after -o.", terminal.MISUSE)
    with terminal.refusing(terminal.MISUSE, of=MindError):
        if file.suffix.lower() in (".yaml", ".yml"):
            from mindlang.maps.ros_map import read_ros_map as read  # which takes numpy
        else:
            from mindlang.maps.maze_drawing import read_maze as read
        found = read(file)
    text = "".join(f"{line}\n" for line in found.lines)
    if output:
        terminal.write_file(output, text.encode())
    else:
        terminal.print_document(text)
    has_start = any(START in line for line in found.lines)
    anywhere = () if has_start else ("no S in it: the robot starts anywhere, or where starts at says",)
    terminal.tell(*found.said, *anywhere, *found.source(output.name if output else "walls.txt"))
