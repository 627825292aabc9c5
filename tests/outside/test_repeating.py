"""What an environment does not do again is seen, wherever it comes from; one that does is not suspected."""

import random
from collections.abc import Callable
from time import perf_counter_ns
from typing import Any, ClassVar

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

gymnasium = pytest.importorskip("gymnasium")

from mindrun.sim.outside.making import BrokenEnvironmentError  # noqa: E402
from mindrun.sim.outside.rollout import RecordingStepper  # noqa: E402
from mindrun.sim.outside.stepper import LocalStepper, number_of, truth_of  # noqa: E402

NAME, STEPS, PLACES = "Drawn-v0", 12, [("", 0)]


class Drawn(gymnasium.Env):  # type: ignore[misc,name-defined]
    """Says 0 until step `first`, and from then on what comes from a source, as an observation or as a reward."""

    observation_space = action_space = gymnasium.spaces.Box(-np.inf, np.inf, (1,), np.float64)
    source, is_reward, first = "nothing", False, 0
    begun: ClassVar[int] = 0

    def __init__(self) -> None:
        self.own = 0

    def reset(self, seed: int | None = None, options: Any = None) -> Any:
        super().reset(seed=seed)
        Drawn.begun += 1
        self.own += 1
        self.steps = 0
        if self.source == "its own seed in the generator of all":
            np.random.seed(seed)  # what some do
        return np.array([0.0 if self.is_reward else self.value()]), {}

    def step(self, action: Any) -> Any:
        self.steps += 1
        value = self.value()
        return np.array([0.0 if self.is_reward else value]), value * self.is_reward, False, False, {}

    def value(self) -> float:
        return SOURCES[self.source](self) if self.steps >= self.first else 0.0


SOURCES: dict[str, Callable[[Drawn], float]] = {
    "numpy's generator of all": lambda env: float(np.random.rand()),
    "Python's generator of all": lambda env: random.random(),
    "the clock": lambda env: float(perf_counter_ns()),
    "how many have begun": lambda env: float(Drawn.begun),
    "its own seed in the generator of all": lambda env: float(np.random.rand()),
    "how often it has begun": lambda env: float(env.own),
    "its own generator": lambda env: float(env.np_random.random()),
    "nothing": lambda env: 0.0,
    "no number": lambda env: np.nan,
}
CLEAN = "its own generator", "nothing", "no number"


def flaw(seed: int, is_paid: bool = True) -> str:
    """What is said of a run of `STEPS` steps that is made again."""
    gymnasium.registry.pop(NAME, None)
    gymnasium.register(NAME, Drawn)
    recorder = RecordingStepper(LocalStepper(NAME))
    runs = recorder.begin(PLACES, [seed])
    for number in range(STEPS):
        recorder.step(runs, np.array([[float(number)]]))
    return recorder.flaw(LocalStepper(NAME), ["place"], is_paid)


@given(st.sampled_from(sorted(SOURCES)), st.booleans(), st.integers(0, STEPS), st.integers(0, 2**40))
def test_what_is_not_the_same_again(source: str, is_reward: bool, first: int, seed: int) -> None:
    Drawn.source, Drawn.is_reward, Drawn.first = source, is_reward, first
    said = flaw(seed)
    if source in CLEAN:
        assert said == ""
        return
    assert f"with seed {seed} {'its reward' if is_reward else 'place'} in tick " in said
    assert ("figures can be repeated" in said) == (source == "how often it has begun")
    assert said.startswith(f"{NAME} does ")
    if source in ("the clock", "how many have begun"):
        tick = max(first, 1) if is_reward else first + 1
        assert f"in tick {tick} was " in said
    if is_reward:
        assert flaw(seed, is_paid=False) == ""


def test_what_fails_the_second_time(monkeypatch: pytest.MonkeyPatch) -> None:
    Drawn.source, Drawn.is_reward, Drawn.first = "nothing", False, 0

    class Jealous(Drawn):
        begun_once: ClassVar[bool] = False

        def reset(self, seed: int | None = None, options: Any = None) -> Any:
            if Jealous.begun_once:
                raise OSError("the port is taken")
            Jealous.begun_once = True
            return super().reset(seed=seed)

    monkeypatch.setitem(globals(), "Drawn", Jealous)
    assert "no figure of it can be repeated: with seed 3 it failed then: the environment Drawn-v0 failed" in flaw(3)


NUMBERS = st.one_of(st.floats(allow_nan=False), st.integers(-(2**60), 2**60), st.booleans())


@given(NUMBERS, st.sampled_from([lambda x: x, np.float64, np.asarray, lambda x: np.array([x])]))
def test_a_reward_is_a_number(value: Any, given_as: Callable[[Any], Any]) -> None:
    assert number_of("the reward", given_as(value)) == float(value)


@pytest.mark.parametrize("text", ["1", "nan", b"1", bytearray(b"2"), np.str_("3"), np.array("4"), None, 1j, [1.0]])
def test_a_text_is_no_reward(text: Any) -> None:
    with pytest.raises(TypeError):
        number_of("the reward", text)


@pytest.mark.parametrize("value", [True, False, 0, 1, 1.0, np.True_, np.int8(0), np.array(True), np.array([0])])
def test_a_truth_is_one(value: Any) -> None:
    assert truth_of("terminated", value) is bool(value)


@pytest.mark.parametrize("value", ["no", "", "False", b"", None, [], [1], {}, 2, 0.5, np.nan, np.str_("no")])
def test_what_is_neither_true_nor_false(value: Any) -> None:
    with pytest.raises(TypeError, match=r"terminated is .*, which is neither true nor false"):
        truth_of("terminated", value)


def test_an_environment_that_says_texts_is_at_fault() -> None:
    Drawn.source = "nothing"
    gymnasium.registry.pop(NAME, None)
    gymnasium.register(NAME, Drawn)
    stepper = LocalStepper(NAME)
    [run] = stepper.begin(PLACES, [1])
    for answer in ((np.zeros(1), "1", False, False, {}), (np.zeros(1), 1.0, "no", False, {})):
        environment, _ = stepper._open[run]
        environment.step = lambda action, answer=answer: answer
        with pytest.raises(BrokenEnvironmentError) as raised:
            stepper.step([run], np.zeros((1, 1)))
        assert "the fault is the environment's: TypeError: " in (raised.value.hint or "")
