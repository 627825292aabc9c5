"""What `mindrun` can do beside driving a robot, one file each: `options` adds its arguments, `run` does it."""

from argparse import ArgumentParser
from importlib import import_module
from pkgutil import iter_modules
from textwrap import fill

from mindrun.terminal.arguments import parser

EXAMPLES = "examples:\n"  # what the paragraph of a tool's help begins with that keeps its lines
LINE_COLUMNS = 80


def tools() -> list[str]:
    """The names of the tools."""
    return sorted(module.name for module in iter_modules(__path__))


def tool_parser(name: str) -> ArgumentParser:
    """The parser of a tool, with its help."""
    module = import_module(f"{__name__}.{name}")
    summary, _, rest = (module.__doc__ or "").partition("\n\n")
    known = parser(f"mindrun {name}", _filled(summary), _filled(rest))
    module.options(known)
    return known


def _filled(text: str) -> str:
    """The paragraphs of a text in lines for a terminal."""
    parts = text.strip().split("\n\n")
    return "\n\n".join(part if part.startswith(EXAMPLES) else fill(part, LINE_COLUMNS) for part in parts)


def run_tool(name: str, words: list[str]) -> int:
    """Run a tool with these words of the command line; its exit code."""
    known = tool_parser(name)
    code: int = import_module(f"{__name__}.{name}").run(known.parse_args(words))
    return code
