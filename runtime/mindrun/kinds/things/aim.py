"""What can go straight to something by itself, or away from it."""

from dataclasses import replace

from mindrun.kinds.things.about import AboutThing
from mindrun.kinds.things.thing import ThingMistake
from mindrun.numbers.quantity import FARTHEST_UNITS, POSITIVE

SPEED = replace(POSITIVE, name="a speed in world units per second", high=1e4)


class Aiming(AboutThing):
    """A thing that may go to the robot, or to the nearest thing of a name, or away from it, within its `range`."""

    __slots__ = ()

    seeks = ""
    flees = ""
    range = FARTHEST_UNITS

    @property
    def thing(self) -> str:
        return self.seeks or self.flees

    def aim_mistake(self) -> ThingMistake | None:
        """An error where it has two aims, or a distance without one."""
        aims = [each for each in ("along", "seeks", "flees") if getattr(self, each, ())]
        if len(aims) > 1:
            hint = f"Leave all but one of {' and '.join(aims)} out."
            return ThingMistake("two-aims", "It can go one way at a time.", hint)
        if self.range != FARTHEST_UNITS and not self.thing:
            hint = "Write seeks or flees, and of what: flees robot range 10."
            return ThingMistake(
                "aimless-distance", "A distance says when it seeks or flees, and it does neither.", hint
            )
        return None
