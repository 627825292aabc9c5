"""What is typed in a terminal, held against the programs: whether there is such a command, with such options."""

import re
import shlex
import subprocess
import sys
from collections.abc import Iterator
from functools import cache
from itertools import takewhile
from pathlib import Path
from unittest.mock import patch

import click
from distributed.cli import dask_scheduler, dask_worker
from mindrun.cli import driving_parser, tool_parser, tools

from mindlang.cli import commands
from tests.project.sources import ROOT

JOINTS = re.compile(r"^(?:[|&;]+|\(|\))$")
ASSIGNED = re.compile(r"^(\w+)=(.*)$")


def typed(text: str) -> list[str]:
    """The lines of a terminal that somebody types: those behind `$ `, or where there are none, all but comments.

    One that ends in a backslash goes on in the next.
    """
    lines = [line for line in re.sub(r"\\\n *", "", text).splitlines() if line and not line.startswith("#")]
    return [line[2:] for line in lines if line.startswith("$ ")] or lines


def program_of(words: list[str]) -> str:
    """The name of the program that is called."""
    first = next((word for word in words if not ASSIGNED.match(word)), "export")
    return Path(first).name or first


def calls(line: str) -> Iterator[list[str]]:
    """The words of each program that a line begins, without comments, without where what it prints goes."""
    lexer = shlex.shlex(line, posix=True, punctuation_chars=True)
    lexer.whitespace_split = True
    words: list[str] = []
    for word in [*lexer, ";"]:
        if not JOINTS.match(word):
            words.append(word)
            continue
        if words:
            yield list(takewhile(lambda each: each not in (">", ">>"), words))
        words = []


def refused(words: list[str]) -> str:
    """Why a program would not take these words, empty where it would or is not known here."""
    match [word for word in words if not ASSIGNED.match(word) or word.startswith("-")]:
        case ["podman", "run", *rest] if "mind" in rest:
            return refused(["mindc", *rest[rest.index("mind") + 1 :]])
        case [program, *rest] if Path(program).name in PROGRAMS:
            return PROGRAMS[Path(program).name](words[words.index(program) + 1 :])
    return ""


def _of_mindc(words: list[str]) -> str:
    return _of_click(commands, words)


def _of_click(command: click.Command, words: list[str]) -> str:
    """As the program reads them; what it would do with them is left out."""
    with patch.object(click.Command, "invoke", lambda *_: None):
        try:
            command.main(list(words), standalone_mode=False)
        except click.ClickException as misuse:
            return misuse.format_message()
    return ""


def _of_mindrun(words: list[str]) -> str:
    is_tool = bool(words) and words[0] in tools()
    parser = tool_parser(words[0]) if is_tool else driving_parser()
    try:
        parser.parse_args(words[is_tool:])
    except SystemExit as stop:
        return f"{parser.prog} ends with {stop.code}" if stop.code else ""
    return ""


def _of_dask(words: list[str]) -> str:
    programs = {"scheduler": dask_scheduler.main, "worker": dask_worker.main}
    return _of_click(programs[words[0]], words[1:])


def _of_make(words: list[str]) -> str:
    text = (ROOT / "Makefile").read_text(encoding="utf-8")
    known = re.findall(r"^([\w-]+):|^(\w+) \?=", text, re.MULTILINE)
    asked = [word.partition("=")[0] for word in words]
    return ", ".join(word for word in asked if not any(word in names for names in known))


def _of_python(words: list[str]) -> str:
    """A script or module of the project, with options that stand in its help."""
    match words:
        case ["-m", module, *options] if module.startswith("benchmarks."):
            script = ROOT.joinpath(*module.split("."))
            script = script / "__main__.py" if script.is_dir() else script.with_suffix(".py")
        case [path, *options] if path.endswith(".py"):
            script = ROOT / path
        case _:
            return ""
    if not script.exists():
        return f"there is no {script.name}"
    said = script.read_text(encoding="utf-8")
    asked = [word for word in options if word.startswith("--") and f'"{word}"' not in said]
    said = _help(script) if asked else ""  # where another file says which there are
    return ", ".join(word for word in asked if f" {word}" not in said)


@cache
def _help(script: Path) -> str:
    done = subprocess.run([sys.executable, script, "--help"], cwd=ROOT, capture_output=True, text=True, check=False)
    return done.stdout


def _of_sh(words: list[str]) -> str:
    return "" if (ROOT / words[0]).exists() else f"there is no {words[0]}"


PROGRAMS = {
    "mindc": _of_mindc,
    "mindrun": _of_mindrun,
    "dask": _of_dask,
    "make": _of_make,
    "python": _of_python,
    "python3": _of_python,
    "sh": _of_sh,
}


def is_known(said: str) -> bool:
    """Whether a program has the command that a sentence names, and the options, whatever is left out of the rest."""
    program, *words = said.split()
    options = {word.partition("=")[0] for word in words if word.startswith("--")} - {"--help", "--version"}
    if program == "mindrun":
        parser = tool_parser(words[0]) if words[0] in tools() else driving_parser()
        return options <= {name for action in parser._actions for name in action.option_strings}
    command: click.Command | None = commands
    while isinstance(command, click.Group) and words and words[0].islower() and not words[0].startswith("-"):
        command = command.get_command(click.Context(command), words.pop(0))
    return command is not None and options <= {
        name for each in command.params for name in (*each.opts, *each.secondary_opts)
    }
