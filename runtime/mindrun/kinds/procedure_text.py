"""Checks of a procedure's module by its text alone: that the function is there, how many numbers it takes and returns.

The function is looked for as `from` names it: `claw.grip` is `grip` in claw.py.
"""

import ast
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import lru_cache
from symtable import symtable
from warnings import catch_warnings

from mindrun.errors import ProcedureError
from mindrun.kinds.procedure_names import ModuleNames, drawn, opened

FUNCTIONS = ast.FunctionDef | ast.AsyncFunctionDef
STANDS_ALONE = "A module stands alone: write what it needs into it."
NOT_USED = f'{STANDS_ALONE} A file of data may be beside it: add uses "policy.pt" to the skill.'
FILES = "files/"  # before the path of a file, where it stands among modules

Sources = Mapping[str, str | bytes]  # the text of each module by dotted name, and FILES and the path of each file used


@dataclass(frozen=True, slots=True)
class FunctionSignature:
    """The signature of a plain function: it takes `least` to `most` numbers (None: any number).

    `returned` are the lines of `return` and how many values each gives, where that can be seen.
    """

    least: int
    most: int | None
    returned: tuple[tuple[int, int], ...]
    line: int


def module_of(calls: str) -> str:
    """The dotted name of the module of a function `module.function`."""
    return calls.rpartition(".")[0]


def file_of(from_: str) -> str:
    """The file in which a procedure stands."""
    return f"{from_.rpartition('.')[0].replace('.', '/')}.py"


@lru_cache(16)
def examine(from_: str, source: str, has_files: bool = False) -> FunctionSignature | None:
    """The function's signature, None where only running could tell; ProcedureError where it can be no procedure."""
    try:
        return _examined(from_, source, has_files)
    except RecursionError:
        raise fault(from_, "its module is nested too deep") from None


def _examined(from_: str, source: str, has_files: bool) -> FunctionSignature | None:
    names, name = parsed(from_, source), from_.rpartition(".")[2]
    tree = names.tree
    functions = [node for node in _own(tree) if isinstance(node, FUNCTIONS) and node.name == name]
    given = _given(tree)
    if not functions and not given & {name, "*"}:
        raise fault(from_, "its module has no such function")
    for line, by in drawn(names):
        hint = "Draw from a generator of its own, with a seed: random.Random(1). Each run then begins with it anew."
        raise fault(from_, f"its module draws from {by}, so no run could be made again", line, hint)
    for line, by in () if has_files else opened(names):
        raise fault(from_, f"its module looks for a file with {by}, and no bundle holds one", line, NOT_USED)
    if len(functions) != 1 or name in given:
        return None
    [function] = functions
    inside = list(_own(function))
    if isinstance(function, ast.AsyncFunctionDef):
        hint = f"Write def {name} without async."
        raise fault(from_, "is async, and a procedure answers at once", function.lineno, hint)
    if any(isinstance(node, ast.Yield | ast.YieldFrom) for node in inside):
        raise fault(from_, "yields, and a procedure returns", function.lineno, "Write return instead of yield.")
    return None if function.decorator_list else _signature(function, inside)


def fit(from_: str, source: str, inputs: int, outputs: int, has_files: bool = False) -> None:
    """Raise ProcedureError where the function cannot take so many readings, or return so many numbers."""
    shape = examine(from_, source, has_files)
    if shape is None or outputs == 0:
        return
    if inputs < shape.least or (shape.most is not None and inputs > shape.most):
        takes = "any number of" if shape.most is None else f"{shape.most}" if shape.most == shape.least else ""
        takes = takes or f"{shape.least} to {shape.most}"
        message = f"takes {takes} number{'' if takes == '1' else 's'}, and the skill reads {inputs}"
        hint = (
            "Each reading is an argument of its own, those of a wide sensor one after the other; *readings takes all."
        )
        raise fault(from_, message, shape.line, hint)
    for line, count in shape.returned:
        if count != outputs:
            message = f"returns {count} values, and the skill needs {outputs}"
            hint = "Return one number for each line drives or influences without at, in their order."
            raise fault(from_, message, line, hint)


def fault(from_: str, message: str, line: int = 0, hint: str = "") -> ProcedureError:
    """An error about a procedure, with the file and the line."""
    where = f" ({file_of(from_)}, line {line})" if line else ""
    return ProcedureError(f"procedure from {from_}: {message}{where}", hint)


@lru_cache(16)
def parsed(from_: str, source: str) -> ModuleNames:
    """The names in the text of a procedure's module; ProcedureError where it is no Python."""
    try:
        with catch_warnings(action="ignore"):
            compile(source, file_of(from_), "exec")  # finds more than the parser does: return outside of a function
            return ModuleNames(ast.parse(source), symtable(source, file_of(from_), "exec"))
    except SyntaxError as error:
        raise fault(from_, f"SyntaxError: {error.msg}", error.lineno or 1) from error
    except (ValueError, RecursionError, MemoryError) as error:
        raise fault(from_, f"it is no Python that can be read: {error or 'nested too deep'}") from error


def _given(tree: ast.Module) -> set[str]:
    """Every name that is assigned or imported anywhere, `*` where a star import may bind any."""
    names: set[str] = set()
    for node in ast.walk(tree):
        match node:
            case ast.Name(id=name, ctx=ast.Store()) | ast.ClassDef(name=name):
                names.add(name)
            case ast.Import(names=aliases) | ast.ImportFrom(names=aliases):
                names |= {(alias.asname or alias.name).split(".")[0] for alias in aliases}
    return names


def _own(scope: ast.AST) -> Iterator[ast.AST]:
    """The nodes of a module or a function, without those of functions and classes inside it."""
    left = list(ast.iter_child_nodes(scope))
    while left:
        node = left.pop()
        yield node
        if not isinstance(node, FUNCTIONS | ast.ClassDef | ast.Lambda):
            left.extend(ast.iter_child_nodes(node))


def _signature(function: ast.FunctionDef, inside: list[ast.AST]) -> FunctionSignature:
    given = function.args
    plain = len(given.posonlyargs) + len(given.args)
    returned = []
    for node in inside:
        match node:
            case ast.Return(value=ast.Tuple(elts=parts) | ast.List(elts=parts)):
                if not any(isinstance(part, ast.Starred) for part in parts):
                    returned.append((node.lineno, len(parts)))
            case ast.Return(value=None) | ast.Return(value=ast.Constant(value=None)):
                returned.append((node.lineno, 0))
    if not any(isinstance(node, ast.Return | ast.Raise) for node in inside):
        returned.append((function.lineno, 0))
    most = None if given.vararg else plain
    return FunctionSignature(plain - len(given.defaults), most, tuple(returned), function.lineno)
