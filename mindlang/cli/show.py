"""`mindc show`: the hierarchy of a mind, as a tree, as a drawing, as data."""

import click

EXAMPLES = """\b
Examples:
  mindc show collect.mind
  mindc show collect.mind --dot | dot -Tsvg > collect.svg
  mindc show collect.mind --json
"""


@click.command(epilog=EXAMPLES)
@click.argument("file")
@click.option("--dot", "as_dot", is_flag=True, help="Graphviz instead: mindc show collect.mind --dot | dot -Tsvg")
@click.option("--json", "as_json", is_flag=True, help="The compiled graph as JSON: mindc show collect.mind --json")
def command(file: str, as_dot: bool, as_json: bool) -> None:
    """Show the hierarchy of a mind, from the master down."""
    from mindrun.graph.codec import encode

    from mindlang.cli._terminal import console, load_compiled, print_document, print_json
    from mindlang.compiler.drawing import dot, tree

    if as_dot and as_json:
        raise click.UsageError("Choose one of --dot and --json.")
    compiled = load_compiled(file)
    assert compiled.graph
    assert compiled.mind
    if as_json:
        print_json(encode(compiled.graph))
    elif as_dot:
        print_document(dot(compiled.mind) + "\n")
    else:
        console().print(tree(compiled.mind), soft_wrap=False)
