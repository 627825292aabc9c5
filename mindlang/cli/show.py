"""`mindc show`: the hierarchy of a mind as a tree, and for other programs: Graphviz, GraphML, JSON.

Examples:
  mindc show collect.mind
  mindc show collect.mind --dot | dot -Tsvg > collect.svg
  mindc show collect.mind --graphml > collect.graphml
  mindc show collect.mind --json
"""

import click

from mindlang.cli._options import flag
from mindlang.cli._terminal import console, load_compiled, print_document, print_json


@click.command
@click.argument("file")
@flag("--dot as_dot", "Graphviz instead: mindc show collect.mind --dot | dot -Tsvg")
@flag("--graphml as_graphml", "GraphML, which yEd, Gephi and networkx read.")
@flag("--json as_json", "Nodes and links, as networkx.node_link_graph reads them.")
def command(file: str, as_dot: bool, as_graphml: bool, as_json: bool) -> None:
    """Show the hierarchy of a mind, from the master down."""
    from networkx import generate_graphml, node_link_data, relabel_nodes

    from mindlang.compiler.drawing import dot, tree

    if as_dot + as_graphml + as_json > 1:
        raise click.UsageError("Choose one of --dot, --graphml and --json.")
    mind, _ = load_compiled(file).whole
    if as_dot:
        print_document(dot(mind) + "\n")
    elif as_graphml:
        print_document("\n".join(generate_graphml(relabel_nodes(mind.hierarchy, str))) + "\n")
    elif as_json:
        print_json(node_link_data(relabel_nodes(mind.hierarchy, str), edges="links"))
    else:
        console().print(tree(mind), soft_wrap=False)
