"""Solid things that are not fixed: they are pushed, and may drive themselves."""

from dataclasses import dataclass, replace
from typing import Annotated

from mindrun.kinds.bodies.body import Damping, Density
from mindrun.kinds.registry import kind, left_out
from mindrun.kinds.scenes.scene import SceneKind
from mindrun.kinds.things.thing import DEFAULT_DISTANCE, DEFAULT_SIZE, MOVES, SPEED, Aiming, Becomes, ThingMistake
from mindrun.numbers.quantity import POSITIVE, Quantity, Ratio, Span

LOOSE_SIZE = Quantity("a length in world units", {"": 1.0}, low=0.01, high=1000.0)
FORCE = replace(POSITIVE, name="a force")
DEFAULT_FRICTION, DEFAULT_SPEED, DEFAULT_THRUST = 0.5, 1.0, 80.0  # as a walker is fast, and as a wheel pushes
HALF_DIAGONAL = 0.7071  # of a square with side 1, and a little less


class _Varying:
    """The arguments that can differ from run to run: of what does not drive itself none that say how it does."""

    def __get__(self, thing: "Loose | None", kind: type["Loose"]) -> tuple[str, ...]:
        return ("density", "friction", "damping", *(("speed", "thrust") if thing is None or thing.thing else ()))


@dataclass(frozen=True, slots=True)
class Loose(Aiming):
    """A solid thing that is not fixed: the robot pushes it, and so does what it pushes.

    Every tick of length dt its velocity and its spin are divided by 1 + dt·damping. Where two things touch, the product
    of their `friction` counts; the robot's is 0.2, that of walls and obstacles 1.
    """

    size: Annotated[Span, LOOSE_SIZE] = DEFAULT_SIZE
    density: Density = 0.5
    friction: Ratio = DEFAULT_FRICTION
    damping: Damping = 5.0
    delivered: Becomes = MOVES
    speed: Annotated[float, SPEED] = left_out(DEFAULT_SPEED)
    thrust: Annotated[float, FORCE] = left_out(DEFAULT_THRUST)

    varying = _Varying()
    is_solid = True
    is_loose = True
    can_be_delivered = True

    def mistake(self, scene: SceneKind | None) -> ThingMistake | None:
        if mistake := self.aim_mistake():
            return mistake
        if not self.thing and (self.speed, self.thrust) != (DEFAULT_SPEED, DEFAULT_THRUST):
            hint = "Write seeks or flees, and of what: seeks robot speed 4."
            return ThingMistake(
                "aimless-drive", "A speed and a thrust say how it drives itself, and it does not.", hint
            )
        extent = self.largest * (0.5 if self.is_round else HALF_DIAGONAL)
        if self.away != DEFAULT_DISTANCE and max(self.away.first, self.away.last) < extent:
            hint = f"Write away {self.largest:g} to {self.largest + 20:g}: it is {self.largest:g} large."
            return ThingMistake("on-the-robot", "So near, it would stand on the robot.", hint)
        return Aiming.mistake(self, scene)


@kind("content", "box")
class LooseBox(Loose):
    """A solid square of side `size` that can be pushed, and turns as it is pushed.

    Each tick of length dt divides its velocity and its spin by 1 + dt·damping. `friction` multiplies with that of what
    it touches: the robot's is 0.2, a wall's and an obstacle's 1. It is `reached` when the claw could take it if it were
    an item, and `delivered` when its middle is pushed into a zone: it stays, moves elsewhere or vanishes.

    One that `seeks` or `flees` the robot, or the nearest thing of a name, drives itself while that is in its `range`:
    each tick a force acts on its middle that would let it move at `speed` straight towards it, or away from it, and
    that is at most `thrust`. It goes no farther than to the middle of what it seeks.
    """


@kind("content", "ball")
class Ball(Loose):
    """A solid disc of diameter `size` that can be pushed, and rolls on for a while; all else is as of a box."""

    density: Density = 0.2
    damping: Damping = 1.0

    is_round = True
