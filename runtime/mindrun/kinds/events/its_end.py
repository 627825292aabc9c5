"""An environment has come to its end."""

from mindrun.kinds.events.event import EventKind
from mindrun.kinds.registry import kind


@kind("event", "its end")
class ItsEnd(EventKind):
    """The Gymnasium environment has come to an end of its own (terminated); no further step can be made in it.

    One that breaks a run off (truncated) does not end in this sense, and the run lasted its time.
    """

    is_outside = True
