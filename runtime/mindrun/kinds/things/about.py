"""What can be about a thing: sensors, events and measures name one among their arguments."""

from mindrun.kinds.registry import arguments
from mindrun.kinds.things.thing import ThingKind
from mindrun.numbers.quantity import THING, Reference

OR = " or "  # between the names of the things that a sensor is about alike


class AboutThing:
    """A sensor, event or measure: it may be about a thing of the task, of any kind but obstacles unless it says."""

    __slots__ = ()

    @property
    def thing(self) -> str:
        """The name of the thing that it is about, or several with OR between, as its argument says; empty for none."""
        return self.named(THING)

    @property
    def things(self) -> tuple[str, ...]:
        """The names of all things that it is about alike: a sensor may have several; none where it has none."""
        return tuple(filter(None, self.thing.split(OR)))

    @property
    def other(self) -> str:
        """The name of the second thing that it is about; empty where it has none, and for the robot."""
        named = [getattr(self, each.field) for each in arguments(type(self)) if each.type is THING]
        return "".join(named[1:2])

    def named(self, reference: Reference) -> str:
        """The value of its first argument of a type; empty where it has none."""
        return next((getattr(self, each.field) for each in arguments(type(self)) if each.type is reference), "")

    @staticmethod
    def is_about(kind: type[ThingKind]) -> bool:
        """True if it can be about things of a kind."""
        return not kind.is_obstacle

    @classmethod
    def accepts(cls, argument: str, kind: type[ThingKind]) -> bool:
        """True if an argument of it can name things of a kind."""
        return cls.is_about(kind)
