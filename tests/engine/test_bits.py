"""The engine and a plain computation give the same bits."""

import math

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from mindrun.engine.engine import Engine
from mindrun.graph.policy import Policy
from mindrun.numbers.arithmetic import sigmoid
from mindrun.numbers.trigonometry import cosine, sine

from tests.draws import cases
from tests.hierarchies import PROCEDURES, Case, random_case
from tests.plain import Plain


@given(random_case(), st.data())
@settings(max_examples=cases(200), suppress_health_check=[HealthCheck.too_slow])
def test_same_bits_as_plain_python(case: Case, data: st.DataObject) -> None:
    """In a run and, once all is forgotten, in that run again."""
    master = data.draw(st.sampled_from([skill.name for skill in case.graph.skills]))
    engine = Engine(Policy(case.graph, case.weights), PROCEDURES, master)
    for _ in range(2):
        plain = Plain(case.graph, case.weights, master)
        for readings in case.readings:
            commands = engine.tick(readings)
            assert commands.tobytes() == np.array(plain.tick(readings), np.float32).tobytes()
            assert engine.influence.tobytes() == np.array(plain.influence, np.float32).tobytes()
            assert np.array_equal(engine.readings, np.array(plain.readings, np.float32), equal_nan=True)
            assert engine.faults == plain.faults
            assert ((commands >= 0) & (commands <= 1)).all()
        engine.reset()


def test_sigmoid_is_one() -> None:
    x = np.linspace(-30, 30, 200_001, dtype=np.float32)
    with np.errstate(over="ignore"):
        true = 1 / (1 + np.exp(-x.astype(np.float64)))
    assert np.abs(sigmoid(x) - true).max() < 1e-6
    assert np.diff(sigmoid(x)).min() > -3e-7, "it rises, but for the last bits"
    assert np.diff(sigmoid(x[np.abs(x) < 8][::100])).min() > 0
    assert sigmoid(x).min() >= 0
    assert sigmoid(x).max() <= 1
    assert sigmoid(np.array([0], np.float32)) == 0.5
    with np.errstate(invalid="ignore"):
        low, high, nothing = sigmoid(np.array([-np.inf, np.inf, np.nan], np.float32))
    assert (low, high, nothing) == (0, 1, 0)


@pytest.mark.parametrize("far", [1.0, 10.0, 1e5])
def test_waves_are_those_of_the_mathematicians(far: float) -> None:
    for x in np.linspace(-far, far, 4001).tolist():
        assert abs(sine(x) - math.sin(x)) < 2e-16
        assert abs(cosine(x) - math.cos(x)) < 2e-16
