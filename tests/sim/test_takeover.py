"""Another mind that takes over in the middle: the same one goes on to the bit, and one that does not fit is refused."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from mindrun.engine.changes import ChangeError
from mindrun.graph.graph import Graph
from mindrun.graph.policy import Policy
from mindrun.sim.rollout import Rollout, scores_of
from mindrun.sim.trace import take_over, trace

from tests.draws import cases
from tests.hierarchies import SCALES
from tests.sim.test_changed_ticks import SEEDS, SLOW, gaze, rollout_of, same
from tests.sim.test_random_worlds import weights_for
from tests.sim.test_rollout import same as same_scores
from tests.sim.worlds import random_world


@settings(max_examples=cases(30), suppress_health_check=SLOW)
@given(random_world(), st.integers(0, 40), st.sampled_from(SCALES), SEEDS)
def test_the_same_mind_goes_on_to_the_bit(graph: Graph, after: int, scale: float, seed: int) -> None:
    weights = weights_for(graph, scale, np.random.default_rng(seed))
    rollout = rollout_of(graph, weights)
    assume(not rollout.procedures.slow)  # what those remember begins anew
    plain = trace(rollout, seed % 1000)
    moments = list(plain.moments)
    tick = 1 + after % len(moments)
    rest = take_over(rollout, seed % 1000, tick, rollout_of(graph, weights))
    later = list(rest.moments)
    assert len(later) == len(moments) - tick + 1
    assert all(same(a, b) for a, b in zip(later, moments[tick - 1 :], strict=True))
    assert same_scores(scores_of(rest.jobs, rollout.task), scores_of(plain.jobs, rollout.task))


def test_other_weights_are_in_charge_from_their_tick_on() -> None:
    graph, plain, rollout = gaze("range_finder at 0 deg range 12")
    edges = tuple(replace(edge, value=(("number", 0.0),)) for edge in graph.skills[0].edges)
    still = Rollout(Policy(replace(graph, skills=(replace(graph.skills[0], edges=edges),)), {}), "Roam", "Go")
    rest = list(take_over(rollout, 5, 100, still).moments)
    assert np.array_equal(rest[0].readings, plain[99].readings)
    assert all((moment.commands == 0).all() for moment in rest)


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (lambda graph: replace(graph, sensors=graph.sensors[::-1]), "its sensors are others"),
        (lambda graph: replace(graph, tick=0.1), "its tick is another"),
        (lambda graph: replace(graph, tasks=(replace(graph.tasks[0], ticks=7),)), "its task Roam is another"),
        (lambda graph: replace(graph, skills=(_blind(graph.skills[0]),)), "its skills read other sensors"),
    ],
)
def test_one_that_does_not_fit_is_refused(change: Any, said: str) -> None:
    graph, _, rollout = gaze("range_finder at 0 deg range 12")
    other = Rollout(Policy(change(graph), {}), "Roam", "Go")
    with pytest.raises(ChangeError, match=said):
        take_over(rollout, 5, 100, other)


def test_a_run_that_is_over_has_no_later_tick() -> None:
    _, plain, rollout = gaze("range_finder at 0 deg range 12")
    with pytest.raises(ChangeError, match="the run is over before tick"):
        take_over(rollout, 5, len(plain) + 1, rollout)


def _blind(skill: Any) -> Any:
    return replace(skill, inputs=(), edges=tuple(replace(edge, value=(("number", 0.5),)) for edge in skill.edges))
