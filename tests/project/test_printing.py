"""Who may print, end the program, read its arguments or ask the time: the command lines, and who is named here."""

import ast
from collections.abc import Iterator, Sequence
from pathlib import Path

import pytest

from tests.project.sources import COMPILER, ROOT, RUNTIME, modules, nodes, origins

SPEAKING = {
    *("print", "input", "exit", "quit", "SystemExit", "rich.console.Console", "click.echo", "click.secho"),
    *("sys.exit", "sys.argv", "sys.stdout", "sys.stderr", "os._exit"),
    *("contextlib.redirect_stdout", "contextlib.redirect_stderr"),
}
CLOCKS = {"datetime.datetime.now", "time.perf_counter", "time.time", "time.monotonic"}
COMMANDS = {  # of the runtime, and why each may speak
    "__main__.py": "mindrun itself",
    "terminal/standard_streams.py": "makes the streams of both programs so that none can end them",
    "robot/drive.py": "mindrun on a robot: sentences for the journal",
    "robot/processes.py": "a second Ctrl-C ends a robot, a forked child never drives, a driver's own end is no success",
    "robot/guardian/__main__.py": "the guardian, a program of its own",
    "robot/guardian/watch.py": "the process that drives ends without waiting for a driver that hangs",
    "robot/world_server.py": "the simulated world, a program of its own",
    "sim/outside/__main__.py": "python -m mindrun.sim.outside: the process that steps environments",
    "sim/outside/making.py": "what an environment's package says when it is imported is no answer of a command",
    "sim/units.py": "a unit that cannot be compiled ends the process: C, which calls it, knows no exceptions",
    "sim/warmup.py": "python -m mindrun.sim.warmup: the process that compiles",
    "cli/adopt.py": "mindrun adopt",
    "cli/calibrate.py": "mindrun calibrate",
    "cli/doctor.py": "mindrun doctor",
    "cli/order.py": "mindrun order",
    "cli/replay.py": "mindrun replay",
    "cli/report.py": "mindrun report",
    "kinds/registry.py": "catches the end that a package of somebody else's asks for",
}
PROGRAMS = {
    "executors/processes.py": "a process of a pool ends with the one that began it",
    "robot/driver_inspection.py": "a process that imports a driver of a user, whatever that does",
}
TIMED = {
    "api.py": "a lesson notes when it began, and counts its seconds",
    "executors/cluster_jobs.py": "a scheduler is asked for its workers once a second",
    "executors/jobs.py": "a job says how long it took",
    "run/setup.py": "a bench counts the seconds of its runs",
}


def said(file: Sequence[ast.AST], words: set[str]) -> Iterator[tuple[int, str]]:
    """The places where the nodes of a file use one of these names, whatever it calls them."""
    known = {}
    for each in file:
        match each:
            case ast.Import(names=names):
                known |= {alias.asname or alias.name: alias.name for alias in names}
            case ast.ImportFrom(module=str(module), names=names):
                known |= {alias.asname or alias.name: f"{module}.{alias.name}" for alias in names}
    for each in file:
        if isinstance(each, ast.Name | ast.Attribute):
            first, dot, rest = ast.unparse(each).partition(".")
            full = (known.get(first, first) + dot + rest).removeprefix("builtins.")
            if full in words:
                yield each.lineno, full


def outside(root: Path, allowed: set[str], words: set[str]) -> list[str]:
    """Where the files of a package use such a name, but for those that may."""
    files = [path for path in modules(root) if path.relative_to(root).as_posix() not in allowed]
    return [f"{path.relative_to(ROOT)}:{line} {name}" for path in files for line, name in said(nodes(path), words)]


def commands() -> set[str]:
    """The files of `mindlang/cli/`, and the programs of the compiler's own."""
    return {path.relative_to(COMPILER).as_posix() for path in modules(COMPILER / "cli")} | PROGRAMS.keys()


def test_only_the_command_line_prints_and_exits() -> None:
    assert outside(COMPILER, commands(), SPEAKING) == []


def test_only_the_command_line_and_the_notebook_ask_the_time() -> None:
    assert outside(COMPILER, commands() | TIMED.keys(), CLOCKS) == []


def test_nobody_imports_the_command_line() -> None:
    inner = [path for path in modules(COMPILER) if not path.is_relative_to(COMPILER / "cli")]
    found = {path: origins(path) for path in inner}
    assert [path for path, names in found.items() if any(name.startswith("mindlang.cli") for name in names)] == []


def test_only_the_commands_of_the_runtime_print_and_exit() -> None:
    assert outside(RUNTIME, set(COMMANDS), SPEAKING) == []


def test_every_exception_is_one() -> None:
    spoken = {path.relative_to(RUNTIME).as_posix() for path in modules(RUNTIME) if any(said(nodes(path), SPEAKING))}
    assert spoken == set(COMMANDS)
    assert [name for name in TIMED if not any(said(nodes(COMPILER / name), CLOCKS))] == []


@pytest.mark.parametrize(
    "line",
    [
        *("print(1)", "import sys\nsys.exit(1)", "from sys import argv\nargv", "import sys as s\ns.stdout.write('')"),
        *("raise SystemExit", "from rich.console import Console\nConsole()", "import os\nos._exit(1)", "input()"),
        *("import builtins\nbuiltins.print(1)", "from os import _exit as end\nend(1)"),
    ],
)
def test_the_test_would_notice(line: str) -> None:
    assert any(said([*ast.walk(ast.parse(line))], SPEAKING))
