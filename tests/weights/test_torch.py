"""A skill in PyTorch: the bits of the engine, gradients that lead somewhere, and a file that comes back as it was."""

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mindrun.errors import MindError

import mindlang
from mindlang.compiler.compile import load
from mindlang.lock.signature import arrange
from mindlang.weights.importing import engine_deviation
from mindlang.weights.network import SkillNetwork, network_of
from tests.draws import cases
from tests.edits.taught import MIND, recorded, teach, write_mind

torch = pytest.importorskip("torch", reason="PyTorch is not installed: pip install 'mindlang[torch]'")

from mindlang.weights.torch_skill import (  # noqa: E402
    NetworkModule,
    OrderedProduct,
    RationalSigmoid,
    ReturningClamp,
    Skill,
)

SHAPES = (
    "mlp hidden 0",
    "mlp hidden 1",
    "mlp hidden 2",
    "mlp hidden 3 width 9",
    "elman",
    "elman width 3",
    "gru",
    "gru bias 1 centred 1",
    "ctrnn",
)


def network(folder: Path, function: str) -> SkillNetwork:
    """The network of a skill with this function."""
    graph = load(write_mind(folder, MIND.replace("skill Avoid is mlp hidden 2", f"skill Avoid is {function}"))).graph
    assert graph is not None
    return network_of(arrange(graph, {}), "Avoid")


@settings(max_examples=cases(40))
@given(st.sampled_from(SHAPES), st.integers(0, 2**32), st.sampled_from([0.1, 4.0, 1e4, 1e20, 3e38]))
def test_it_computes_the_bits_of_the_engine(
    tmp_path_factory: pytest.TempPathFactory, function: str, seed: int, spread: float
) -> None:
    own, rng = network(tmp_path_factory.mktemp("mind"), function), np.random.default_rng(seed)
    count = own.skill.function.genome_length(own.inputs, own.outputs)
    genome = np.clip(rng.normal(0, spread, count), -3e38, 3e38).astype(np.float32)
    rows = rng.random((20, own.inputs)).astype(np.float32)
    rows[::7] = rng.choice([0.0, -0.0, 1.0, 1e-30], (len(rows[::7]), own.inputs))
    module = NetworkModule(own, genome)
    state, found = None, []
    for row in torch.from_numpy(rows):
        sent = module(row, state) if own.state else module(row)
        sent, state = sent if own.state else (sent, None)
        found.append(sent.detach().numpy())
    compared = engine_deviation(own, genome, rows)
    assert compared.reference.startswith("PyTorch")
    assert compared.difference == 0
    assert int(np.isnan(found).sum()) == compared.faults


def test_a_batch_has_the_bits_of_each_row(tmp_path: Path) -> None:
    own = network(tmp_path, "mlp hidden 2")
    module = NetworkModule(own, own.skill.function.draw(own.inputs, own.outputs, 1, np.random.default_rng(1))[0])
    rows = torch.rand(64, own.inputs)
    assert torch.equal(module(rows), torch.stack([module(row) for row in rows]))
    assert torch.equal(module(rows.reshape(4, 16, -1)).reshape(64, -1), module(rows))


def test_before_the_clamp_it_is_the_same_in_0_to_1(tmp_path: Path) -> None:
    own = network(tmp_path, "mlp hidden 2")
    module = NetworkModule(own, own.skill.function.draw(own.inputs, own.outputs, 1, np.random.default_rng(1))[0])
    rows = torch.rand(64, own.inputs)
    values = module.before_clamp(rows)
    assert ((values < 0) | (values > 1)).any()
    assert torch.equal(values.clamp(0, 1), module(rows))


def test_derivatives_are_those_of_the_function() -> None:
    torch.manual_seed(1)
    x, weight = torch.rand(5, 3, dtype=torch.float64) * 8 - 4, torch.rand(4, 3, dtype=torch.float64)
    x.requires_grad_(), weight.requires_grad_()
    assert torch.autograd.gradcheck(OrderedProduct.apply, (x, weight))
    assert torch.autograd.gradcheck(RationalSigmoid.apply, x, atol=1e-5)
    inside = (torch.rand(9, dtype=torch.float64) * 0.9 + 0.05).requires_grad_()
    assert torch.autograd.gradcheck(ReturningClamp.apply, inside)


