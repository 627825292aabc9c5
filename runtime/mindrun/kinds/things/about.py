"""What a sensor, an event or a measure says of the thing that it is about."""

from mindrun.kinds.registry import arguments
from mindrun.kinds.things.thing import ThingKind
from mindrun.numbers.quantity import THING


class AboutThing:
    """Something that may be about a thing of the task: of any kind but obstacles, if it does not say otherwise."""

    __slots__ = ()

    @property
    def thing(self) -> str:
        """The name of the thing that it is about, which its argument of that type says; empty where it has none."""
        return next((getattr(self, each.field) for each in arguments(type(self)) if each.type is THING), "")

    @staticmethod
    def is_about(kind: type[ThingKind]) -> bool:
        """Whether it can be about things of a kind."""
        return not kind.is_obstacle

    @classmethod
    def accepts(cls, argument: str, kind: type[ThingKind]) -> bool:
        """Whether an argument of it can name things of a kind."""
        return cls.is_about(kind)
