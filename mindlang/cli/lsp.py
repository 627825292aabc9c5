"""`mindc lsp`: what an editor asks about `.mind` files, answered."""

import sys
from importlib.util import find_spec

import click

from mindlang.cli._terminal import MISUSE, fail

EXAMPLES = """\b
Examples:
  mindc lsp  as an editor starts it: docs/editors.md says how to set it up
"""


@click.command(epilog=EXAMPLES)
@click.option("--stdio", is_flag=True, help="Talk on standard input and output, which it always does.")
def command(stdio: bool) -> None:
    """Serve an editor by the Language Server Protocol.

    It talks on standard input and output, checks as you type, explains, completes, finds, renames, formats and makes
    every edit of `mindc edit`. It never runs a procedure.
    """
    if find_spec("pygls") is None:
        fail("The language server needs pygls, which is not installed.", "pip install 'mindlang[lsp]'", MISUSE)
    from mindlang.server.serve import serve

    with open(sys.stdout.fileno(), "wb", closefd=False) as answers:  # which pygls closes
        sys.exit(serve(sys.stdin.buffer, answers))
