"""The public names of a package as a page of reference: signatures and docstrings, read from the sources."""

import ast
import re
from collections.abc import Iterator
from inspect import cleandoc, getsource, isclass, isroutine
from textwrap import dedent
from types import ModuleType

from mindrun.numbers import arrays
from mindrun.numbers.short_repr import ShortRepr

LINE_CHARACTERS = 100  # of a signature
ARGUMENT = re.compile(r", (?=\w+[:=]|\*)")  # before the next one: no comma of a type
ARRAYS = {  # what the sources call arrays, written out
    node.targets[0].id: ast.unparse(node.value)
    for node in ast.parse(getsource(arrays)).body
    if isinstance(node, ast.Assign) and isinstance(node.targets[0], ast.Name)
    if ast.unparse(node.value).startswith("NDArray[")
}
NAMED_ARRAY = re.compile(rf"\b({'|'.join(ARRAYS)})\b")
Function = ast.FunctionDef | ast.AsyncFunctionDef


def python_reference(package: ModuleType) -> Iterator[str]:
    """The lines of a package's chapter: each public name with its signature, its fields and its methods."""
    yield from (f"## `{package.__name__}`", "")
    for name in package.__all__:
        value = getattr(package, name)
        if isclass(value) or isroutine(value):
            (node,) = ast.parse(dedent(getsource(value))).body
            yield from (f"### `{package.__name__}.{name}`", "")
            yield from _class(node) if isinstance(node, ast.ClassDef) else _function(node)


def _class(node: ast.ClassDef) -> Iterator[str]:
    bases = ", ".join(name for name in map(ast.unparse, node.bases) if name != ShortRepr.__name__)  # how it is printed
    fields = [ast.unparse(each) for each in node.body if isinstance(each, ast.AnnAssign) and _is_public(each.target)]
    yield from _code(
        f"class {node.name}({bases})" if bases else f"class {node.name}", *(f"    {each}" for each in fields)
    )
    yield from _documented(node)
    for each in node.body:
        if isinstance(each, Function) and _is_public(each):
            yield from (f"#### `{node.name}.{each.name}`", "")
            yield from _function(each)


def _function(node: ast.AST) -> Iterator[str]:
    """A function with its decorators, of which property and staticmethod say how it is called."""
    if isinstance(node, Function):
        said = [f"@{ast.unparse(each)}" for each in node.decorator_list if isinstance(each, ast.Name)]
        result = f" -> {ast.unparse(node.returns)}" if node.returns else ""
        yield from _code(*said, *_signature(node.name, ast.unparse(node.args), result))
        yield from _documented(node)


def _signature(name: str, arguments: str, result: str) -> Iterator[str]:
    """In one line, or where that is too long a line for each argument."""
    line = f"def {name}({arguments}){result}"
    if len(line) <= LINE_CHARACTERS:
        yield line
        return
    yield f"def {name}("
    yield from (f"    {each}," for each in ARGUMENT.split(arguments))
    yield f"){result}"


def _documented(node: Function | ast.ClassDef) -> Iterator[str]:
    """What it says; an example as one types it into Python stands between fences."""
    for paragraph in cleandoc(ast.get_docstring(node) or "").split("\n\n"):
        if paragraph.startswith(">>> "):
            yield from ("```pycon", paragraph, "```", "")
        elif paragraph:
            yield from (paragraph, "")


def _code(*lines: str) -> Iterator[str]:
    yield from ("```python", *(NAMED_ARRAY.sub(lambda found: ARRAYS[found[0]], line) for line in lines), "```", "")


def _is_public(node: ast.AST) -> bool:
    match node:
        case ast.Name(id=name) | ast.FunctionDef(name=name) | ast.AsyncFunctionDef(name=name):
            return not name.startswith("_")
    return False
