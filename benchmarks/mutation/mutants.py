"""What could be wrong with a file: one small change of its syntax tree at a time."""

import ast
import copy
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

BOUNDARY = {ast.Lt: ast.LtE, ast.LtE: ast.Lt, ast.Gt: ast.GtE, ast.GtE: ast.Gt}
OPPOSITE = {
    ast.Lt: ast.GtE, ast.LtE: ast.Gt, ast.Gt: ast.LtE, ast.GtE: ast.Lt, ast.Eq: ast.NotEq, ast.NotEq: ast.Eq,
    ast.Is: ast.IsNot, ast.IsNot: ast.Is, ast.In: ast.NotIn, ast.NotIn: ast.In,
}  # fmt: skip
SWAPPED_OPERATORS = {
    ast.Add: ast.Sub, ast.Sub: ast.Add, ast.Mult: ast.Div, ast.Div: ast.Mult, ast.FloorDiv: ast.Mult, ast.Mod: ast.Mult,
    ast.BitAnd: ast.BitOr, ast.BitOr: ast.BitAnd, ast.LShift: ast.RShift, ast.RShift: ast.LShift,
}  # fmt: skip
# What is said of types or to people, and checks of the program by itself.
UNTOUCHED = (ast.Raise, ast.Assert, ast.JoinedStr, ast.Import, ast.ImportFrom, ast.pattern)
UNTOUCHED_FIELDS = ("annotation", "returns", "decorator_list", "bases", "type_params")
SYMMETRIC = ("maximum", "minimum", "fmax", "fmin", "clip")  # of numpy: the same with the first two the other way round
UNTOUCHED_KEYWORDS = ("strict", "stacklevel")
SHOWN_CHARACTERS = 100  # characters of what is around a change


@dataclass(frozen=True, slots=True)
class Mutant:
    """A changed file. What was changed is told by function and statement, which stay where lines shift."""

    path: str
    where: str
    was: str
    now: str
    line: int
    text: str

    @property
    def key(self) -> tuple[str, str, str, str]:
        """What it is known by in the list of explained ones."""
        return self.path, self.where, self.was, self.now


@dataclass(frozen=True, slots=True)
class Place:
    """A node of a tree: where it hangs, what is around it up to its statement, the nearest first, and the function."""

    node: ast.AST
    parent: ast.AST
    field: str
    index: int | None
    around: tuple[ast.AST, ...]
    where: str

    def put(self, node: ast.AST) -> None:
        """Hang another node there."""
        if self.index is None:
            setattr(self.parent, self.field, node)
        else:
            getattr(self.parent, self.field)[self.index] = node


def mutants(root: Path, path: Path) -> Iterator[Mutant]:
    """Every mutant of a file."""
    tree = ast.parse(path.read_text(encoding="utf-8"))
    for place in list(_places(tree, "", ())):
        shown = next((n for n in reversed(place.around) if len(_said(n)) <= SHOWN_CHARACTERS), place.node)
        was = _said(shown)
        for changed in _changes(place.node):
            place.put(changed)
            now = _said(changed if shown is place.node else shown)
            text = ast.unparse(ast.fix_missing_locations(tree))
            place.put(place.node)
            line = getattr(place.node, "lineno", 0)
            yield Mutant(str(path.relative_to(root)), place.where or "module", was, now, line, text)


def _places(node: ast.AST, where: str, above: tuple[ast.AST, ...]) -> Iterator[Place]:
    for field, value in ast.iter_fields(node):
        if field in UNTOUCHED_FIELDS:
            continue
        listed = value if isinstance(value, list) else [value]
        for index, child in enumerate(listed):
            if not isinstance(child, ast.AST) or isinstance(child, UNTOUCHED) or _is_docstring(child):
                continue
            if (isinstance(child, ast.keyword) and child.arg in UNTOUCHED_KEYWORDS) or _is_of_types(child):
                continue
            around = (child,) if isinstance(child, ast.stmt) else (child, *above)
            inside = f"{where}.{child.name}".lstrip(".") if isinstance(child, ast.FunctionDef | ast.ClassDef) else where
            yield Place(child, node, field, index if isinstance(value, list) else None, around, inside)
            yield from _places(child, inside, around)


def _is_docstring(node: ast.AST) -> bool:
    return isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant)


def _is_of_types(node: ast.AST) -> bool:
    return isinstance(node, ast.If) and isinstance(node.test, ast.Name) and node.test.id == "TYPE_CHECKING"


def _said(node: ast.AST) -> str:
    """A node in one line; of a compound statement its head, and what its body begins with."""
    lines = ast.unparse(node).splitlines() or [""]
    return " ".join(line.strip() for line in lines[:2])


def _changes(node: ast.AST) -> Iterator[ast.AST]:
    """What may stand in a node's place."""
    match node:
        case ast.Compare(ops=[operator]):
            for table in (BOUNDARY, OPPOSITE):
                if type(operator) in table:
                    yield _with(node, ops=[table[type(operator)]()])
        case ast.BinOp(left=left, op=operator, right=right) if not _is_text(left) and not _is_text(right):
            if type(operator) in SWAPPED_OPERATORS:
                yield _with(node, op=SWAPPED_OPERATORS[type(operator)]())
            yield left
            if isinstance(operator, ast.Add | ast.Mult):
                yield right
        case ast.BoolOp(op=operator, values=values):
            yield _with(node, op=ast.And() if isinstance(operator, ast.Or) else ast.Or())
            for dropped in range(len(values)):
                left_over = [value for index, value in enumerate(values) if index != dropped]
                yield left_over[0] if len(left_over) == 1 else _with(node, values=left_over)
        case ast.UnaryOp(op=ast.Not() | ast.USub(), operand=operand):
            yield operand
        case ast.Constant(value=bool(value)):
            yield ast.Constant(not value)
        case ast.Constant(value=int(value) | float(value)):
            yield ast.Constant(value + 1)
        case ast.Call(func=function, args=[first, second, *rest]):
            symmetric = isinstance(function, ast.Attribute) and function.attr in SYMMETRIC
            if not symmetric and not isinstance(first, ast.Starred) and not isinstance(second, ast.Starred):
                yield _with(node, args=[second, first, *rest])
        case ast.IfExp(body=body, orelse=other):
            yield body
            yield other
        case ast.comprehension(ifs=[_, *rest]):
            yield _with(node, ifs=rest)
        case ast.stmt():
            yield from _statement_changes(node)


def _statement_changes(node: ast.stmt) -> Iterator[ast.AST]:
    match node:
        case ast.If(orelse=[]):
            yield _with(node, body=[ast.Pass()])
        case ast.If(test=test):
            yield _with(node, test=ast.UnaryOp(ast.Not(), test))
        case ast.For():
            yield _with(node, iter=ast.Tuple([], ast.Load()))
        case ast.Return(value=ast.expr() as value) if not (isinstance(value, ast.Constant) and value.value is None):
            yield ast.Return(None)
        case ast.Expr() | ast.AugAssign() | ast.Continue() | ast.Break():
            yield ast.Pass()
        case ast.Assign(targets=[ast.Attribute() | ast.Subscript()]):
            yield ast.Pass()


def _is_text(node: ast.AST) -> bool:
    return isinstance(node, ast.JoinedStr) or (isinstance(node, ast.Constant) and isinstance(node.value, str))


def _with(node: ast.AST, **changed: object) -> ast.AST:
    """A shallow copy in which some fields are others."""
    other = copy.copy(node)
    for field, value in changed.items():
        setattr(other, field, value)
    return other
