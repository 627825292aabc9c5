"""The benchmark of two poles on a cart: its equations, its networks, its score and its log."""

import json
from dataclasses import asdict
from math import cos, exp, pi, sin, sqrt
from pathlib import Path

import numpy as np
import pytest

from benchmarks.cart_and_poles import after
from benchmarks.double_pole import (
    LEARNERS,
    SAYS,
    START,
    TERMS,
    Outcome,
    Trial,
    balance,
    contest,
    other_starts,
    read,
    scored,
    tried,
)  # fmt: skip

GRAVITY, CART, MASSES, HALVES = 9.8, 1.0, (0.1, 0.01), (0.5, 0.05)
OF = contest(SAYS["elman"], LEARNERS["elman"])


def energy(state: np.ndarray) -> float:
    """Of the cart and of two even rods upon it."""
    _, v, *poles = map(float, state)
    found = CART * v * v / 2
    for mass, half, angle, spin in zip(MASSES, HALVES, poles[::2], poles[1::2], strict=True):
        along, up = v + half * spin * cos(angle), -half * spin * sin(angle)
        found += mass * (along**2 + up**2) / 2 + mass * half**2 / 3 * spin**2 / 2 + mass * GRAVITY * half * cos(angle)
    return found


def follow(state: np.ndarray, ticks: int, force: float = 0, friction: tuple[float, float] = (0, 0)) -> np.ndarray:
    for _ in range(ticks):
        state = after(state, force, *friction, 0.01)
    return state


def test_without_force_and_friction_energy_stays() -> None:
    """While both poles fall, hang and swing."""
    state = before = np.array([0.3, -0.4, 0.5, 1.0, -0.8, 2.0])
    for _ in range(2000):
        state = after(state, 0.0, 0.0, 0.0, 0.001)
        assert energy(state) == pytest.approx(energy(before), abs=1e-6)


def test_small_angles_grow_as_the_linear_equations_say() -> None:
    """Along each direction in which poles fall from rest, by e^λt: M q̈ = K q."""
    (m, n), (a, b) = MASSES, HALVES
    inertia = np.array([[CART + m + n, m * a, n * b], [m * a, 4 / 3 * m * a * a, 0], [n * b, 0, 4 / 3 * n * b * b]])
    squares, directions = np.linalg.eig(np.linalg.solve(inertia, np.diag([0, m * GRAVITY * a, n * GRAVITY * b])))
    tried_directions = 0
    for square, direction in zip(squares.real, directions.real.T, strict=True):
        if square > 1:
            state = np.ravel([1e-6 * direction, 1e-6 * sqrt(square) * direction], order="F")
            grown = state * exp(sqrt(square) * 0.3)
            assert follow(state, 30) == pytest.approx(grown, rel=1e-3, abs=1e-12)
            tried_directions += 1
    assert tried_directions == 2


@pytest.mark.parametrize("force", [10.0, -3.0])
def test_the_equations_are_those_of_the_bodies(force: float) -> None:
    """Of Lagrange, not solved for the cart, with friction, in steps of 20 µs."""
    x, v, *poles = 0.0, 0.2, pi / 40, -0.3, 0.02, 0.5
    step, cart_friction, hinge_friction = 2e-5, 0.3, 0.0004
    for _ in range(int(0.3 / step)):
        rows = []
        for mass, half, angle, spin in zip(MASSES, HALVES, poles[::2], poles[1::2], strict=True):
            inertia = 4 / 3 * mass * half * half
            torque = mass * GRAVITY * half * sin(angle) - hinge_friction * spin
            rows.append((inertia, mass * half * cos(angle), torque, mass * half * spin * spin * sin(angle)))
        pull = force - cart_friction * np.sign(v) + sum(row[3] - row[1] * row[2] / row[0] for row in rows)
        faster = pull / (CART + sum(MASSES) - sum(row[1] ** 2 / row[0] for row in rows))
        v += step * faster
        x += step * v
        for pole, (inertia, coupling, torque, _) in enumerate(rows):
            poles[2 * pole + 1] += step * (torque - coupling * faster) / inertia
            poles[2 * pole] += step * poles[2 * pole + 1]
    begun = np.array([0.0, 0.2, pi / 40, -0.3, 0.02, 0.5])
    found = follow(begun, 30, force, (cart_friction, hinge_friction))
    assert found == pytest.approx([x, v, *poles], rel=5e-3, abs=5e-4)


@pytest.mark.parametrize("says", ["elman width 3", "gru width 2", "mlp hidden 1 width 4"])
def test_networks_side_by_side_are_those_of_the_engine(says: str) -> None:
    of, rng = contest(says, LEARNERS["elman"]), np.random.default_rng(1)
    function, genomes = of.skill.function, of.draw(5, rng)
    engines = [function.ready(*of.size, genome, {}) for genome in genomes]
    memory, matrices = np.zeros((5, function.state_length(*of.size)), np.float32), [*of.matrices(genomes)]
    for _ in range(20):
        readings = rng.random((5, 3)).astype(np.float32)
        outputs, memory = function.forward(TERMS, matrices, readings, memory)
        assert [*outputs] == [engine(row) for engine, row in zip(engines, readings, strict=True)]


def test_a_run_does_not_depend_on_those_beside_it() -> None:
    genomes = OF.draw(40, np.random.default_rng(2)) * np.repeat(np.float32([0.05, 1]), (18, 3))
    starts = np.concatenate([START, other_starts()[::16]])[:40]
    held, restless = balance(OF, genomes, starts, 300)
    assert len(set(held)) > 5
    for number in range(40):
        alone = balance(OF, genomes[number : number + 1], starts[number : number + 1], 300)
        assert (alone[0][0], alone[1][0]) == (held[number], restless[number])


def test_who_falls_before_the_hundredth_tick_has_the_ticks_alone() -> None:
    scores, held = scored(OF, OF.draw(50, np.random.default_rng(3)))
    early = held < 100
    assert early.any()
    assert np.array_equal(scores[early], 0.1 * held[early] / 1000)


def test_the_other_starts_are_gruaus() -> None:
    starts = other_starts()
    assert starts.shape == (625, 6)
    assert len(np.unique(starts, axis=0)) == 625
    assert starts[-1] == pytest.approx([0.9 * 2.16, 0.9 * 1.35, 0.9 * 0.0628318, 0.9 * 0.15009752, 0, 0], rel=1e-4)
    assert starts.sum(axis=0) == pytest.approx(np.zeros(6), abs=1e-9)


def test_a_trial_does_the_same_again_and_is_read_from_its_log(tmp_path: Path) -> None:
    learner = "evolution_strategy population 8 mutation 1 founders 10 patience 5 generations"
    trial = Trial(SAYS["elman"], learner, 200, 1)
    first, second = (asdict(tried(trial)) | {"seconds": 0} for _ in range(2))
    assert first == second
    assert first["evaluations"] >= 200
    assert first["begun"] > 1
    line = json.dumps({"trial": asdict(trial), "outcome": first})
    (tmp_path / "log").write_text(f"{line}\n{line[:40]}")
    assert read(tmp_path / "log") == {trial: Outcome(**first)}
    assert read(tmp_path / "none") == {}
