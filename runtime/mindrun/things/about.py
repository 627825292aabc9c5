"""What a sensor, an event or a measure says of the thing that it is about."""

from mindrun.things.thing import ThingKind


class AboutThing:
    """Something that may be about a thing of the task: one of any kind but obstacles, which are many."""

    __slots__ = ()

    @property
    def thing(self) -> str:
        """The name of the thing that it is about; empty where it is about none."""
        return ""

    @staticmethod
    def is_about(kind: type[ThingKind]) -> bool:
        """Whether it can be about things of a kind."""
        return not kind.is_obstacle
