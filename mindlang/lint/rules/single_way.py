"""An actuator that several skills drive, all of which stand below one skill.

That one is a single point of failure: whenever it has no influence, all those skills have none either, and the actuator
rests at its neutral, however many drive it. An actuator with one driver is meant to be that driver's, and a skill that
is always influenced (`at 1`, without a condition) is never the cause.
"""

from networkx import immediate_dominators

from mindlang.compiler.model import Node
from mindlang.lint.intervals import is_constant
from mindlang.lint.study import Finding, Found, Study

PARTS = """
sensor eye is range_finder at 0 deg
actuator neck is wheel side left neutral 0.5
master Live
skill Up is rule
  drives neck at 1
skill Down is rule
  drives neck at 0
skill Look is rule
  reads eye
  influences Up at eye
  influences Down at 1 - eye
skill Live is rule
  reads eye
"""
GOOD = (f"{PARTS}  influences Look at 1\n", f"{PARTS}  influences Look at eye\n  influences Up at 0.1\n")
BAD = f"{PARTS}  influences Look at eye\n"


def check(study: Study) -> Found:
    """Actuators of several drivers that the master reaches through one skill alone, on the line that lets that act."""
    master = Node("skill", study.mind.master)
    graph = study.mind.hierarchy
    above = immediate_dominators(graph, master)
    for actuator in (Node("actuator", each.name) for each in study.mind.actuators):
        gate = above.get(actuator, master)
        if gate == master or graph.in_degree(actuator) < 2 or graph.has_edge(gate, actuator):
            continue
        ways = [(each, edge) for each in study.mind.skills for edge in each.edges if edge.target == gate.name]
        edges = [edge for _, edge in ways]
        is_always = edges and edges[0].gate is None and edges[0].at and is_constant(edges[0].at)
        is_always = is_always and not ways[0][0].chooses
        if len(edges) == 1 and not is_always:
            message = f"All that drives {actuator.name} stands below {gate.name}, which is influenced here alone."
            hint = f"Let another skill drive {actuator.name}, or say # noqa: single-way if it may rest at its neutral."
            yield Finding(edges[0].fact.span, message, hint)
