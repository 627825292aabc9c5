"""Drawn minds in environments as texts: formatted, linted, packed, completed, they stay what they are."""

import re
from pathlib import Path
from random import Random

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st
from mindrun.graph.bundle import Bundle, pack, unpack
from mindrun.graph.graph import Graph
from mindrun.graph.policy import Policy
from mindrun.graph.weights import genes

from mindlang.compiler.compile import Compiled, compile_source
from mindlang.compiler.format import formatted
from mindlang.compiler.source import Source
from mindlang.lint.lint import lint
from mindlang.server.completing import complete
from mindlang.server.hovering import hover
from mindlang.server.workspace import Workspace
from tests.draws import cases
from tests.outside.drawn import environment_mind

PATH = Path("/nowhere/drawn.mind")
NUMBERS = st.integers(0, 1_000_000)


def text(number: int) -> str:
    """A drawn mind, whose environment nobody asks."""
    return environment_mind(Random(number), "drawn:")


def compiled(source: str) -> Compiled:
    """What comes of it."""
    return compile_source(Source(str(PATH), source, PATH.parent))


def graph_of(source: str) -> Graph:
    """Its graph."""
    found = compiled(source)
    assert found.graph is not None, [each.message for each in found.diagnostics]
    return found.graph


@settings(max_examples=cases(60), deadline=None)
@given(NUMBERS)
def test_its_spaces_mean_nothing(number: int) -> None:
    source, rng = text(number), Random(number)
    untidy = re.sub(" ", lambda _: rng.choice([" ", "  ", "\t"]), source)
    tidy = formatted(untidy)
    assert formatted(tidy) == tidy
    assert formatted(source) == tidy
    assert graph_of(untidy) == graph_of(source) == graph_of(tidy)


@settings(max_examples=cases(60), deadline=None)
@given(NUMBERS)
def test_a_bundle_has_the_same_graph(number: int) -> None:
    graph = graph_of(text(number))
    weights = {skill.name: np.zeros(genes(skill), np.float32) for skill in graph.skills if genes(skill)}
    assert unpack(pack(Bundle(Policy(graph, weights), {}))).graph == graph


@settings(max_examples=cases(40), deadline=None)
@given(NUMBERS)
def test_lint_says_nothing_that_no_line_is_at_fault_for(number: int) -> None:
    for found in lint(compiled(text(number))):
        assert found.message
        assert found.span.text.strip()


@settings(max_examples=cases(40), deadline=None)
@given(NUMBERS, st.integers(0, 10_000))
def test_an_editor_may_ask_anywhere(number: int, place: int) -> None:
    source = text(number)
    offset = place % len(source)
    view = Workspace({PATH: source}).view(PATH)
    complete(view, PATH, source, offset)
    hover(view, PATH, offset)
    cut = source[:offset]
    complete(Workspace({PATH: cut}).view(PATH), PATH, cut, offset)
