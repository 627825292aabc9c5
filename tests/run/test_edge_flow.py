"""What flows over edges: the same in any order of asking, and what the engine adds up to influence."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from mindrun.engine.engine import Engine, procedure_sources
from mindrun.errors import MindError
from mindrun.graph.policy import Policy

from mindlang.attribution.shares import shares
from mindlang.run.edge_flow import BLOCK_ROWS, EdgeFlows, Sink, accumulated, edge_flows
from tests.hierarchies import PROCEDURES, Case, random_case
from tests.minds import always, mind, rule
from tests.run.test_shares import Thought, flows_of, thought
from tests.sim.minds import compile_text

FIELDS = ("value", "behind", "carried", "transmitted")
REMEMBERING = """
tick 1/20 s
master Go
body Robot is disc
actuator left_wheel is wheel side left neutral 0.5
sensor eyes is range_finder at 0 deg range 12
skill Go is elman width 3
  reads eyes
  drives left_wheel
"""


@given(random_case(), st.sets(st.integers(1, 5), max_size=2), st.integers(0, 99))
def test_any_order_of_asking_is_the_order_of_ticks(case: Case, begins: set[int], seed: int) -> None:
    """What functions remember, and where the mind was begun anew, are of the row and not of who asks."""
    run = begun_anew(case, begins)
    whole = flows(case, run, begins).flow_at(range(len(run.readings)))
    asked = flows(case, run, begins)
    order = np.random.default_rng(seed).permutation(len(run.readings)).tolist()
    for row in [*order, order[0]]:
        alone = asked.flow_at(range(row, row + 1))
        assert all(getattr(alone, name).tobytes() == getattr(whole, name)[row].tobytes() for name in FIELDS)
    for skill in asked.skills[1:]:
        sent = accumulated(whole.carried[:, asked.links_to.get(("skill", skill), [])])
        assert np.array_equal(sent, run.influence[:, skill], equal_nan=True)


def begun_anew(case: Case, begins: set[int]) -> Thought:
    """The engine's run over a case's readings, begun anew in some of its rows."""
    engine, found = Engine(Policy(case.graph, case.weights), PROCEDURES), []
    for number, row in enumerate(case.readings):
        if number in begins:
            engine.reset()
        found.append((engine.tick(row), engine.readings, engine.influence))
    return Thought(np.array([row[1] for row in found]), np.array([row[2] for row in found]), [row[0] for row in found])


def flows(case: Case, run: Thought, begins: set[int]) -> EdgeFlows:
    graph = case.graph
    return edge_flows(
        Policy(graph, case.weights), procedure_sources(graph, PROCEDURES), graph.master, run, frozenset(begins)
    )


def test_what_is_kept_goes_on_over_blocks() -> None:
    graph = compile_text(REMEMBERING)
    weights = {"Go": graph.skills[0].function.draw(1, 1, 1, np.random.default_rng(2))[0]}
    case = Case(graph, weights, np.random.default_rng(3).random((2 * BLOCK_ROWS + 10, graph.width), np.float32))
    run = thought(case)
    found = flows_of(case, run)
    for row in (2 * BLOCK_ROWS + 3, 5, BLOCK_ROWS, BLOCK_ROWS - 1, 2 * BLOCK_ROWS):
        assert found.flow_at(range(row, row + 1)).value[0, 0] == run.commands[row][0]


def test_influence_that_nobody_sent_is_refused_where_it_counts() -> None:
    """A skill between the master and what is asked about has other influence in one of the ticks."""
    skills = [
        rule("Top", always("skill", 1, 0.5), always("skill", 2, 0.25)),
        rule("Left", always("actuator", 0, 1.0)),
        rule("Right", always("actuator", 1, 1.0)),
    ]
    case = Case(mind(*skills), {}, np.zeros((3, 1), np.float32))
    run = thought(case)
    run.influence[1, 1] = 0.75
    found = flows_of(case, run)
    targets: list[Sink] = [("actuator", 0), ("skill", 1)]
    for target in targets:
        with pytest.raises(MindError, match="the influence of Left was replaced"):
            shares(found, target, range(3))
        assert shares(found, target, range(2, 3)).command > 0
    assert shares(found, ("actuator", 1), range(3)).command == 1
    run.influence[0, 0] = 0.5
    with pytest.raises(MindError, match="of Top"):
        shares(found, ("skill", 0), range(1))
