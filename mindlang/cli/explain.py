"""`mindc explain`: what is this, and what is to be done about it?

Examples:
  mindc explain
  mindc explain wheel
  mindc explain sensor light
  mindc explain ultrasonic
  mindc explain teaches
  mindc explain mindrun replay
  mindc explain influence-cycle
  mindc explain unread-sensor --json
"""

import re
from argparse import SUPPRESS, Action, ArgumentParser
from collections.abc import Iterable, Iterator, Sequence

import click
from mindrun.cli import EXAMPLES, driving_parser, tool_parser, tools
from mindrun.files.printable import visible

from mindlang.cli._options import json_flag, one_of
from mindlang.cli._terminal import MISUSE, fail, print_result
from mindlang.explaining.article import Article, Parameter, unwrap_paragraphs

PROGRAM = "mindrun"
TOOLS = "tools:"  # the part of mindrun's epilog that is not its own


def _names() -> dict[str, str]:
    """The names of all articles, with the sort of each."""
    from mindlang.explaining.collection import articles

    return {each.name: each.sort for each in (*command_articles(), *articles())}


@click.command
@click.argument("name", nargs=-1, shell_complete=one_of(_names))
@json_flag("One JSON document instead: mindc explain comma --json")
def command(name: tuple[str, ...]) -> None:
    """Say what NAME means; without NAME list all codes.

    NAME is a kind (wheel), a driver (ultrasonic), a word of the language (teaches), a command of mindc or mindrun
    (train, replay), or the code in brackets at the end of a message. Where several things have the name, all are said;
    a noun before it chooses one: sensor light, mindrun doctor. Ends with 0, or with 2 where there is nothing of that
    name.
    """
    from rich.text import Text

    from mindlang.explaining.collection import articles, codes, find_articles, unknown_hint
    from mindlang.explaining.terminal import article_data, article_text, code_list

    if not name:
        data = {"articles": [article_data(each) for each in codes().values()]}
        print_result(data, lambda: Text.assemble(*code_list(codes().values())), end="")
        return
    asked = " ".join(" ".join(name).strip("[]").split())
    known = find_articles(asked, articles()) or find_articles(asked, [*command_articles()])
    if not known:
        hint = unknown_hint(asked, [*articles(), *command_articles()])
        fail(f"There is nothing called {visible(asked)}.", hint, MISUSE)
    data = {"articles": [article_data(each) for each in known]}
    print_result(data, lambda: Text("\n").join(Text.assemble(*article_text(each)) for each in known), end="")


def command_articles() -> Iterator[Article]:
    """Every command of mindc, and those of a group one by one: edit rename; then mindrun's."""
    from mindlang.cli import commands

    context = click.Context(commands, info_name="mindc")
    yield from _of_group(commands, "", context)
    yield from mindrun_articles()


def _of_group(group: click.Group, before: str, context: click.Context) -> Iterator[Article]:
    for name in group.list_commands(context):
        command = group.get_command(context, name)
        if command is None:
            continue
        inner = click.Context(command, info_name=name, parent=context)
        options = (each for each in command.params if isinstance(each, click.Option) and not each.hidden)
        parameters = (_option(each, inner) for each in options)
        usage = command.get_usage(inner).removeprefix("Usage: ")
        whole = re.sub(r" *\\\n *", " ", command.epilog or "")  # a line may go on in the next one
        lines = [line.strip() for line in whole.splitlines()]
        calls = [line for line in lines if re.match(r"mind(c|run) ", line)]
        right = "\n".join([" ".join(usage.split()), *(calls and ["", *calls])])
        help_ = [(command.help or "").replace("\b", "")]
        yield _article(before + name, ("command", "command", "mindc"), help_, parameters, right)
        if isinstance(command, click.Group):
            yield from _of_group(command, f"{before}{name} ", inner)


def mindrun_articles() -> Iterator[Article]:
    """The articles of mindrun: the program itself, then its tools."""
    yield _of_parser(PROGRAM, ("program", "program", PROGRAM), driving_parser())
    for name in tools():
        yield _of_parser(name, (PROGRAM, f"tool of {PROGRAM}", PROGRAM), tool_parser(name))


def _of_parser(name: str, sort: tuple[str, str, str], parser: ArgumentParser) -> Article:
    parts = (parser.epilog or "").strip().split("\n\n")
    called = (part.removeprefix(EXAMPLES) for part in parts if part.startswith(EXAMPLES))
    calls = ["\n".join(line.strip() for line in each.splitlines()) for each in called]
    texts = [parser.description or "", *(part for part in parts if not part.startswith((EXAMPLES, TOOLS)))]
    actions = [each for each in parser._actions if each.help and each.dest not in ("help", "version")]
    usage = [parser.prog, "[OPTIONS]", *(_argument(each) for each in parser._actions if not each.option_strings)]
    return _article(name, sort, texts, map(_parameter, actions), "\n\n".join([" ".join(usage), *calls]))


def _article(
    name: str, sort: tuple[str, str, str], texts: Sequence[str], parameters: Iterable[Parameter], right: str
) -> Article:
    """An article whose summary is the first sentence of its texts; `sort` is its noun, its sort and its chapter."""
    about, *more = map(unwrap_paragraphs, texts)
    summary, _, rest = about.partition("\n\n")
    first, _, text = summary.partition(". ")
    paragraphs = "\n\n".join(filter(None, (text, rest, *more)))
    summary = f"{first.removesuffix('.')}."
    return Article(name, *sort, summary, paragraphs, tuple(parameters), right=(right,), language="")


def _option(option: click.Option, context: click.Context) -> Parameter:
    """An option of click, with the name of its value; where its help says what holds without it, that stands there."""
    names, about = ", ".join([*option.opts, *option.secondary_opts]), option.help or ""
    takes = "" if option.is_flag else option.make_metavar(context).removesuffix(" RANGE")
    default = None if option.is_flag or "default" in about else option.get_default(context, call=True)
    is_said = isinstance(default, int | float | str)
    return Parameter(f"{names} {takes}".strip(), about, None if option.required else str(default) if is_said else "")


def _parameter(action: Action) -> Parameter:
    """An option or an argument of argparse, with the name of its value and its default, unless its help says that."""
    about, default = action.help or "", action.default
    if not action.option_strings:
        return Parameter(_argument(action), about, "" if action.nargs == "?" else None)
    value = "" if action.nargs == 0 else action.metavar or action.dest.upper()
    name = f"{', '.join(action.option_strings)} {value}".strip()
    is_said = isinstance(default, int | float | str) and not isinstance(default, bool) and default != SUPPRESS
    return Parameter(name, about, str(default) if is_said and "default" not in about else "")


def _argument(action: Action) -> str:
    name = str(action.metavar or action.dest.upper())
    return f"[{name}]" if action.nargs == "?" else name
