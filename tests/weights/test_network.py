"""A genome as matrices: back to the bit, the same function in another order, refused where it does not fit."""

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from mindrun.errors import WeightsError

from mindlang.compiler.compile import load
from mindlang.lock.signature import arrange
from mindlang.weights.importing import Deviation, engine_deviation
from mindlang.weights.network import SkillNetwork, Tensors, network_of, to_genome, to_tensors
from tests.edits.taught import MIND, write_mind

KINDS = {
    kind: MIND.replace("skill Avoid is mlp hidden 2", f"skill Avoid is {kind}")
    for kind in ("mlp", "elman", "gru", "ctrnn", "elman bias 1 centred 1")
}


def network(folder: Path, text: str = MIND, skill: str = "Avoid") -> SkillNetwork:
    """The network of a skill of a text."""
    graph = load(write_mind(folder, text)).graph
    assert graph is not None
    return network_of(arrange(graph, {}), skill)


def genome_of(of: SkillNetwork, seed: int = 1) -> np.ndarray:
    """A random genome."""
    return of.skill.function.draw(of.inputs, of.outputs, 1, np.random.default_rng(seed))[0]


@pytest.mark.parametrize("text", KINDS.values(), ids=KINDS)
def test_there_and_back(tmp_path: Path, text: str) -> None:
    own = network(tmp_path, text)
    genome = genome_of(own)
    back = to_genome(own, to_tensors(own, genome))
    assert back.tobytes() == genome.tobytes()


@pytest.mark.parametrize("text", KINDS.values(), ids=KINDS)
def test_weights_in_another_order_do_the_same(tmp_path: Path, text: str) -> None:
    text = text.replace("  reads eye\n  drives", "  reads eye\n  reads charge\n  drives")
    other = text.replace("  reads eye\n  reads charge\n", "  reads charge\n  reads eye\n")
    own, its = network(tmp_path, text), network(tmp_path, other)
    assert own.signature.reads == ("eye:3", "charge")
    assert its.signature.reads == ("charge", "eye:3")
    genome = genome_of(its)
    brought = to_genome(own, to_tensors(its, genome))
    rows = np.random.default_rng(2).random((20, own.inputs)).astype(np.float32)
    theirs = its.skill.function.ready(its.inputs, its.outputs, genome, {})
    ours = own.skill.function.ready(own.inputs, own.outputs, brought, {})
    for row in rows:
        assert np.allclose(ours(row), theirs(row[[3, 0, 1, 2]]), atol=1e-5)


