"""`mindc lsp`: what an editor asks about `.mind` files, answered.

Examples:
  mindc lsp  as an editor starts it: docs/editors.md says how to set it up
"""

import sys

import click

from mindlang.cli._options import flag
from mindlang.cli._terminal import need


@click.command
@flag("--stdio", "Talk on standard input and output, which it always does.")
def command(stdio: bool) -> None:
    """Serve an editor by the Language Server Protocol.

    It talks on standard input and output, checks as you type, explains, completes, finds, renames, formats and makes
    every edit of `mindc edit`. It never runs a procedure.
    """
    need("pygls", "The language server needs", "lsp")
    from mindlang.server.serve import serve

    with open(sys.stdout.fileno(), "wb", closefd=False) as answers:  # which pygls closes
        sys.exit(serve(sys.stdin.buffer, answers))
