"""How influence flows: choices, learned influence, and ways that are single or double."""

from collections import Counter

from networkx import DiGraph, dag_longest_path, immediate_dominators, shortest_path, transitive_reduction

from mindlang.compiler.diagnostic import Fix
from mindlang.compiler.hierarchy import with_descendants
from mindlang.compiler.model import Edge, Node
from mindlang.compiler.syntax import Influences
from mindlang.editing.insertion import replace_span
from mindlang.lint.intervals import interval, is_constant
from mindlang.lint.study import Finding, Found, Study, rule

MAX_CHOICES = 6  # the worst leak of 1 % is 0.39 of a command with six, 0.56 with seven


@rule()
def deep_hierarchy(study: Study) -> Found:
    choices = DiGraph()
    for skill in (each for each in study.mind.skills if not each.chooses):
        learnt = [edge.target for edge in skill.edges if edge.to == "skill" and edge.at is None and not edge.cuts]
        if len(learnt) > 1:
            choices.add_edges_from((skill.name, target) for target in learnt)
    way = dag_longest_path(choices)
    if len(way) - 1 > MAX_CHOICES:
        message = f"{len(way) - 1} choices that are learnt stand one below the other: {' → '.join(way)}."
        hint = "mindc prove says how much of a command their leaks can take."
        yield Finding(study.skills[way[0]].span, message, hint)


@rule()
def idle_choice(study: Study) -> Found:
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


@rule()
def idle_influence(study: Study) -> Found:
    sent = (edge for name in study.active for edge in study.skills[name].edges)
    drivers = Counter(edge.target for edge in sent if edge.to != "skill")
    alone: dict[str, str] = {}  # what moves nothing that other active skills move too, with something that it moves
    for skill in study.children_first:
        moved = [alone.get(edge.target, "") if edge.to == "skill" else edge.target for edge in skill.edges]
        if all(drivers[name] == 1 for name in moved):
            alone[skill.name] = moved[0]
    for skill, edge in study.edges:
        if (
            skill.chooses
            or skill.name not in study.active
            or edge.to != "skill"
            or edge.at is not None
            or edge.target not in alone
        ):
            continue
        message = f"How much influence {skill.name} has on {edge.target} makes no difference, only whether it has any."
        unless = "unless it is to learn when it is on and when off (# noqa)"
        mend, fix = "let another skill drive it, too", None
        if sum(other.at is None for other in skill.edges) > 1:
            mend = f"write influences {edge.target} at 1"
            fix = Fix("Write at 1", (replace_span(edge.fact.span, f"{edge.fact.span.text} at 1"),), is_safe=False)
        hint = f"Nobody else drives {alone[edge.target]}, so its command is the same (Eq. 3): {mend}, {unless}."
        yield Finding(edge.fact.span, message, hint, fix=fix)


@rule()
def idle_over(study: Study) -> Found:
    driven = {skill.name: {edge.target for edge in skill.edges if edge.to != "skill"} for skill in study.mind.skills}
    for _, edge in study.edges:
        if not isinstance(edge.fact, Influences) or not edge.over:
            continue
        moved = {name for skill in with_descendants(study.mind.influences, {edge.target}) for name in driven[skill]}
        for name in (each for each in edge.fact.over or () if each.text not in moved):
            hint = f"Name what it drives: {', '.join(sorted(moved)) or 'nothing'}."
            yield Finding(name.span, f"Neither {edge.target} nor a skill below it drives {name.text}.", hint)


MOST_LAYERS = 3  # as many as the paper's largest has


@rule()
def many_layers(study: Study) -> Found:
    for skill in study.mind.skills:
        hidden = getattr(skill.function, "hidden", 0)
        if hidden > MOST_LAYERS and "width" in skill.function.derived and not skill.like:
            hint = f"Write hidden 1 width {hidden} for one layer of so many neurons; hidden 2 does for most."
            yield Finding(skill.span, f"{skill.name} has {hidden} hidden layers one behind the other.", hint)


MAX_REDUCED_SKILLS = 2000  # above which the reduction takes longer than anybody waits for lint


@rule()
def redundant_influence(study: Study) -> Found:
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


@rule()
def single_way(study: Study) -> Found:
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
