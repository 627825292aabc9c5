"""Compiled expressions as text: what reads back as the same, with no brackets that it does not need."""

import ast

import pytest
from hypothesis import given
from hypothesis import strategies as st
from mindrun.graph.graph import Program

from mindlang.lock.world_facts import infix

OPERATORS = {ast.Add: "+", ast.Sub: "-", ast.Mult: "*", ast.Div: "/"}
LEAVES = st.sampled_from([(("reading", index),) for index in range(3)] + [(("number", float(n)),) for n in range(4)])
PROGRAMS: st.SearchStrategy[Program] = st.recursive(
    LEAVES,
    lambda inner: (
        inner.map(lambda one: (*one, ("negate", 0)))
        | st.tuples(inner, inner, st.sampled_from("+-*/")).map(lambda two: (*two[0], *two[1], (two[2], 0)))
    ),
    max_leaves=8,
)


def said(program: Program) -> str:
    return infix(program, lambda _, index: "abc"[int(index)])


def bracketed(program: Program) -> str:
    """The same with brackets around everything."""
    stack: list[str] = []
    for word, operand in program:
        match word:
            case "negate":
                stack.append(f"(-{stack.pop()})")
            case "number":
                stack.append(f"{operand:g}")
            case "reading":
                stack.append("abc"[int(operand)])
            case _:
                right, left = stack.pop(), stack.pop()
                stack.append(f"({left} {word} {right})")
    return stack[-1]


def tree(text: str) -> str:
    return ast.dump(ast.parse(text, mode="eval"))


@given(PROGRAMS)
def test_an_expression_reads_back_as_the_same(program: Program) -> None:
    assert tree(said(program)) == tree(bracketed(program))


@given(PROGRAMS)
def test_no_pair_of_brackets_could_be_left_out(program: Program) -> None:
    text = said(program)
    for begin, letter in enumerate(text):
        if letter == "(":
            end = closing(text, begin)
            without = f"{text[:begin]}{text[begin + 1 : end]}{text[end + 1 :]}"
            assert tree(without) != tree(text), (text, without)


def closing(text: str, begin: int) -> int:
    depth = 0
    for index in range(begin, len(text)):
        depth += {"(": 1, ")": -1}.get(text[index], 0)
        if depth == 0:
            return index
    raise AssertionError(text)


def program(node: ast.AST) -> Program:
    match node:
        case ast.Expression(body=inner):
            return program(inner)
        case ast.UnaryOp(operand=inner):
            return (*program(inner), ("negate", 0))
        case ast.BinOp(left=left, op=op, right=right):
            return (*program(left), *program(right), (OPERATORS[type(op)], 0))
        case ast.Name(id=name):
            return (("reading", "abc".index(name)),)
    raise AssertionError(node)


@pytest.mark.parametrize(
    "text", ["a * b / c", "a / b * c", "a - b + c", "a - (b - c)", "a / (b * c)", "-a * b", "-(a * b)", "a * (b + c)"]
)
def test_expressions_as_a_person_writes_them(text: str) -> None:
    assert said(program(ast.parse(text, mode="eval"))) == text
