"""Places: where something can be at all."""

from mindrun.sim.codes import FAR
from mindrun.sim.compiling import compiled


@compiled
def within(x, y, angle):
    """Whether Chipmunk can say anything of such a place; not where it is no number."""
    return (abs(x) <= FAR) & (abs(y) <= FAR) & (abs(angle) <= FAR)
