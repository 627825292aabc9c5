"""The compiled lanes as numba has made them: no reference is counted, which took half of the time of a tick."""

import gc
from collections.abc import Iterator
from typing import Any

import pytest
from mindrun.graph.policy import Policy
from mindrun.sim.lanes.advance import advance
from mindrun.sim.lanes.runs import fill
from mindrun.sim.numba_internals import COLLECTION_OBJECTS, rare_collections
from mindrun.sim.rollout import Rollout

from mindlang.compiler.compile import load
from tests.language.examples import COLLECT

MOST_INSTRUCTIONS = 50_000  # of one function: LLVM takes longer than in proportion (there were 62,000 once)
WRAPPER = "_ZN7cpython"  # what Python calls: it holds the arrays while the lanes run


def counted(module: Any) -> Iterator[str]:
    """The functions of a module that count references."""
    for function in module.functions:
        for block in function.blocks:
            if any(i.opcode == "call" and "NRT_" in str(i) for i in block.instructions):
                yield function.name


def instruction_count(function: Any) -> int:
    """The instructions of a function as LLVM has optimised it; 0 where it is elsewhere."""
    return sum(1 for block in function.blocks for _ in block.instructions)


@pytest.mark.parametrize("function", [advance, fill])
def test_no_reference_is_counted(function: Any) -> None:
    graph = load(COLLECT).graph
    assert graph
    Rollout(Policy(graph, {}), "GoToObject", "GoToObject", ["GoToObject"]).compile()
    compiled = list(function.overloads.values())
    assert compiled
    for each in compiled:
        module = each.library._get_module_for_linking()
        assert any(not f.is_declaration for f in module.functions)
        assert [name for name in counted(module) if not name.startswith(WRAPPER)] == []
        assert max(map(instruction_count, module.functions)) < MOST_INSTRUCTIONS


def test_garbage_is_looked_for_as_before_once_it_is_compiled() -> None:
    before, inside = gc.get_threshold(), []

    @rare_collections()
    def compiling() -> None:
        inside.append(gc.get_threshold())
        raise ZeroDivisionError

    with pytest.raises(ZeroDivisionError):
        compiling()
    assert inside == [(COLLECTION_OBJECTS, *before[1:])]
    assert gc.get_threshold() == before
