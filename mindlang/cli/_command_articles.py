"""The commands of mindc as articles, from what click knows of them, and those of mindrun."""

import re
from collections.abc import Iterator

import click

from mindlang.explaining.article import Article, Parameter, in_lines


def command_articles() -> Iterator[Article]:
    """Every command of mindc, and those of a group one by one: edit rename; then mindrun's."""
    from mindlang.cli import commands
    from mindlang.cli._mindrun_articles import mindrun_articles

    context = click.Context(commands, info_name="mindc")
    for name in commands.list_commands(context):
        if found := commands.get_command(context, name):
            yield from _articles(name, found, context)
    yield from mindrun_articles()


def _articles(name: str, command: click.Command, parent: click.Context) -> Iterator[Article]:
    context = click.Context(command, info_name=name.split()[-1], parent=parent)
    yield _article(name, command, context)
    if isinstance(command, click.Group):
        for each in command.list_commands(context):
            if found := command.get_command(context, each):
                yield from _articles(f"{name} {each}", found, context)


def _article(name: str, command: click.Command, context: click.Context) -> Article:
    summary, _, text = in_lines((command.help or "").replace("\b", "")).partition("\n\n")
    first, _, rest = summary.partition(". ")
    options = (each for each in command.params if isinstance(each, click.Option) and not each.hidden)
    return Article(
        name,
        "command",
        "command",
        "mindc",
        f"{first.removesuffix('.')}.",
        "\n\n".join(filter(None, (rest, text))),
        tuple(_option(each, context) for each in options),
        right=tuple(_examples(command, context)),
        language="",
    )


def _option(option: click.Option, context: click.Context) -> Parameter:
    """An option, with the name of its value; where its help says what holds without it, that stands there."""
    names, about = ", ".join([*option.opts, *option.secondary_opts]), option.help or ""
    takes = "" if option.is_flag else option.make_metavar(context).removesuffix(" RANGE")
    default = None if option.is_flag or "default" in about else option.get_default(context, call=True)
    is_said = isinstance(default, int | float | str)
    return Parameter(f"{names} {takes}".strip(), about, None if option.required else str(default) if is_said else "")


def _examples(command: click.Command, context: click.Context) -> Iterator[str]:
    """How it is called, and the lines of its examples."""
    usage = command.get_usage(context).removeprefix("Usage: ")
    whole = re.sub(r" *\\\n *", " ", command.epilog or "")  # a line may go on in the next one
    lines = [line.strip() for line in whole.splitlines()]
    calls = [line for line in lines if re.match(r"mind(c|run) ", line)]
    yield "\n".join([" ".join(usage.split()), *(calls and ["", *calls])])
