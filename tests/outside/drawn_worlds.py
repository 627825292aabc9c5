"""The drawn environments themselves, registered with Gymnasium."""

from typing import Any

import gymnasium
import numpy as np
from gymnasium import spaces

from tests.outside.drawn import WORLDS, Leaf, Tree, leaves, trees, world_name

STATES = 4  # numbers that a world goes on with
LONGEST = 20  # steps after which one of them breaks off


def space_of(tree: Tree) -> Any:
    """The space of a tree."""
    match tree:
        case dict():
            return spaces.Dict({key: space_of(inner) for key, inner in tree.items()})
        case tuple():
            return spaces.Tuple([space_of(inner) for inner in tree])
        case Leaf(kind="Discrete"):
            return spaces.Discrete(tree.counts[0], start=tree.start)
        case Leaf(kind="MultiDiscrete"):
            return spaces.MultiDiscrete(tree.counts)
        case Leaf(kind="MultiBinary"):
            return spaces.MultiBinary(tree.shape)
    return spaces.Box(*tree.ends, tree.shape, np.dtype(tree.dtype))


class DrawnWorld(gymnasium.Env[Any, Any]):
    """Four numbers that go on by what is done, of which everything is observed; it ends, or breaks off, at times."""

    def __init__(self, number: int) -> None:
        self.trees, self.number = trees(number), number
        self.observation_space, self.action_space = map(space_of, self.trees)

    def reset(self, *, seed: int | None = None, options: Any = None) -> tuple[Any, dict[str, Any]]:
        """Any numbers."""
        super().reset(seed=seed)
        self.state, self.steps = self.np_random.normal(0, 1, STATES), 0
        return self.observed(self.trees[0]), {}

    def step(self, action: Any) -> tuple[Any, Any, bool, bool, dict[str, Any]]:
        """Moved by every number of the action."""
        assert self.action_space.contains(action), action
        self.steps += 1
        pushes = [np.asarray(inside(action, path), np.float64).ravel() for path, _ in leaves(self.trees[1])]
        for place, push in enumerate(np.concatenate(pushes)):
            self.state[place % STATES] += 0.1 * push
        self.state = 0.9 * self.state[::-1] + self.np_random.normal(0, 0.1, STATES)
        ended = bool(self.np_random.random() < 0.05)
        broken_off = self.number % 5 == 0 and self.steps == LONGEST
        return self.observed(self.trees[0]), float(self.state[0]), ended, broken_off, {}

    def observed(self, tree: Tree) -> Any:
        """The state, as a tree of this form."""
        if isinstance(tree, dict):
            return {key: self.observed(inner) for key, inner in tree.items()}
        if isinstance(tree, tuple):
            return tuple(self.observed(inner) for inner in tree)
        numbers = np.resize(self.state, tree.shape or (1,)).astype(np.float64)
        if tree.counts:
            found = np.abs(numbers * 10).astype(np.int64) % np.reshape(tree.counts, tree.shape or (1,)) + tree.start
        else:
            found = np.clip(numbers * (100 if tree.dtype == "uint8" else 1), *tree.ends)
        found = found.astype(tree.dtype)
        return found if tree.shape else found[0] if tree.kind == "Discrete" else found.reshape(())


def inside(value: Any, path: tuple[Any, ...]) -> Any:
    """What keys lead to."""
    for key in path:
        value = value[key]
    return value


def register() -> None:
    """Make them known, once."""
    for number in range(WORLDS):
        if world_name(number) not in gymnasium.registry:
            gymnasium.register(world_name(number), DrawnWorld, kwargs={"number": number})
