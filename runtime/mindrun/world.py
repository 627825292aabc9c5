"""Kinds that make a task's world: bodies, scenes and what they contain."""

from dataclasses import dataclass
from typing import Annotated

from mindrun.quantity import LENGTH, UNSAID, Quantity, Reference, Span
from mindrun.registry import kind

DIAMETER = Quantity("a length in world units", {"": 1.0}, low=0.01, high=1000.0)
SIDE = Quantity("a length in world units", {"": 1.0}, low=0.01, high=1e5)
DENSITY = Quantity("a density", {"": 1.0}, low=1e-3, high=1e6)
DAMPING = Quantity("a damping", {"": 1.0}, low=0.0, high=1e6)
MANY = Quantity("a whole number", {"": 1.0}, low=0, high=1000, whole=True)


@kind("body", "disc")
@dataclass(frozen=True, slots=True)
class Disc:
    """A round body of diameter `size`; every tick of length dt its velocity is divided by 1 + dt·damping."""

    size: Annotated[float, DIAMETER] = 2.0
    density: Annotated[float, DENSITY] = 2.0
    linear_damping: Annotated[float, DAMPING] = 5.0
    angular_damping: Annotated[float, DAMPING] = 20.0


@kind("task", "plain")
@dataclass(frozen=True, slots=True)
class Plain:
    """A world without borders; the robot starts in its origin."""


@kind("task", "arena")
@dataclass(frozen=True, slots=True)
class Arena:
    """A square world of side `size` with walls; the robot starts anywhere in it."""

    size: Annotated[float, SIDE] = 100.0


ONE = Span(1.0, 1.0)
NEAR = UNSAID  # a plain scene: 10 to 40; an arena: at least 10
STAYS, MOVES, VANISHES = OUTCOMES = ("stays", "moves", "vanishes")
OUTCOME = Reference("outcome", OUTCOMES)


@kind("content", "item")
@dataclass(frozen=True, slots=True)
class Item:
    """A disc of diameter `size` that the claw can take. `away` is its distance from the robot when it is placed.

    When it is `reached` or `delivered` it stays as it is (in the claw, where that holds it), moves elsewhere with the
    next size of its schedule, or vanishes for the rest of the run.
    """

    size: Annotated[Span, LENGTH] = ONE
    away: Annotated[Span, LENGTH] = NEAR
    reached: Annotated[str, OUTCOME] = STAYS
    delivered: Annotated[str, OUTCOME] = MOVES


@kind("content", "zone")
@dataclass(frozen=True, slots=True)
class Zone:
    """A square of side `size` on the floor; items are delivered into it.

    When it is `reached` it stays where it is, moves elsewhere with the next size of its schedule, or vanishes for the
    rest of the run.
    """

    size: Annotated[Span, LENGTH] = ONE
    away: Annotated[Span, LENGTH] = NEAR
    reached: Annotated[str, OUTCOME] = STAYS


@kind("content", "power")
@dataclass(frozen=True, slots=True)
class Power:
    """A square of side `size` on the floor in which the battery charges. `reached` is as for a zone."""

    size: Annotated[Span, LENGTH] = ONE
    away: Annotated[Span, LENGTH] = NEAR
    reached: Annotated[str, OUTCOME] = STAYS


@kind("content", "obstacle")
@dataclass(frozen=True, slots=True)
class Obstacle:
    """Solid squares of side `size`: `count` of them anywhere, or one at each point of a `grid` of that spacing.

    Each stands up to `jitter` off its point, both ways along both axes.
    """

    size: Annotated[Span, LENGTH] = ONE
    grid: Annotated[float, LENGTH] = 0.0
    jitter: Annotated[float, LENGTH] = 0.0
    count: Annotated[int, MANY] = 0
    away: Annotated[Span, LENGTH] = NEAR


Content = Item | Zone | Power | Obstacle
Scene = Plain | Arena

MOST_OBSTACLES, MOST_THINGS = 2500, 100  # in one world, which looks at all of its things in every tick
ENDLESS = 1e9  # lines of a grid, far more than can be


def grid_lines(obstacle: Obstacle, scene: Scene) -> int:
    """How many lines of an obstacle's grid cross an arena, none on its walls; there is no grid without walls."""
    if isinstance(scene, Arena) and obstacle.grid:
        return max(0, round(min(scene.size / obstacle.grid, ENDLESS)) - 1)
    return 0


def obstacle_count(obstacle: Obstacle, scene: Scene) -> int:
    """How many squares an obstacle of a scene is."""
    return grid_lines(obstacle, scene) ** 2 if obstacle.grid else obstacle.count
