"""What a program gives to an environment: seeds, actions and numbers of robots of any kind, or one sentence."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mindrun.errors import MindError

from tests.calling import write_rules

pytest.importorskip("gymnasium")

from mindlang.environments import TaskEnv, TaskVectorEnv
from mindlang.environments.episodes import to_actions
from mindlang.run.setup import layouts


@pytest.fixture(scope="module")
def roam(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return write_rules(tmp_path_factory.mktemp("given"))


@pytest.fixture(scope="module")
def many(roam: Path) -> TaskVectorEnv:
    return TaskVectorEnv(roam, "Roam", num_envs=3)


@pytest.mark.parametrize("count", [0, -1, 1.5, "3", None])
def test_there_is_a_whole_number_of_robots(roam: Path, count: Any) -> None:
    with pytest.raises(MindError, match=r"there cannot be .* robots") as found:
        TaskVectorEnv(roam, "Roam", num_envs=count)
    assert "1 or more" in found.value.hint


@pytest.mark.parametrize("count", [np.int32(2), 2])
def test_numbers_of_numpy_are_numbers_of_robots(roam: Path, count: Any) -> None:
    assert TaskVectorEnv(roam, "Roam", num_envs=count).reset(seed=1)[0].shape[0] == 2


LAYOUTS = {
    "one": (4, layouts(4, 3)),
    "numpy": (np.int64(4), layouts(4, 3)),
    "array": (np.array([7, 8, 9]), [7, 8, 9]),
    "unsigned": (np.array([7, 2**64 - 1, 2**63], np.uint64), [7, 2**64 - 1, 2**63]),
    "tuple": ((1, np.uint8(2), 3), [1, 2, 3]),
    "large": (2**63 - 1, layouts(2**63 - 1, 3)),
}


@pytest.mark.parametrize("case", LAYOUTS)
def test_seeds_of_any_kind_of_whole_number(many: TaskVectorEnv, case: str) -> None:
    seed, right = LAYOUTS[case]
    _, info = many.reset(seed=seed)
    assert [int(layout) for layout in info["layout"]] == right


@pytest.mark.parametrize("mode", ["NextStep", "SameStep"])
def test_a_layout_beyond_63_bits_is_said_when_it_ends(roam: Path, tmp_path: Path, mode: str) -> None:
    short = tmp_path / "short.mind"
    short.write_text(roam.read_text("utf-8").replace("lasts 600 ticks", "lasts 2 ticks"), "utf-8")
    env = TaskVectorEnv(short, "Roam", num_envs=2, autoreset_mode=mode)
    env.reset(seed=[2**64 - 2, 2**64 - 1])
    env.step(np.zeros((2, 2), np.float32))
    info = env.step(np.zeros((2, 2), np.float32))[4]
    ended = info["final_info"] if mode == "SameStep" else info
    assert [int(layout) for layout in ended["layout"]] == [2**64 - 2, 2**64 - 1]


@pytest.mark.parametrize("seed", ["abc", b"abc", -1, 2**63, 1.5, [1, 2, "x"], [1, 2, 3.5], {1: 2}, [1, 2]])
def test_what_is_no_seed(many: TaskVectorEnv, seed: Any) -> None:
    with pytest.raises(MindError, match=r"no seed|seed cannot be|2 seeds for 3 robots"):
        many.reset(seed=seed)
    many.reset(seed=1)


WRONG: dict[str, Any] = {
    "text": "abc",
    "texts": np.array(["a", "b"]),
    "none": None,
    "complex": np.array([1j, 0]),
    "table": {"a": 1},
    "ragged": [[1.0], [2.0, 3.0]],
    "long": np.zeros(3),
    "turned": np.zeros((2, 1)),
    "one": 0.5,
}


@pytest.mark.parametrize("case", WRONG)
def test_what_is_no_action(roam: Path, many: TaskVectorEnv, case: str) -> None:
    single = TaskEnv(roam, "Roam")
    single.reset(seed=1)
    many.reset(seed=1)
    for env in (single, many):
        before = env.unwrapped._episodes.lanes.scores.copy()
        with pytest.raises(MindError, match="actions ") as found:
            env.step(WRONG[case])
        assert found.value.hint
        np.testing.assert_array_equal(env.unwrapped._episodes.lanes.scores, before)


@given(
    st.lists(st.one_of(st.floats(), st.integers(-3, 3)), min_size=1, max_size=8), st.sampled_from(["f8", "f4", "f2"])
)
@settings(deadline=None)
def test_what_is_finite_stays_so_in_single_precision(values: list[float], kind: str) -> None:
    with np.errstate(over="ignore"):
        array = np.array(values, kind)
    with np.errstate(all="raise", under="ignore"):
        found = to_actions(array, array.shape)
    assert found.dtype == np.float32
    np.testing.assert_array_equal(np.isfinite(found), np.isfinite(array))
    finite = np.isfinite(array)
    expected = np.clip(array[finite].astype(np.float64), 0, 1).astype(np.float32)
    np.testing.assert_array_equal(np.clip(found[finite], 0, 1), expected)
