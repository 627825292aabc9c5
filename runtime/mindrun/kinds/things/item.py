"""A thing that a claw can take."""

from typing import Annotated

from mindrun.kinds.registry import kind
from mindrun.kinds.things.thing import MOVES, OUTCOME, Outcome, Placed


@kind("content", "item")
class Item(Placed):
    """A disc of diameter `size` that the claw can take, or `count` of them, `away` from the robot or `at` a place.

    When it is `reached` or `delivered` it stays as it is (in the claw, where that holds it), moves elsewhere with the
    next size of its schedule, or vanishes for the rest of the run.
    """

    delivered: Annotated[Outcome, OUTCOME] = MOVES

    can_be_held = True
    can_be_delivered = True
    is_round = True
