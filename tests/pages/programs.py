"""The program that the Python of a page is, and what it needs that is not installed here."""

import ast
from collections.abc import Iterable, Iterator
from importlib.util import find_spec


def runnable(parts: Iterable[str]) -> tuple[str, list[str]]:
    """The parts of a page one after the other, without those that import what is not here; and what that is."""
    known = [(part, [name for name in _imported(part) if find_spec(name) is None]) for part in parts]
    missing = sorted({name for _, names in known for name in names})
    return "\n".join(part for part, names in known if not names), missing


def _imported(code: str) -> Iterator[str]:
    """The packages that a part imports, and the extra that one of ours is made for."""
    for node in ast.walk(ast.parse(code)):
        match node:
            case ast.Import(names=names):
                modules = [name.name for name in names]
            case ast.ImportFrom(module=str(module)):
                modules = [module]
            case _:
                continue
        yield from (EXTRAS.get(module, module.partition(".")[0]) for module in modules)


EXTRAS = {"mindlang.torch": "torch", "mindlang.environments": "gymnasium"}
