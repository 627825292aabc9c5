"""What reward lines have paid: one order, so that every command says the same score."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from mindrun.graph.graph import Reward
from mindrun.graph.run_scores import paid_by_text, score_of
from numpy.typing import NDArray

NUMBERS = st.floats(-1e20, 1e20)


@given(paid=arrays(np.float64, st.tuples(st.integers(0, 3), st.integers(0, 20)), elements=NUMBERS), data=st.data())
def test_lines_are_added_one_after_the_other(paid: NDArray[np.float64], data: st.DataObject) -> None:
    """As plain additions have it: not pairwise as numpy's sum, not compensated as that of Python 3.12."""
    texts = [data.draw(st.sampled_from("abc")) for _ in range(paid.shape[1])]
    rewards = [Reward(text, (), None) for text in texts]
    for row in paid:
        total, by_text = 0.0, dict.fromkeys(texts, 0.0)
        for text, value in zip(texts, row.tolist(), strict=True):
            total += value
            by_text[text] += value
        assert float(score_of(row)) == total
        assert paid_by_text(rewards, row) == by_text
    assert score_of(paid).tolist() == [float(score_of(row)) for row in paid]


def test_a_table_may_have_a_line_where_the_task_has_none() -> None:
    assert paid_by_text([], np.zeros(1)) == {}
    assert score_of(np.zeros(0)) == 0.0
