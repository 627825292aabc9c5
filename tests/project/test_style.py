"""Ruff and mypy are content, and every file and function is short enough to be read at once."""

import ast
import subprocess
import sys
from pathlib import Path

import pytest

from tests.project.sources import COMPILER, ROOT, RUNTIME, modules, tree

LONGEST_FILE, LONGEST_FUNCTION = 400, 60


@pytest.mark.parametrize("command", ["ruff check .", "ruff format --check .", "mypy"])
def test_the_checkers_are_content(command: str) -> None:
    done = subprocess.run([sys.executable, "-m", *command.split()], capture_output=True, text=True, cwd=ROOT)
    assert done.returncode == 0, done.stdout + done.stderr


def test_no_file_is_long() -> None:
    lengths = {path: len(path.read_text(encoding="utf-8").splitlines()) for path in modules(COMPILER, RUNTIME)}
    assert {path.name: length for path, length in lengths.items() if length > LONGEST_FILE} == {}


def test_no_function_is_long() -> None:
    lengths = {name: length for path in modules(COMPILER, RUNTIME) for name, length in functions(path)}
    assert {name: length for name, length in lengths.items() if length > LONGEST_FUNCTION} == {}


def functions(path: Path) -> list[tuple[str, int]]:
    """The name of each function of a file, and how many lines it has."""
    return [
        (f"{path.name}: {node.name}", (node.end_lineno or 0) - node.lineno + 1)
        for node in ast.walk(tree(path))
        if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef)
    ]


@pytest.mark.parametrize("package", [COMPILER, RUNTIME])
def test_the_annotations_are_there_for_others(package: Path) -> None:
    assert (package / "py.typed").is_file()
