"""The project's own source files, and what they import."""

import ast
from collections.abc import Container, Iterator
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


def arrows(*folders: Path) -> dict[str, set[str]]:
    """For each module below the folders, those among them that it imports anywhere; all by their dotted names."""
    named = {_dotted(path, folder.parent): path for folder in folders for path in modules(folder)}
    return {
        name: {_known(full, named) for full in _origins(path)} & named.keys() - {name} for name, path in named.items()
    }


def _dotted(path: Path, above: Path) -> str:
    return ".".join(path.relative_to(above).with_suffix("").parts).removesuffix(".__init__")


def _origins(path: Path) -> Iterator[str]:
    """What a file imports, with the names that it takes from modules."""
    for node in ast.walk(tree(path)):
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
