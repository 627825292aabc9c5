"""The project's own source files, and what they import."""

import ast
from collections.abc import Container, Iterator
from functools import cache
from pathlib import Path

ROOT = Path(__file__).parents[2]
COMPILER, RUNTIME = ROOT / "mindlang", ROOT / "runtime" / "mindrun"


def modules(*folders: Path) -> list[Path]:
    """Every Python file below the folders."""
    found = sorted(path for folder in folders for path in folder.rglob("*.py"))
    assert found
    return found


@cache
def tree(path: Path) -> ast.Module:
    """The syntax tree of a file."""
    return ast.parse(path.read_text(encoding="utf-8"), str(path))


@cache
def nodes(path: Path) -> tuple[ast.AST, ...]:
    """All nodes of the syntax tree of a file: many tests go through the same files."""
    return tuple(ast.walk(tree(path)))


@cache
def imports(path: Path) -> tuple[ast.Import | ast.ImportFrom, ...]:
    """The imports of a file, even inside its functions."""
    return tuple(node for node in nodes(path) if isinstance(node, ast.Import | ast.ImportFrom))


@cache
def imported(path: Path) -> frozenset[str]:
    """The full names of all modules that a file imports anywhere."""
    return frozenset(_names(path))


def _names(path: Path) -> Iterator[str]:
    for node in imports(path):
        match node:
            case ast.Import(names=names):
                yield from (alias.name for alias in names)
            case ast.ImportFrom(module=str(module)):
                yield module


def arrows(*folders: Path) -> dict[str, set[str]]:
    """For each module below the folders, those among them that it imports anywhere; all by their dotted names."""
    named = {_dotted(path, folder.parent): path for folder in folders for path in modules(folder)}
    return {
        name: {_known(full, named) for full in origins(path)} & named.keys() - {name} for name, path in named.items()
    }


def _dotted(path: Path, above: Path) -> str:
    return ".".join(path.relative_to(above).with_suffix("").parts).removesuffix(".__init__")


def origins(path: Path) -> Iterator[str]:
    """What a file imports, with the names that it takes from modules."""
    for node in imports(path):
        match node:
            case ast.Import(names=names):
                yield from (alias.name for alias in names)
            case ast.ImportFrom(module=str(module), names=names):
                yield from (f"{module}.{alias.name}" for alias in names)


def _known(full: str, named: Container[str]) -> str:
    """The module that is meant: `mindrun.graph.graph` by `mindrun.graph.graph.Graph`."""
    return full if full in named else full.rpartition(".")[0]


def package(module: str) -> str:
    """The package at the beginning of a module's name."""
    return module.partition(".")[0]
