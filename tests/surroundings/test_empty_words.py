"""A word of a command line that is empty, as a variable is that was never set, is refused whatever it stands for."""

import sys
from collections.abc import Iterator

import click
import pytest
from mindrun.__main__ import main
from mindrun.cli.driving_arguments import driving_parser
from mindrun.cli.tools import tool_parser, tools
from mindrun.terminal.arguments import emptiness

from mindlang.cli import commands
from tests.calling import Call

EMPTY = ["", "  ", "\t"]
HINT = "rite something there, or leave it out"


def of_mindc(group: click.Group = commands, before: tuple[str, ...] = ()) -> Iterator[tuple[str, ...]]:
    """Every command with each of its options that takes a value, and each with a first argument that is there."""
    context = click.Context(group)
    for name in group.list_commands(context):
        command = group.get_command(context, name)
        if isinstance(command, click.Group):
            yield from of_mindc(command, (*before, name))
            continue
        assert command
        yield (*before, name)
        for each in command.params:
            if isinstance(each, click.Option) and not each.is_flag:
                yield (*before, name, each.opts[0])


def of_mindrun() -> Iterator[tuple[str, ...]]:
    """The same of mindrun."""
    parsers = {(): driving_parser()} | {(name,): tool_parser(name) for name in tools()}
    for words, parser in parsers.items():
        yield from (
            (*words, each.option_strings[-1]) for each in parser._actions if each.option_strings and each.nargs is None
        )
        yield (*words, "ball.bundle")


@pytest.mark.parametrize("words", [*of_mindc()], ids=" ".join)
def test_no_argument_of_mindc_may_be_empty(mindc: Call, words: tuple[str, ...]) -> None:
    for empty in EMPTY:
        said = mindc(*words, empty)
        assert (said.code, said.out) == (2, "")
        assert f"What stands behind {words[-1]} is empty." in said.err
        assert HINT in said.err
    if words[-1].startswith("--"):
        assert f"What stands behind {words[-1]} is empty." in mindc(*words[:-1], f"{words[-1]}=").err


@pytest.mark.parametrize("words", [*of_mindrun()], ids=" ".join)
def test_no_argument_of_mindrun_may_be_empty(
    words: tuple[str, ...], capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    for empty in EMPTY:
        monkeypatch.setattr(sys, "argv", ["mindrun", *words, empty])
        with pytest.raises(SystemExit) as stop:
            main()
        said = capsys.readouterr()
        assert (stop.value.code, said.out) == (2, "")
        assert said.err == f"mindrun: what stands behind {words[-1]} is empty\n  w{HINT}\n"


@pytest.mark.parametrize(
    ("words", "flaw"),
    [
        ([], ""),
        (["run", "a.mind", "--task", "Go"], ""),
        (["run", "a.mind", "--sensor", "eyes="], ""),
        ([""], "the first word is empty"),
        (["run", ""], "what stands behind run is empty"),
        (["run", "--task= "], "what stands behind --task is empty"),
    ],
)
def test_which_word_is_empty_is_said(words: list[str], flaw: str) -> None:
    assert emptiness(words) == flaw
