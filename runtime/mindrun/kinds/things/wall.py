"""A wall from place to place."""

from collections.abc import Iterator
from dataclasses import replace
from itertools import pairwise
from typing import Annotated

from mindrun.kinds.registry import kind
from mindrun.kinds.scenes.scene import SceneKind
from mindrun.kinds.things.thing import Rectangle, ThingKind, ThingMistake, outside
from mindrun.numbers.quantity import LENGTH, Places

THICKNESS = replace(LENGTH, low=0.01, high=1000.0)


@kind("content", "wall")
class Wall(ThingKind):
    """A solid wall along the places that `from` names, one after the other; each stretch lies along an axis."""

    from_: Places
    thickness: Annotated[float, THICKNESS] = 1.0

    is_obstacle = True
    is_solid = True
    unplaceable = "Draw walls with #, and write another letter for what stands there."

    def obstacles(self, scene: SceneKind | None) -> int:
        return len(self.from_) - 1

    @property
    def walls(self) -> tuple[Rectangle, ...]:  # type: ignore[override]
        return tuple(self._stretches())

    def _stretches(self) -> Iterator[Rectangle]:
        half, last = self.thickness / 2, len(self.from_) - 2
        for number, ((x, y), (to_x, to_y)) in enumerate(pairwise(self.from_)):
            before, behind = half * (number > 0), half * (number < last)
            if y == to_y:
                left, right = (x - before, to_x + behind) if x < to_x else (to_x - behind, x + before)
                yield Rectangle((left + right) / 2, y, (right - left) / 2, half)
            else:
                low, high = (y - before, to_y + behind) if y < to_y else (to_y - behind, y + before)
                yield Rectangle(x, (low + high) / 2, half, (high - low) / 2)

    def mistake(self, scene: SceneKind | None) -> ThingMistake | None:
        if len(self.from_) < 2 or any(place == next_ for place, next_ in pairwise(self.from_)):
            hint = "Write where it begins and where it ends: wall from -20 10 to 5 10."
            return ThingMistake("endless-wall", "This wall does not go anywhere.", hint)
        for (x, y), (to_x, to_y) in pairwise(self.from_):
            if x != to_x and y != to_y:
                hint = f"Make it of walls along the axes: wall from {x:g} {y:g} to {to_x:g} {y:g} to {to_x:g} {to_y:g}."
                return ThingMistake("slanting-wall", "This wall does not lie along an axis.", hint)
        return outside(scene, self.from_, 0.0, "Write places that are in it, or on its border; 0 0 is the middle.")
