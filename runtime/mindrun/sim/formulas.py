"""Procedures that are formulas: arithmetic with floats, which compiled code can do as Python does, to the last bit.

A formula is written anew for numba from its text; only the sign of a zero may differ, which nothing in it can tell.
Nothing in it can raise or reach beyond its numbers: where Python would raise, the new one sets `wrong[0]` and goes on,
and whoever sees that asks Python for the reason. What is more than a formula is none here, and runs in Python.
"""

import ast
import builtins
import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from enum import Enum
from types import BuiltinFunctionType, FunctionType
from typing import Any, NoReturn

import numba
import numpy as np
from numba import types
from numba.np.unsafe.ndarray import to_fixed_tuple

from mindrun.numbers.arithmetic import F
from mindrun.sim import exact

EXACT_INTEGERS = 2**53  # whole numbers up to here are floats
MAX_POWER = 64
OPERATORS: Mapping[type[ast.operator], str] = {ast.Add: "+", ast.Sub: "-", ast.Mult: "*"}
COMPARISONS: Mapping[type[ast.cmpop], str] = {
    ast.Lt: "<", ast.LtE: "<=", ast.Gt: ">", ast.GtE: ">=", ast.Eq: "==", ast.NotEq: "!=",
}  # fmt: skip
# the lane in which it fails or −1; inputs, outputs, lanes, the distance between rows in floats
SIGNATURE = types.intp(types.CPointer(types.float32), types.CPointer(types.float32), types.intp, types.intp)


class NoFormulaError(Exception):
    """A procedure is more than arithmetic with floats; the text says where."""


class Kind(Enum):
    """The type of a term in Python: a float, a whole number or a float, a truth."""

    FLOAT, NUMBER, TRUTH = range(3)


@dataclass(frozen=True, slots=True)
class Term:
    """A term of the new text. Where it is a whole number, it is at most `size` from 0; `whole` is which, if known."""

    text: str
    kind: Kind
    size: int = 1
    whole: int | None = None

    @property
    def number(self) -> "Term":
        """The term as a number, for calculating: a truth becomes 1 or 0."""
        return Term(f"(1.0 if {self.text} else 0.0)", Kind.NUMBER) if self.kind is Kind.TRUTH else self

    @property
    def truth(self) -> str:
        """The term as a truth."""
        return self.text if self.kind is Kind.TRUTH else f"({self.text} != 0.0)"


def named(name: str) -> str:
    """The name of a variable in the new text."""
    return f"v_{name}"


def refuse(node: ast.AST) -> NoReturn:
    """Raise NoFormulaError, which says what is more than arithmetic."""
    text = ast.unparse(node).split("\n")[0]
    said = text if len(text) <= 40 else f"{text[:39]}…"
    raise NoFormulaError(f"`{said}` in line {getattr(node, 'lineno', '?')} is more than arithmetic with floats")


def constant(value: Any, node: ast.expr) -> Term:
    """The term of a constant; NoFormulaError where it is neither a truth nor an exact number."""
    match value:
        case bool():
            return Term(str(value), Kind.TRUTH)
        case int() if abs(value) <= EXACT_INTEGERS:
            return Term(f"({float(value)!r})", Kind.NUMBER, abs(value), value)
        case float():
            return Term({"inf": "INF", "-inf": "(-INF)", "nan": "NAN"}.get(repr(value), f"({value!r})"), Kind.FLOAT)
    return refuse(node)


def unary(op: ast.unaryop, term: Term, node: ast.expr) -> Term:
    """The term of a unary operation: a sign, or `not`."""
    match op:
        case ast.Not():
            return Term(f"(not {term.truth})", Kind.TRUTH)
        case ast.USub() | ast.UAdd():
            sign, number = "-" if isinstance(op, ast.USub) else "+", term.number
            whole = None if term.whole is None else -term.whole if sign == "-" else term.whole
            return replace(number, text=f"({sign}{number.text})", whole=whole)
    return refuse(node)


