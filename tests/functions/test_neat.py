"""A network whose links are learnt: what it computes, how it grows, and that a training goes on as if never stopped."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from mindrun.engine.engine import Engine
from mindrun.graph.policy import Policy
from mindrun.kinds.functions.mlp import Mlp
from mindrun.kinds.functions.neat import Neat
from mindrun.kinds.learners import EvolutionStrategy, Genetic
from mindrun.numbers.links import LEAST_WEIGHT
from mindrun.sim.rollout import Rollout
from mindrun.train.ask_and_tell import ask, breed, tell
from mindrun.train.heredity import Heredity, Part, heredity_of
from mindrun.train.population import Population, empty_population
from mindrun.train.species import choose_parents, species_of

from tests.functions.test_recurrent import MIND, follow, mind

INPUTS, OUTPUTS, MOST = 3, 2, 5
NOBODY = np.empty((0, Neat(MOST).genome_length(INPUTS, OUTPUTS)), np.float32)
networks = st.builds(Neat, st.just(MOST), st.sampled_from(["forward", "any"]), st.integers(0, 1), st.integers(0, 1))


def heredity(function: Neat) -> Heredity:
    """That of genomes of one skill."""
    return Heredity((Part(slice(None), function, OUTPUTS),))


def bred(function: Neat, generations: int, learner: Genetic, seed: int = 1) -> np.ndarray:
    """The genomes after so many generations in which luck decides."""
    of, rng = heredity(function), np.random.default_rng(seed)
    genomes = function.draw(INPUTS, OUTPUTS, learner.population, rng)
    for number in range(generations):
        genomes = breed(Population(genomes, rng.normal(size=len(genomes)), number + 1), learner, rng, of)
    return genomes


@pytest.mark.parametrize("links", ["forward", "any"])
def test_it_is_what_plain_python_says(links: str) -> None:
    """Neuron after neuron, in place: one before has said something new, one behind has not yet."""
    function, rng = Neat(MOST, links), np.random.default_rng(1)  # type: ignore[arg-type]
    genome = rng.normal(0, 2, function.genome_length(INPUTS, OUTPUTS)).astype(np.float32)
    rows = genome.reshape(MOST + OUTPUTS, 1 + INPUTS + MOST).tolist()
    ready, said = function.ready(INPUTS, OUTPUTS, genome, {}), [0.0] * MOST
    for _ in range(20):
        inputs = rng.random(INPUTS).astype(np.float32)
        for neuron in range(MOST):
            heard = said if links == "any" else [*said[:neuron], *[0.0] * (MOST - neuron)]
            said[neuron] = 1 / (1 + np.exp(-np.dot(rows[neuron], [1, *inputs.tolist(), *heard])))
        expected = [np.dot(row, [1, *inputs.tolist(), *said]) for row in rows[MOST:]]
        assert ready(inputs) == pytest.approx(expected, abs=2e-4)


@pytest.mark.parametrize("links", ["forward", "any"])
def test_for_ten_thousand_ticks_the_lanes_are_the_engine(links: str) -> None:
    text = MIND.replace("elman width 5", f"neat most 5 links {links}").replace("300 ticks", "10000 ticks")
    graph = mind(text.replace("  ends on collision\n", ""))
    roam = next(skill for skill in graph.skills if skill.name == "Roam")
    genome = np.random.default_rng(1).normal(0, 2, roam.function.genome_length(4, 2)).astype(np.float32)
    rollout = Rollout(Policy(graph, {}), "World", "Top", ["Roam"])
    assert follow(rollout, Engine(Policy(graph, {"Roam": genome})), 1, genome) == 10_000


@given(networks, st.integers(0, 2**32 - 1))
def test_what_grows_keeps_its_form(function: Neat, seed: int) -> None:
    """No link where none may be, no neuron that leads nowhere for long, and room is not exceeded."""
    genomes = bred(function, 30, Genetic(population=12, grow=0.5, link=0.5, drop=0.3, species=3), seed)
    assert genomes.dtype == np.float32
    for genome in genomes:
        links = function.network(genome, OUTPUTS)
        assert not links.cells[~links.allowed].any()
        assert not (links.used & ~links.live).any()
    assert len({np.count_nonzero(genome) for genome in genomes}) > 1


@given(networks, st.integers(0, 2**32 - 1))
def test_a_split_hardly_changes_what_is_sent_and_equal_splits_take_the_same_place(function: Neat, seed: int) -> None:
    rng = np.random.default_rng(seed)
    genome = function.draw(INPUTS, OUTPUTS, 1, rng)[0]
    links = function.network(genome.copy(), OUTPUTS)
    before = np.count_nonzero(links.cells)
    links.split(np.random.default_rng(seed))
    biases = function.bias * (not function.centred)
    assert np.count_nonzero(links.cells) == before + 1 + biases  # its link and its bias; the old one is gone
    assert int(links.used.sum()) == 1
    other = function.network(function.draw(INPUTS, OUTPUTS, 1, rng)[0], OUTPUTS)
    other.split(np.random.default_rng(seed))
    assert np.array_equal(other.cells != 0, links.cells != 0)


def test_a_full_network_takes_no_neuron_and_one_without_links_none_either() -> None:
    function = Neat(1)
    genome = np.ones(function.genome_length(1, 1), np.float32)
    links = function.network(genome, 1)
    for way in (links.split, lambda rng: links.join(1.0, rng)):
        before = links.cells.copy()
        way(np.random.default_rng(1))
        assert np.array_equal(links.cells[links.allowed], before[links.allowed])
    empty = function.network(np.zeros_like(genome), 1)
    empty.split(np.random.default_rng(1))
    empty.lose(np.random.default_rng(1))
    assert not empty.cells.any()


def test_what_is_no_link_stays_none_whoever_learns() -> None:
    function = Neat(MOST)
    start, rng = function.draw(INPUTS, OUTPUTS, 1, np.random.default_rng(1)), np.random.default_rng(2)
    for learner in (EvolutionStrategy(), Genetic(octaves=3, mutated=1.0, grow=0, link=0, drop=0)):
        found = ask(empty_population(start.size), learner, start, lambda count, rng: start, rng, heredity(function))
        assert ((found != 0) == (start != 0)).all()
        assert (found != start)[1:, start[0] != 0].mean() > 0.5
    steps = np.where(start == 0, 1, -start)
    assert set(np.unique(function.moved(start, steps))) == {0, LEAST_WEIGHT}


def test_a_child_has_the_links_of_the_better_parent() -> None:
    better, worse = np.float32([[1, 2, 0, 4, 0]]), np.float32([[9, 8, 7, 0, 0]])
    first, is_better = np.array([[True, False, True, False, True]]), np.array([[True]])
    assert Neat().crossed(better, worse, first, is_better).tolist() == [[1, 8, 0, 4, 0]]
    assert Neat().crossed(better, worse, first, ~is_better).tolist() == [[1, 8, 7, 0, 0]]
    assert Mlp().crossed(better, worse, first, is_better).tolist() == [[1, 8, 0, 0, 0]]


def test_species_are_about_as_many_as_are_wanted_and_led_by_their_best() -> None:
    function = Neat(MOST)
    genomes = bred(function, 40, Genetic(population=60, grow=0.3, link=0.3))
    for wanted in (1, 4, 9):
        leaders, species = species_of(genomes, wanted, heredity(function).distance)
        assert 1 <= len(leaders) <= wanted
        assert [int(np.flatnonzero(species == each)[0]) for each in range(len(leaders))] == leaders.tolist()
        assert wanted == 1 or len(leaders) > wanted / 2
        mothers, fathers = choose_parents(species, 4, 500, np.random.default_rng(1))
        assert np.array_equal(species[mothers], species[fathers])
    alike, of = species_of(genomes[:1].repeat(5, axis=0), 3, heredity(function).distance)
    assert (alike.tolist(), of.tolist()) == ([0], [0] * 5)


def test_leaders_survive() -> None:
    function, learner = Neat(MOST), Genetic(population=40, species=4, grow=0.3, link=0.3)
    genomes = bred(function, 20, learner)
    told = tell(Population(genomes, np.zeros(40), 1), learner, NOBODY, genomes, -np.arange(40.0))
    leaders, _ = species_of(genomes, 4, heredity(function).distance)
    children = breed(told, learner, np.random.default_rng(1), heredity(function))
    assert len(leaders) > 1
    assert all((children[:4] == genomes[leader]).all(axis=1).any() for leader in leaders)


def test_each_skill_of_a_lesson_has_its_own_part() -> None:
    graph = mind(MIND.replace("elman width 5", "neat most 3"))
    [part] = heredity_of(Rollout(Policy(graph, {}), "World", "Top", ["Roam"])).parts
    assert (part.function, part.place) == (Neat(3), slice(0, 8 * 5))
    both = Heredity((Part(slice(0, 6), Mlp(), 2), Part(slice(6, 6 + NOBODY.shape[1]), Neat(MOST), OUTPUTS)))
    drawn = Neat(MOST).draw(INPUTS, OUTPUTS, 1, np.random.default_rng(1))
    start = np.concatenate([np.zeros((1, 6), np.float32), drawn], axis=1)
    moved = both.moved(start, np.ones_like(start))
    assert np.array_equal(moved != 0, np.concatenate([np.ones((1, 6), bool), start[:, 6:] != 0], 1))
    assert both.distance(start, start[0]) == 0


def test_more_room_does_the_same() -> None:
    old, new = Neat(3), Neat(MOST, "any")
    genome = np.random.default_rng(1).normal(0, 2, old.genome_length(4, 2)).astype(np.float32)
    wide = old.widened(genome, (4, 2), new, (6, 3))
    assert wide is not None
    rows = np.random.default_rng(2).random((9, 6)).astype(np.float32)
    wider = new.ready(6, 3, wide, {})
    before = old.ready(4, 2, genome, {})(rows[:, :4])
    assert np.array_equal(before, [wider(row)[:2] for row in rows])
    assert new.widened(wide, (6, 3), replace(new, links="forward"), (6, 3)) is None
    assert new.widened(wide, (6, 3), Neat(3, "any"), (9, 9)) is None
