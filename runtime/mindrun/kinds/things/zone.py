"""A square into which items are delivered."""

from mindrun.kinds.registry import kind
from mindrun.kinds.things.thing import Placed


@kind("content", "zone")
class Zone(Placed):
    """A square of side `size` on the floor, or `count` of them; items are delivered into it.

    When it is `reached` it stays where it is, moves elsewhere with the next size of its schedule, or vanishes for the
    rest of the run.
    """

    is_area = True
    takes_items = True