def binary(op: ast.operator, left: Term, right: Term, node: ast.expr) -> Term:
    """The term of an operation on two numbers; NoFormulaError where whole ones may not stay exact."""
    a, b = left.number, right.number
    if isinstance(op, ast.Pow):
        if b.whole is None or abs(b.whole) > MAX_POWER:
            refuse(node)
        text, size = f"power(wrong, {a.text}, {b.text})", a.size ** abs(b.whole)
        if a.kind is Kind.FLOAT or b.whole < 0:
            return Term(text, Kind.FLOAT)
        return Term(text, Kind.NUMBER, size) if size <= EXACT_INTEGERS else refuse(node)
    if isinstance(op, ast.Div):
        return Term(f"divide(wrong, {a.text}, {b.text})", Kind.FLOAT)
    if isinstance(op, ast.Mod):
        text, size = f"modulo(wrong, {a.text}, {b.text})", b.size
    elif type(op) in OPERATORS:
        text = f"({a.text} {OPERATORS[type(op)]} {b.text})"
        size = a.size * b.size if isinstance(op, ast.Mult) else a.size + b.size
    else:
        refuse(node)
    if Kind.FLOAT in (a.kind, b.kind):
        return Term(text, Kind.FLOAT)
    return Term(text, Kind.NUMBER, size) if size <= EXACT_INTEGERS else refuse(node)


def alike(terms: Sequence[Term]) -> list[str]:
    """The texts of terms of which any may be taken: as truths where all are, else as numbers."""
    are_truths = all(term.kind is Kind.TRUTH for term in terms)
    return [term.text if are_truths else term.number.text for term in terms]


def either(text: str, *terms: Term) -> Term:
    """The term of a text that gives any of several terms."""
    kinds = {term.kind for term in terms}
    return Term(text, kinds.pop() if len(kinds) == 1 else Kind.NUMBER, max(term.size for term in terms))


Known = dict[str, Term]  # the variables that surely have a value


def compile_formula(function: Callable[..., Any], source: str, inputs: int, outputs: int) -> Any:
    """A C function (keep it alive; `.address`) that runs a function of a module's text in every lane.

    NoFormulaError where it is no formula, or numba cannot compile it.
    """
    plain = formula(function, source, inputs, outputs)
    try:
        return numba.cfunc(SIGNATURE)(_looped(exact.exactly(plain), inputs, outputs))
    except Exception as error:  # numba fails in many ways, and whatever it cannot compile runs in Python
        raise NoFormulaError(str(error).split("\n")[0]) from error


def _looped(one: Any, inputs: int, outputs: int) -> Callable[..., int]:
    def loop(source: Any, target: Any, lanes: int, stride: int) -> int:
        values = numba.carray(source, (inputs, stride))
        results = numba.carray(target, (outputs, stride))
        given, wrong = np.empty(inputs), np.zeros(1, np.int64)
        for k in range(lanes):
            sound = True
            for j in range(inputs):
                given[j] = values[j, k]
                sound = sound and given[j] - given[j] == 0.0
            if sound:  # nobody is asked for what is not sent
                result = one(wrong, *to_fixed_tuple(given, inputs))
                if wrong[0]:
                    return k
                for q, value in enumerate(result):
                    results[q, k] = F(value)
        return -1

    return loop


def formula(function: Callable[..., Any], source: str, inputs: int, outputs: int) -> Callable[..., Any]:
    """A function rewritten for numba, of `wrong` and inputs, that returns a tuple. NoFormulaError if it is none."""
    try:
        tree = ast.parse(source)
        definition = _definition(function, tree)
        text = Translation(function, tree, definition, outputs).text(inputs)
    except RecursionError:
        raise NoFormulaError("it is nested too deep") from None
    made: dict[str, Any] = dict(exact.OPERATIONS)
    exec(compile(text, "<formula>", "exec"), made)
    return made["formula"]  # type: ignore[no-any-return]


def _definition(function: Callable[..., Any], tree: ast.Module) -> ast.FunctionDef:
    if isinstance(function, FunctionType) and function.__closure__ is None:
        code = function.__code__
        for node in ast.walk(tree):
            if isinstance(node, ast.FunctionDef) and (node.name, node.lineno) == (code.co_name, code.co_firstlineno):
                return node
    raise NoFormulaError("it is no plain function of its module")


