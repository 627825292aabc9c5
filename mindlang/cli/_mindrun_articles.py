"""What can be said to mindrun as articles, from what argparse knows: driving a robot, and the tools beside it."""

from argparse import SUPPRESS, Action, ArgumentParser
from collections.abc import Iterator

from mindrun.cli.driving_arguments import driving_parser
from mindrun.cli.tools import EXAMPLES, tool_parser, tools

from mindlang.explaining.article import Article, Parameter, in_lines

PROGRAM = "mindrun"
TOOLS = "tools:"  # the part of mindrun's epilog that is not its own


def mindrun_articles() -> Iterator[Article]:
    """The program itself, then its tools."""
    yield _article(PROGRAM, "program", "program", driving_parser())
    for name in tools():
        yield _article(name, PROGRAM, f"tool of {PROGRAM}", tool_parser(name))


def _article(name: str, noun: str, sort: str, parser: ArgumentParser) -> Article:
    summary, _, rest = in_lines(parser.description or "").partition("\n\n")
    first, _, more = summary.partition(". ")
    parts = (parser.epilog or "").strip().split("\n\n")
    calls = [part.removeprefix(EXAMPLES) for part in parts if part.startswith(EXAMPLES)]
    texts = [in_lines(part) for part in parts if not part.startswith((EXAMPLES, TOOLS))]
    return Article(
        name,
        noun,
        sort,
        PROGRAM,
        f"{first.removesuffix('.')}.",
        "\n\n".join(filter(None, (more, rest, *texts))),
        tuple(_parameter(each) for each in parser._actions if each.help and each.dest not in ("help", "version")),
        right=("\n\n".join([_usage(parser), *(_lines(each) for each in calls)]),),
        language="",
    )


def _parameter(action: Action) -> Parameter:
    """An option or an argument; where its help says what holds without it, that stands there."""
    about, default = action.help or "", action.default
    if not action.option_strings:
        return Parameter(_argument(action), about, "" if action.nargs == "?" else None)
    name = f"{', '.join(action.option_strings)} {_value(action)}".strip()
    is_said = isinstance(default, int | float | str) and not isinstance(default, bool) and default != SUPPRESS
    return Parameter(name, about, str(default) if is_said and "default" not in about else "")


def _value(action: Action) -> str:
    """What stands behind an option, nothing behind one that is a switch."""
    return "" if action.nargs == 0 else str(action.metavar or action.dest.upper())


def _argument(action: Action) -> str:
    name = str(action.metavar or action.dest.upper())
    return f"[{name}]" if action.nargs == "?" else name


def _usage(parser: ArgumentParser) -> str:
    """How it is called, as mindc says it of its commands."""
    return " ".join(
        [parser.prog, "[OPTIONS]", *(_argument(each) for each in parser._actions if not each.option_strings)]
    )


def _lines(text: str) -> str:
    return "\n".join(line.strip() for line in text.splitlines())
