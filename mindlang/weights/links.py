"""The links of a network that grew, as it was taught: a tree of sums, and Graphviz."""

from typing import TYPE_CHECKING, Any

import numpy as np
from mindrun.errors import WeightsError
from mindrun.graph.graph import Graph, Skill
from mindrun.graph.named_readings import reading_names
from mindrun.graph.weights import Weights
from mindrun.kinds.registry import phrase
from mindrun.terminal.command_line import command_line
from networkx import DiGraph

from mindlang.training.subject import Subject
from mindlang.weights.network import trained_network

if TYPE_CHECKING:
    from mindrun.numbers.links import Links
    from rich.tree import Tree

BIAS = "1"  # the name of what is always 1
THICKEST_LINE = 5.0  # of a picture, in points: that of the greatest weight


def taught_links(subject: Subject, skill: str) -> DiGraph:
    """The links of a skill of a file; MindError where it was not taught, or where its kind has none that grew."""
    network, weights = trained_network(subject, skill)
    if not network.skill.function.grows:
        hint = f"Make one of an mlp: {command_line('mindc', 'edit', 'grow', subject.shown, skill)}"
        raise WeightsError(f"{skill} is {phrase(network.skill.function)}: only a neat has links that grew", hint)
    return links_of(subject.graph, network.skill, weights)


def links_of(graph: Graph, skill: Skill, weights: Weights) -> DiGraph:
    """What the outputs and neurons of a skill that grew read: an edge with a `weight` for each link.

    Nodes are names, with their `role`: bias, reading, neuron or output. Neurons from which no way leads to an output
    are left out.
    """
    function: Any = skill.function
    links: Links = function.network(weights, skill.outputs)
    neurons = [f"neuron {number}" for number in range(1, links.most + 1)]
    names = reading_names(graph)
    read = [*[BIAS] * links.bias, *(names[row] for row in skill.inputs), *neurons]
    rows = [*neurons, *_sent(graph, skill)]
    gone = {name for name, is_live in zip(neurons, links.live, strict=True) if not is_live}
    found = DiGraph(name=skill.name, about=function.summary(weights, skill.outputs), centred=bool(links.centred))
    for name in rows[links.most :]:
        found.add_node(name, role="output")
    for row, column in np.argwhere(links.cells):
        source, target = read[column], rows[row]
        if gone.isdisjoint((source, target)):
            for name in (source, target):
                role = "bias" if name == BIAS else "neuron" if name in neurons else "reading"
                found.add_node(name, role=found.nodes.get(name, {}).get("role", role))
            found.add_edge(source, target, weight=float(links.cells[row, column]))
    return found


def _sent(graph: Graph, skill: Skill) -> list[str]:
    """The names to which the outputs go, in their order; one that is read, too, is told apart."""
    edges = sorted((edge.output, edge.to, edge.target) for edge in skill.edges if edge.output is not None)
    names = [graph.named(to, target) for _, to, target in edges]
    return [f"{name} (driven)" if name in reading_names(graph) else name for name in names]


def links_tree(links: DiGraph) -> "Tree":
    """Each output, then each neuron, with the sum of what it reads."""
    from rich.text import Text
    from rich.tree import Tree

    root = Tree(Text(f"{links.graph['name']}: {links.graph['about']}"), guide_style="dim")
    for role in ("output", "neuron"):
        for name in sorted((name for name, its in links.nodes(data="role") if its == role), key=_natural):
            said = _sum(links, name)
            root.add(Text.assemble((name, "bold"), f" = {f'σ({said})' if role == 'neuron' else said}"))
    return root


def _natural(name: str) -> tuple[str, int]:
    text, _, number = name.rpartition(" ")
    return (text, int(number)) if number.isdigit() else (name, 0)


def _sum(links: DiGraph, name: str) -> str:
    """`0.31 - 2.40 food_bearing + 1.20 neuron 2`; of a centred network what is read is less 1/2."""
    centred, terms = links.graph["centred"], []
    for source, _, weight in links.in_edges(name, data="weight"):
        read = f"({source} - 1/2)" if centred else source
        terms.append((weight, "" if source == BIAS else f" {read}"))
    if centred and links.nodes[name]["role"] == "output":
        terms.insert(0, (0.5, ""))
    said = "".join(f" {'-' if weight < 0 else '+'} {abs(weight):.2f}{read}" for weight, read in terms)
    return said.removeprefix(" + ").replace(" - ", "-", said.startswith(" - ")) or "0"


def links_dot(links: DiGraph) -> str:
    """The links as a Graphviz digraph: thicker the greater a weight is, dashed below 0."""
    shapes = {"bias": "point", "reading": "ellipse", "neuron": "circle", "output": "house"}
    most = max((abs(weight) for _, _, weight in links.edges(data="weight")), default=1.0)
    lines = ["digraph links {", "  rankdir=TB", "  node [fontname=sans]"]
    lines += [f'  "{name}" [shape={shapes[role]}]' for name, role in links.nodes(data="role")]
    for source, target, weight in links.edges(data="weight"):
        style = f"penwidth={max(0.5, THICKEST_LINE * abs(weight) / most):.1f}{' style=dashed' * (weight < 0)}"
        lines.append(f'  "{source}" -> "{target}" [label="{weight:.2f}" {style}]')
    return "\n".join([*lines, "}"])
