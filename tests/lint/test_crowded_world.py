"""What `crowded-world` says of a world is what the lanes make of it: where it has nothing to say, all finds a place."""

from pathlib import Path

import numpy as np
import pytest
from mindrun.graph.policy import Policy
from mindrun.sim.rollout import Rollout
from mindrun.sim.trace import trace

from mindlang.compiler.compile import load
from mindlang.lint.lint import lint
from tests.lint.examples import whole
from tests.lint.minds import BINS, CROWDED

SEEDS = range(1, 21)
WORLDS = [
    *CROWDED,
    BINS.format(100, 60),
    BINS.format(45, 0).replace("  contains rock is obstacle count 0 size 3\n", ""),
    BINS.format(22, 0).replace("  contains rock is obstacle count 0 size 3\n", ""),
    BINS.format(60, 1).replace("count 1 size 3", "grid 20 size 2 to 4 jitter 3"),
    BINS.format(60, 1).replace("count 1 size 3", "grid 10 size 3"),
    BINS.format(60, 1).replace("away 0 to 100", "away 8 to 10"),
    *(BINS.format(60, 1) + f"  contains mate is robot count {count}\n" for count in (8, 40)),
    BINS.format(60, 1) + "  contains mate is robot count 3 away 8 to 20\n",
]


@pytest.mark.parametrize("text", WORLDS)
def test_it_says_what_the_lanes_do(text: str, tmp_path: Path) -> None:
    compiled = load(whole(text, tmp_path))
    assert compiled.graph
    rollout = Rollout(Policy(compiled.graph, {}), "Sort", compiled.graph.master)
    worlds = [trace(rollout, seed) for seed in SEEDS]
    covering = [seed for seed, each in zip(SEEDS, worlds, strict=True) if is_covered(each.things, each.boxes)]
    assert bool(lint(compiled, ["crowded-world"])) == bool(covering), covering


def test_the_cheaper_a_world_is_the_more_are_drawn(tmp_path: Path) -> None:
    said = [lint(load(whole(text, tmp_path)), ["crowded-world"])[0].message for text in CROWDED[1:]]
    few, many = (int(message.split(" worlds")[0].split()[-1]) for message in (said[1], said[0]))
    assert 1 < few < many


def is_covered(things: np.ndarray, boxes: np.ndarray) -> bool:
    """Whether a thing covers another, or part of an obstacle."""
    squares = [(x, y, size / 2, size / 2) for x, y, size in things]
    pairs = [(one, other) for number, one in enumerate(squares) for other in [*squares[:number], *map(tuple, boxes)]]
    return any(abs(a - c) < e + g - 1e-9 and abs(b - d) < f + h - 1e-9 for (a, b, e, f), (c, d, g, h) in pairs)