class Translation:
    """The translation of one function into a formula."""

    def __init__(
        self, function: Callable[..., Any], tree: ast.Module, definition: ast.FunctionDef, outputs: int
    ) -> None:
        self._globals: Mapping[str, Any] = getattr(function, "__globals__", {})
        self._tree, self._definition, self._outputs = tree, definition, outputs
        names = [node for node in ast.walk(definition) if isinstance(node, ast.Name)]
        self._parameters = [argument.arg for argument in (*definition.args.posonlyargs, *definition.args.args)]
        self._locals = {*self._parameters, *(node.id for node in names if not isinstance(node.ctx, ast.Load))}

    def text(self, inputs: int) -> str:
        """The text of the new function."""
        given = self._definition.args
        if given.vararg or given.kwarg or given.kwonlyargs or given.defaults or len(self._parameters) != inputs:
            raise NoFormulaError(f"it does not take just {inputs} numbers")
        if self._definition.decorator_list:
            raise NoFormulaError("it is decorated")
        lines, known = self._block(
            self._definition.body, {name: Term(named(name), Kind.FLOAT) for name in self._parameters}
        )
        if known is not None:
            raise NoFormulaError("it does not always return something")
        head = ", ".join(["wrong", *map(named, self._parameters)])
        return "\n ".join([f"def formula({head}):", *lines])

    def _block(self, statements: Sequence[ast.stmt], known: Known) -> tuple[list[str], Known | None]:
        """The lines of statements, and the variables known after them; None where nothing comes after."""
        lines, now = ["pass"], dict(known)
        for statement in statements:
            match statement:
                case ast.Pass() | ast.Expr(value=ast.Constant()):
                    pass
                case ast.Assign(targets=[target], value=value):
                    lines.append(self._assigned(target, value, now))
                case ast.AnnAssign(target=ast.Name() as target, value=ast.expr() as value):
                    lines.append(self._assigned(target, value, now))
                case ast.AugAssign(target=ast.Name(id=name) as target, op=op, value=value):
                    old = ast.copy_location(ast.Name(name, ast.Load()), target)
                    lines.append(self._assigned(target, ast.copy_location(ast.BinOp(old, op, value), value), now))
                case ast.Return(value=ast.expr() as value):
                    return [*lines, f"return {self._returned(value, now)}"], None
                case ast.Raise():
                    return [*lines, *self._raised()], None
                case ast.Assert(test=test):
                    lines += [f"if not {self._term(test, now).truth}:", *(f" {line}" for line in self._raised())]
                case ast.If():
                    branches, after = self._branches(statement, now)
                    lines += branches
                    if after is None:
                        return lines, None
                    now = after
                case _:
                    refuse(statement)
        return lines, now

    def _branches(self, statement: ast.If, known: Known) -> tuple[list[str], Known | None]:
        test = self._term(statement.test, known).truth
        first, then = self._block(statement.body, known)
        second, otherwise = self._block(statement.orelse, known)
        lines = [f"if {test}:", *(f" {line}" for line in first), "else:", *(f" {line}" for line in second)]
        if then is None or otherwise is None:
            return lines, then if otherwise is None else otherwise
        both = [(name, term, otherwise[name]) for name, term in then.items() if name in otherwise]
        return lines, {
            name: either(a.text, a, b) for name, a, b in both if a.kind is b.kind or Kind.TRUTH not in (a.kind, b.kind)
        }

    def _assigned(self, target: ast.expr, value: ast.expr, known: Known) -> str:
        targets, values = [target], [value]
        if isinstance(target, ast.Tuple) and isinstance(value, ast.Tuple) and len(target.elts) == len(value.elts):
            targets, values = target.elts, value.elts
        names = [each.id if isinstance(each, ast.Name) else refuse(target) for each in targets]
        terms = [self._term(each, known) for each in values]
        known |= {name: replace(term, text=named(name), whole=None) for name, term in zip(names, terms, strict=True)}
        return f"{', '.join(map(named, names))}, = {', '.join(term.text for term in terms)},"

    def _returned(self, value: ast.expr, known: Known) -> str:
        parts = value.elts if isinstance(value, ast.Tuple | ast.List) else [value]
        if len(parts) != self._outputs:
            raise NoFormulaError(f"line {value.lineno} does not return {self._outputs} numbers")
        return f"({', '.join(self._term(part, known).number.text for part in parts)},)"

    def _raised(self) -> list[str]:
        return ["wrong[0] = 1", f"return ({'0.0, ' * self._outputs})"]

    def _term(self, node: ast.expr, known: Known) -> Term:
        match node:
            case ast.Constant(value=value):
                return constant(value, node)
            case ast.Name(id=name) if name in self._locals:
                return known[name] if name in known else refuse(node)
            case ast.Name() | ast.Attribute():
                return constant(self._object(node), node)
            case ast.UnaryOp(op=op, operand=operand):
                return unary(op, self._term(operand, known), node)
            case ast.BinOp(left=left, op=op, right=right):
                return binary(op, self._term(left, known), self._term(right, known), node)
            case ast.BoolOp(op=op, values=values):
                word = " and " if isinstance(op, ast.And) else " or "
                terms = [self._term(value, known) for value in values]
                return either(f"({word.join(alike(terms))})", *terms)
            case ast.Compare(left=left, ops=ops, comparators=others) if all(type(op) in COMPARISONS for op in ops):
                first, *rest = (self._term(each, known).number.text for each in (left, *others))
                compared = (f" {COMPARISONS[type(op)]} {text}" for op, text in zip(ops, rest, strict=True))
                return Term(f"({first}{''.join(compared)})", Kind.TRUTH)
            case ast.IfExp(test=test, body=body, orelse=orelse):
                condition, *both = (self._term(each, known) for each in (test, body, orelse))
                return either(f"({f' if {condition.truth} else '.join(alike(both))})", *both)
            case ast.Call(func=func, args=args, keywords=[]):
                return self._call(self._object(func), [self._term(each, known) for each in args], node)
        return refuse(node)

    def _call(self, called: Any, terms: Sequence[Term], node: ast.expr) -> Term:
        numbers = [term.number for term in terms]
        texts = [number.text for number in numbers]
        if called is float and len(terms) == 1:
            return Term(texts[0], Kind.FLOAT)
        if called is abs and len(terms) == 1:
            return replace(numbers[0], text=f"abs({texts[0]})", whole=None)
        if (called is max or called is min) and len(terms) > 1:
            text = texts[0]
            for other in texts[1:]:
                text = f"{'larger' if called is max else 'smaller'}({text}, {other})"
            return either(text, *numbers)
        if len(terms) == 1 and isinstance(called, BuiltinFunctionType) and called in exact.MATH:
            return Term(f"{exact.MATH[called]}(wrong, {texts[0]})", Kind.FLOAT)
        return refuse(node)

    def _object(self, node: ast.expr) -> Any:
        """The object that a name stands for outside the function; NoFormulaError where that can change."""
        match node:
            case ast.Attribute(value=ast.Name() as of, attr=attribute) if self._object(of) is math:
                return getattr(math, attribute, None)
            case ast.Name(id=name) if name not in self._locals:
                if name not in self._globals:
                    return getattr(builtins, name, None)
                found = self._globals[name]
                return found if type(found) not in (int, float, bool) or self._is_steady(name) else refuse(node)
        return refuse(node)

    def _is_steady(self, name: str) -> bool:
        """True if the module gives a name its value in one place and never again."""
        given = 0
        for node in ast.walk(self._tree):
            match node:
                case ast.Global(names=names) if name in names:
                    return False
                case ast.Name(id=given_name, ctx=ast.Store() | ast.Del()):
                    given += given_name == name
                case ast.alias(name=imported, asname=known_as):
                    given += (known_as or imported) in (name, "*")
        return given == 1
