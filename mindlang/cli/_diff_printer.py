"""A unified diff on stdout: with colours on a terminal, else as `patch` takes it."""

from mindlang.cli._terminal import console, print_document

STYLES = {"---": "bold", "+++": "bold", "@": "cyan", "-": "red", "+": "green"}  # by how a line begins


def print_diff(diff: str) -> None:
    """Print it."""
    out = console()
    if not out.is_terminal:
        print_document(diff)
        return
    from mindrun.files.printable import visible
    from rich.text import Text

    for line in diff.splitlines():
        style = next((style for start, style in STYLES.items() if line.startswith(start)), "")
        out.print(Text(visible(line), style))