@pytest.mark.parametrize(
    ("value", "leads_up", "comes_through"),
    [(1.5, True, False), (1.5, False, True), (-0.5, True, True), (-0.5, False, False), (0.5, True, True)],
)
def test_what_leads_back_comes_through_the_clamp(value: float, leads_up: bool, comes_through: bool) -> None:
    x = torch.tensor([value], requires_grad=True)
    ((-1 if leads_up else 1) * ReturningClamp.apply(x)).sum().backward()  # descent goes against the derivative
    assert x.grad is not None
    assert bool(x.grad) == comes_through


@pytest.mark.parametrize("function", ["mlp hidden 1", "elman", "gru", "ctrnn"])
def test_it_learns_what_it_is_shown(tmp_path: Path, function: str) -> None:
    torch.manual_seed(2)
    own = network(tmp_path, function)
    module = NetworkModule(own, np.full(own.skill.function.genome_length(own.inputs, own.outputs), 2.0, np.float32))
    rows = torch.rand(200, own.inputs)
    wanted = torch.stack([rows[:, 0], 1 - rows[:, 0], rows[:, 1]], 1) * 0.5 + 0.2
    learner = torch.optim.Adam(module.parameters(), 0.05)
    losses = []
    for _ in range(150):
        sent = module(rows)[0] if own.state else module(rows)
        loss = (sent - wanted).square().mean()
        learner.zero_grad(), loss.backward(), learner.step()
        losses.append(loss.item())
    assert losses[0] > 0.05, "all outputs begin beyond 1, where torch.clamp has no derivative"
    assert losses[-1] < losses[0] / 5


def test_vectorised_derivatives(tmp_path: Path) -> None:
    own = network(tmp_path, "mlp hidden 2")
    module = NetworkModule(own, own.skill.function.draw(own.inputs, own.outputs, 1, np.random.default_rng(1))[0])
    rows = torch.rand(6, own.inputs)
    each = torch.func.vmap(torch.func.jacrev(module))(rows)
    assert each.shape == (6, own.outputs, own.inputs)
    assert torch.allclose(each[0], torch.func.jacrev(module)(rows[0]))


def test_it_begins_with_what_was_taught_and_saves_it(tmp_path: Path) -> None:
    path = write_mind(tmp_path)
    teach(path, "Go", "Avoid")
    mind = mindlang.load(path)
    skill = Skill(mind, "Avoid")
    assert (skill.reads, skill.sends) == (("eye:3",), ("left_wheel", "right_wheel", "mood"))
    skill.save(tmp_path / "avoid.safetensors")
    other = Skill(mind, "Avoid", from_scratch=True)
    assert not np.array_equal(other.genome(), skill.genome())
    other.load(tmp_path / "avoid.safetensors")
    assert other.genome().tobytes() == skill.genome().tobytes()
    from mindlang.lock.blobs import digest

    assert digest(skill.genome()) == recorded(path, "Avoid")


def test_random_weights_are_those_of_torchs_seed(tmp_path: Path) -> None:
    mind = mindlang.load(write_mind(tmp_path))
    found = []
    for seed in (1, 1, 2):
        torch.manual_seed(seed)
        found.append(Skill(mind, "Drive").genome())
    assert np.array_equal(found[0], found[1])
    assert not np.array_equal(found[0], found[2])


def test_torch_is_imported_when_it_is_needed() -> None:
    program = "import sys, mindlang, mindlang.torch; print('torch' in sys.modules)"
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert done.stdout == "False\n"


def test_what_chooses_sends_the_choice_of_the_engine(tmp_path: Path) -> None:
    """Of two influences the greater is 1; the derivatives of the choice are those of a softmax."""
    text = MIND.replace("  influences Grab at 1\n", "  chooses one\n")
    graph = load(write_mind(tmp_path, text)).graph
    assert graph is not None
    own = network_of(arrange(graph, {}), "Drive")
    module = NetworkModule(own, own.skill.function.draw(own.inputs, own.outputs, 1, np.random.default_rng(1))[0])
    rows = torch.rand(64, own.inputs)
    values, sent = module.before_clamp(rows), module(rows)
    assert torch.equal(sent.argmax(-1), values.argmax(-1))
    assert torch.equal(sent.sort(-1).values, torch.tensor([0.0, 1.0]).expand(64, 2))
    sent[:, 0].sum().backward()
    assert all(layer.weight.grad is not None and layer.weight.grad.abs().sum() > 0 for layer in module.layers)
    graph = load(write_mind(tmp_path, text.replace("  chooses one\n", "  chooses one\n  influences Grab at 1\n"))).graph
    assert graph is not None
    with pytest.raises(MindError, match="chooses among lines with at"):
        NetworkModule(network_of(arrange(graph, {}), "Drive"), module.genome())
