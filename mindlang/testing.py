"""A kind of one's own held against what the program asks of it: for the tests of the package that brings it."""

from dataclasses import replace
from itertools import count
from pathlib import Path

import numpy as np
from mindrun.engine.engine import Engine
from mindrun.graph.codec import decode, encode
from mindrun.graph.graph import Graph, Skill
from mindrun.graph.policy import Policy
from mindrun.graph.weights import genes
from mindrun.kinds.functions.function import Function
from mindrun.kinds.registry import names
from mindrun.numbers.arrays import Array, Singles
from mindrun.sim.rollout import Rollout
from mindrun.sim.trace import trace

from mindlang.compiler.compile import compile_source
from mindlang.compiler.source import Source

FINDERS_AND_MEMORIES = (
    (1, 1),
    (3, 2),
    (9, 5),
)  # range finders that it reads, and memories that it drives beside both wheels
WEIGHT_SCALES = (1.0, 0.0, 1e-3, 1e2, 1e30)  # of the weights, one after the other
GRID_STEPS = 16.0  # weights and inputs on such a grid have the same sums in any order
WORLD = """
tick 1/60 s
master Top
body Robot is disc
actuator left_wheel is wheel side left neutral 0.5
actuator right_wheel is wheel side right neutral 0.5
sensor feelers is range_finder at {angles} deg
sensor ball_bearing is bearing of ball
sensor pulse is sine period 1/3 s
{cells}
skill Top is rule
  reads pulse
  reads ball_bearing
  influences Own at 4 * pulse * ball_bearing - 1
skill Own is mlp
  reads feelers
  drives left_wheel
  drives right_wheel
{driven}
task World in arena size 30
  contains ball is item
  lasts 200 ticks
  rewards progress toward ball per tick
curriculum All is genetic
  teaches Own on World under Top for 3 generations
"""


def check_kind(kind: type[Function] | Function, rows: int = 10_000, seed: int = 1) -> None:
    """Raise AssertionError unless a function, or a kind with its defaults, does all that the program relies on.

    In `rows` ticks of runs of three sizes, with weights of five scales, the simulator does what the engine does, to the
    bit; a run gives the same in whatever company; the engine begins anew after a reset; inputs and outputs in another
    order mean the same; and the function can be written to a bundle.
    """
    function = kind() if isinstance(kind, type) else kind
    name = names().get(type(function))
    _hold(name is not None, f"{type(function).__name__} is no kind: it has no @kind above it")
    _hold(decode(Function, encode(function), "it") == function, f"{name} is not read as it was written")
    for size in FINDERS_AND_MEMORIES:
        graph, rng = _graph(function, *size), np.random.default_rng(seed)
        skill = next(each for each in graph.skills if each.name == "Own")
        _agrees(f"{name} with {len(skill.inputs)} inputs", graph, skill, rows // len(FINDERS_AND_MEMORIES), rng)
        if genes(skill):
            _meets_nobody(str(name), graph, skill, rng)
        _can_be_reordered(str(name), skill, rng)


def _hold(holds: bool, otherwise: str) -> None:
    if not holds:
        raise AssertionError(otherwise)


def _graph(function: Function, finders: int, cells: int) -> Graph:
    angles = " ".join(f"{20 * number}" for number in range(finders))
    declared = "\n".join(f"memory m{number} is cell decay 0.5" for number in range(cells))
    driven = "\n".join(f"  drives m{number}" for number in range(cells))
    text = WORLD.format(angles=angles, cells=declared, driven=driven)
    graph = compile_source(Source("own.mind", text), Path("own.mind")).graph
    assert graph is not None
    skills = (replace(skill, function=function) if skill.name == "Own" else skill for skill in graph.skills)
    return replace(graph, skills=tuple(skills))


def _genome(skill: Skill, scale: float, rng: np.random.Generator) -> Singles:
    drawn = skill.function.draw(len(skill.inputs), skill.outputs, 1, rng)[0]
    _hold(drawn.shape == (genes(skill),), f"draw gives weights of the shape {drawn.shape} instead of ({genes(skill)},)")
    genome: Singles = (drawn * np.float32(scale)).astype(np.float32)
    return genome


def _agrees(name: str, graph: Graph, skill: Skill, rows: int, rng: np.random.Generator) -> None:
    """Hold runs of the simulator against the engine, tick by tick; and the engine after a reset against itself."""
    learns, ticks = genes(skill) > 0, 0
    rollout = Rollout(Policy(graph, {}), "World", "Top", ["Own"] if learns else [])
    for run in count():
        genome = _genome(skill, WEIGHT_SCALES[run % len(WEIGHT_SCALES)], rng)
        engine = Engine(Policy(graph, {"Own": genome} if learns else {}))
        moments = [*trace(rollout, run, genome).moments]
        first = [engine.tick(moment.readings) for moment in moments]
        engine.reset()
        again = [engine.tick(moment.readings) for moment in moments]
        for tick, (moment, said) in enumerate(zip(moments, first, strict=True), 1):
            there = f"in tick {tick} of run {run}"
            _hold(
                _same(moment.commands, said),
                f"{name}: the simulator commands {moment.commands}, the engine {said}, {there}",
            )
        _hold(
            all(map(_same, first, again)),
            f"{name}: after a reset run {run} is another: it remembers more than its state",
        )
        if (ticks := ticks + len(moments)) >= rows:
            return


def _meets_nobody(name: str, graph: Graph, skill: Skill, rng: np.random.Generator) -> None:
    """Hold the scores of runs that are made side by side against those of each alone."""
    genomes = np.stack([_genome(skill, 1.0, rng) for _ in range(5)])
    many, alone = (
        Rollout(Policy(graph, {}), "World", "Top", ["Own"], lanes=lanes).score(genomes, range(2)).total
        for lanes in (16, 1)
    )
    _hold(_same(many, alone), f"{name}: a run depends on those beside it: apply each row by itself")


def _can_be_reordered(name: str, skill: Skill, rng: np.random.Generator) -> None:
    inputs, outputs = len(skill.inputs), skill.outputs
    genome = np.rint(_genome(skill, 1.0, rng) * GRID_STEPS) / np.float32(GRID_STEPS)
    reads, sends = rng.permutation(inputs).tolist(), rng.permutation(outputs).tolist()
    one = skill.function.ready(inputs, outputs, genome, {})
    other = skill.function.ready(inputs, outputs, skill.function.reordered(genome, reads, sends), {})
    for _ in range(20):
        values = (rng.integers(0, 17, inputs) / GRID_STEPS).astype(np.float32)
        said, turned = one(values)[sends], other(values[reads])
        _hold(
            bool(np.allclose(said, turned, 1e-4, 1e-4, equal_nan=True)),
            f"{name}: with another order of its lines it gives {turned}, not {said}",
        )


def _same(one: Array, other: Array) -> bool:
    return np.array_equal(one, other, equal_nan=True)