@pytest.mark.parametrize("text", KINDS.values(), ids=KINDS)
def test_the_engine_computes_what_stands_in_a_book(tmp_path: Path, text: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(__import__("sys").modules, "torch", None)
    own = network(tmp_path, text)
    rows = np.random.default_rng(2).random((50, own.inputs)).astype(np.float32)
    rows[7, 0] = np.nan
    found = engine_deviation(own, genome_of(own, 4), rows)
    assert (found.reference, found.ticks, found.faults) == ("float64", 49, 0)
    assert 0 < found.difference < 1e-4


@pytest.mark.parametrize("text", KINDS.values(), ids=KINDS)
def test_of_no_readings_nothing_is_computed(tmp_path: Path, text: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(__import__("sys").modules, "torch", None)
    own = network(tmp_path, text)
    rows = np.full((3, own.inputs), np.nan, np.float32)
    assert engine_deviation(own, genome_of(own), rows) == Deviation("float64", 0, 0.0, 0)


@pytest.mark.parametrize(
    ("weights", "difference"), [((3e7, 1.6, -3e7), 0.0), ((3e7, 0.6, -3e7), 0.6), ((3e7, -1.6, -3e7), 0.0)]
)
def test_they_differ_by_what_is_sent(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, weights: tuple[float, ...], difference: float
) -> None:
    """In single precision a number beside a large one is an even one; what is beyond 0..1 is the same for a motor."""
    monkeypatch.setitem(__import__("sys").modules, "torch", None)
    own = network(tmp_path, MIND.replace("skill Avoid is mlp hidden 2", "skill Avoid is mlp hidden 0"))
    genome = np.tile(np.array(weights, np.float32), own.outputs)
    found = engine_deviation(own, genome, np.ones((2, own.inputs), np.float32))
    assert found.difference == pytest.approx(difference, rel=1e-6)


def test_what_overflows_is_a_fault(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(__import__("sys").modules, "torch", None)
    own = network(tmp_path)
    rows = np.ones((5, own.inputs), np.float32)
    found = engine_deviation(own, np.full_like(genome_of(own), 3e38), rows)
    assert found.faults == 5 * own.outputs


def changed(change: Callable[[dict[str, np.ndarray]], object]) -> Callable[[Tensors], Tensors]:
    """The same tensors with a change."""

    def apply(tensors: Tensors) -> Tensors:
        by_name = {name: matrix.copy() for name, matrix in tensors.by_name.items()}
        change(by_name)
        return Tensors(by_name, tensors.metadata)

    return apply


def said(**metadata: str) -> Callable[[Tensors], Tensors]:
    """The same tensors of which something else is said."""
    return lambda tensors: Tensors(tensors.by_name, {f"mind.{key}": value for key, value in metadata.items()})


MLP = {"function": "mlp hidden 2 width 5", "reads": "eye:3", "sends": "left_wheel right_wheel mood"}
WRONG: dict[str, tuple[Callable[[Tensors], Tensors], str]] = {
    "one is missing": (changed(lambda t: t.pop("layers.1.weight")), "it has no layers.1.weight"),
    "one more": (changed(lambda t: t.update(bias=np.zeros(3, np.float32))), "it has bias, which is no weight of Avoid"),
    "turned": (changed(lambda t: t.update({"layers.0.weight": t["layers.0.weight"].T})), "it is turned over"),
    "another shape": (
        changed(lambda t: t.update({"layers.1.weight": np.zeros((2, 2), np.float32)})),
        "layers.1.weight is 2×2, and that of Avoid 5×5",
    ),
    "a number": (changed(lambda t: t.update({"layers.1.weight": np.float32(1)})), "is a single number"),
    "NaN": (changed(lambda t: t["layers.2.weight"].fill(np.nan)), "layers.2.weight has numbers that are not finite"),
    "half of what it is of": (said(reads="eye:3"), "but not all"),
    "another function": (said(**MLP | {"function": "elman width 5"}), "was elman, now mlp"),
    "other readings": (said(**MLP | {"reads": "nose"}), "reads eye is new; reads nose is gone"),
    "fewer readings": (said(**MLP | {"reads": "eye:2"}), "eye had 2 readings, now 3"),
    "a name twice": (said(**MLP | {"reads": "eye:3 eye:3"}), "says twice or otherwise what it reads"),
    "a width in other words": (said(**MLP | {"reads": "eye:03"}), "says twice or otherwise what it reads"),
    "a width of many digits": (said(**MLP | {"reads": "eye:" + "9" * 5000}), "eye had 999999999 readings, now 3"),
}


@pytest.mark.parametrize(("change", "message"), WRONG.values(), ids=WRONG)
def test_what_does_not_fit_is_one_sentence(tmp_path: Path, change: Callable[[Tensors], Tensors], message: str) -> None:
    own = network(tmp_path)
    tensors = to_tensors(own, genome_of(own))
    with pytest.raises(WeightsError, match=r"^[^\n]+$") as error:
        to_genome(own, change(tensors))
    assert message in str(error.value)


def test_much_that_is_said_is_cut_off(tmp_path: Path) -> None:
    own = network(tmp_path)
    tensors = to_tensors(own, genome_of(own))
    with pytest.raises(WeightsError, match=r"sends x+…$") as error:
        to_genome(own, said(**MLP | {"sends": "x" * 100_000})(tensors))
    assert len(str(error.value)) < 600


@given(st.dictionaries(st.sampled_from(["mind.function", "mind.reads", "mind.sends"]), st.text(max_size=20)))
def test_no_metadata_raises_anything_else(tmp_path_factory: pytest.TempPathFactory, metadata: dict[str, str]) -> None:
    own = network(tmp_path_factory.mktemp("mind"))
    genome = genome_of(own)
    try:
        back = to_genome(own, Tensors(to_tensors(own, genome).by_name, metadata))
    except WeightsError:
        return
    assert back.tobytes() == genome.tobytes()


@pytest.mark.parametrize(
    ("skill", "message"),
    [("Grab", "Grab has no weights: it learns nothing"), ("Gone", "there is no skill called Gone")],
)
def test_a_skill_without_weights(tmp_path: Path, skill: str, message: str) -> None:
    with pytest.raises(WeightsError, match=message):
        network(tmp_path, skill=skill)
