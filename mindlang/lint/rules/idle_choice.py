"""A choice that is none: of one subskill alone, or of one that never is greatest.

A skill that `chooses one` sends 1 over the greatest of its influences and 0 over all others. Where it has one line that
is always the greatest, and where a value never is, the skill behind it never acts, or always.
"""

from mindlang.compiler.model import Edge
from mindlang.lint.intervals import interval
from mindlang.lint.study import Finding, Found, Study

PARTS = """
master Live
sensor eye is range_finder at 0 deg
skill Go is rule
  drives left_wheel at 1
skill Stop is rule
  drives left_wheel at 0.5
skill Live is rule
  reads eye
  chooses one
  influences Go at 0.5
"""
GOOD = (f"{PARTS}  influences Stop at eye\n", f"{PARTS}  influences Stop at 1 when eye > 0.9\n")
BAD = (PARTS, f"{PARTS}  influences Stop at eye / 4\n")


def check(study: Study) -> Found:
    for skill in (each for each in study.mind.skills if each.chooses and not each.like):
        edges = [edge for edge in skill.edges if edge.to == "skill"]
        for edge in edges if len(edges) == 1 and edges[0].gate is None else ():
            message = f"{skill.name} has {edge.target} alone to choose."
            hint = "Add another influence, or say influences … at 1, and no chooses one."
            yield Finding(edge.fact.span, message, hint)
        for edge in edges:
            sure = (other for other in edges if other is not edge and (other.gate is None or other.gate.otherwise))
            winner = next((other for other in sure if _greatest(edge) < _least(other)), None)
            if winner:
                message = f"{skill.name} never chooses {edge.target}: {winner.target} is always greater."
                yield Finding(edge.fact.span, message, "Give the two values of which each can be the greater one.")


def _least(edge: Edge) -> float:
    return min((interval(value)[0] for value in edge.values), default=-float("inf")) if edge.at else -float("inf")


def _greatest(edge: Edge) -> float:
    return max((interval(value)[1] for value in edge.values), default=float("inf")) if edge.at else float("inf")
