"""A policy: a hierarchy with the weights that its skills were taught, which fit in its order alone."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from mindrun.errors import WeightsError
from mindrun.graph.graph import Graph, Skill
from mindrun.graph.named_readings import reading_names
from mindrun.graph.weights import Weights, checked
from mindrun.numbers.short_repr import ShortRepr


@dataclass(frozen=True, slots=True, repr=False)
class Policy(ShortRepr):
    """A graph, and the weights of its skills: all that an engine runs and a rollout simulates.

    `weights` are float32 [genes] by skill, in the order in which `graph` says what the skill reads and sends. A skill
    that a rollout teaches, or that no master reaches, may lack them; skills that are like one another have theirs under
    the name of the one that owns them. WeightsError where some are of no skill of the graph that has its own, are not
    as many as it has, are not finite, or are those of a policy that has them in another order.
    """

    graph: Graph
    weights: Mapping[str, Weights]

    def __post_init__(self) -> None:
        skills = {skill.name: skill for skill in self.graph.skills if not skill.like}
        if strangers := sorted(self.weights.keys() - skills.keys()):
            raise WeightsError(f"there are weights of {strangers[0]}, but no such skill has its own")
        ordered = _Ordered((name, checked(skills[name], weights)) for name, weights in self.weights.items())
        readings = reading_names(self.graph)
        ordered.orders = {name: _order(self.graph, readings, skills[name]) for name in ordered}
        if isinstance(self.weights, _Ordered):
            for name, order in ordered.orders.items():
                if self.weights.orders[name] != order:
                    raise WeightsError(f"the weights of {name} belong to a graph that reads and sends in another order")
        object.__setattr__(self, "weights", ordered)

    def agrees(self, other: "Policy", skill: str) -> bool:
        """True if both have weights of a skill, of the same readings and influences in the same order."""
        mine, theirs = self.weights, other.weights
        assert isinstance(mine, _Ordered)
        assert isinstance(theirs, _Ordered)
        return skill in mine and mine.orders[skill] == theirs.orders.get(skill)


class _Ordered(dict[str, Weights]):
    """The weights of a policy: wherever they go, they know what they read and send, and in which order."""

    orders: Mapping[str, object]


def _order(graph: Graph, readings: Sequence[str], skill: Skill) -> object:
    """The meaning of a skill's weights, in their order: its function, and by name what it reads and sends."""
    sends = [(graph.named(edge.to, edge.target), edge.output) for edge in skill.edges if edge.output is not None]
    return skill.function, [readings[index] for index in skill.inputs], sends
