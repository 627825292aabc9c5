"""An influence on a skill that another line reaches as well.

Influence adds up over all ways (Eq. 2). Where a skill influences another one itself and also through a third, what it
sends through the third can add to the first line, but never take anything back; and whoever learns has two outputs for
one thing. The hierarchy without such lines is its transitive reduction. In a hierarchy of more than 2,000 skills, which
nobody writes by hand, none are looked for.
"""

from networkx import shortest_path, transitive_reduction

from mindlang.lint.study import Finding, Found, Study

MAX_REDUCED_SKILLS = 2000  # above which the reduction takes longer than anybody waits for lint
HIERARCHY = """
sensor eye is range_finder at 0 deg
master Live
skill Go is rule
  drives left_wheel at 1
skill Search is rule
  reads eye
  influences Go at eye
"""
GOOD = f"{HIERARCHY}skill Live is rule\n  influences Search at 1\n"
BAD = f"{HIERARCHY}skill Live is rule\n  influences Search at 1\n  influences Go at 0.5\n"


def check(study: Study) -> Found:
    graph = study.mind.influences
    if len(graph) > MAX_REDUCED_SKILLS:
        return
    reduced = transitive_reduction(graph)
    for skill, target, span in graph.edges(data="span"):
        if not reduced.has_edge(skill, target) and not study.skills[skill].like:
            way = " → ".join(shortest_path(reduced, skill, target))
            message = f"{skill} influences {target} itself, and on the way {way}: influence adds up (Eq. 2)."
            hint = "Leave this line out, or say # noqa: redundant-influence where both are meant."
            yield Finding(span, message, hint)
