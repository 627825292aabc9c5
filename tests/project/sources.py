"""The project's own source files, and what they import."""

import ast
from collections.abc import Iterator
from pathlib import Path

ROOT = Path(__file__).parents[2]
COMPILER, RUNTIME = ROOT / "mindlang", ROOT / "runtime" / "mindrun"


def modules(*folders: Path) -> list[Path]:
    """Every Python file below the folders."""
    found = sorted(path for folder in folders for path in folder.rglob("*.py"))
    assert found
    return found


def tree(path: Path) -> ast.Module:
    """The syntax tree of a file."""
    return ast.parse(path.read_text(encoding="utf-8"), str(path))


def imported(path: Path) -> set[str]:
    """The full names of all modules that a file imports anywhere, even inside its functions."""
    return set(_names(ast.walk(tree(path))))


def _names(nodes: Iterator[ast.AST]) -> Iterator[str]:
    for node in nodes:
        match node:
            case ast.Import(names=names):
                yield from (alias.name for alias in names)
            case ast.ImportFrom(module=str(module)):
                yield module


def package(module: str) -> str:
    """The package at the beginning of a module's name."""
    return module.partition(".")[0]
