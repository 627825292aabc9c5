"""`mindc show`: the hierarchy of a mind as a tree, and for other programs: Graphviz, GraphML, JSON.

Examples:
  mindc show collect.mind
  mindc show collect.mind --dot | dot -Tsvg > collect.svg
  mindc show collect.mind --graphml > collect.graphml
  mindc show collect.mind --json
  mindc show grown.mind Follow
"""

from pathlib import Path
from typing import TYPE_CHECKING

import click

from mindlang.cli import _terminal as terminal
from mindlang.cli._options import SKILLS, flag

if TYPE_CHECKING:
    from networkx import DiGraph
    from rich.tree import Tree

    from mindlang.compiler.compile import Compiled

    Drawn = tuple[DiGraph, Tree, str]


@click.command
@click.argument("file")
@click.argument("skill", default="", shell_complete=SKILLS)
@flag("--dot as_dot", "Graphviz instead: mindc show collect.mind --dot | dot -Tsvg")
@flag("--graphml as_graphml", "GraphML, which yEd, Gephi and networkx read.")
@flag("--json as_json", "Nodes and links, as networkx.node_link_graph reads them.")
def command(file: str, skill: str, as_dot: bool, as_graphml: bool, as_json: bool) -> None:
    """Show the hierarchy of a mind, from the master down.

    Or the links of SKILL, a neat that was taught: of each output and neuron the sum of what it reads.
    """
    from networkx import generate_graphml, node_link_data

    if as_dot + as_graphml + as_json > 1:
        raise click.UsageError("Choose one of --dot, --graphml and --json.")
    compiled = terminal.load_compiled(file)
    graph, as_tree, text = _links(file, compiled, skill) if skill else _hierarchy(compiled)
    if as_dot:
        terminal.print_document(text + "\n")
    elif as_graphml:
        terminal.print_document("\n".join(generate_graphml(graph)) + "\n")
    elif as_json:
        terminal.print_json(node_link_data(graph, edges="links"))
    else:
        terminal.console().print(as_tree, soft_wrap=False)


def _hierarchy(compiled: "Compiled") -> "Drawn":
    """The hierarchy as a graph, a tree and Graphviz."""
    from networkx import relabel_nodes

    from mindlang.compiler.drawing import dot, tree

    mind, _ = compiled.whole
    return relabel_nodes(mind.hierarchy, str), tree(mind), dot(mind)


def _links(file: str, compiled: "Compiled", skill: str) -> "Drawn":
    """The links of a skill; where it has none, the program ends."""
    from mindlang.training.subject import open_subject
    from mindlang.weights.links import links_dot, links_tree, taught_links

    terminal.refuse_standard_input(file, "Weights are kept beside a file, and standard input is none.")
    terminal.known_skills(compiled.whole[1], skill)
    with terminal.refusing(end="."):
        links = taught_links(open_subject(Path(file), compiled), skill)
    return links, links_tree(links), links_dot(links)
