"""Values of options and arguments that nobody would think of: each ends in a sentence, none in a foreign exception."""

import ast
from argparse import Action, ArgumentParser
from collections.abc import Iterator
from contextlib import suppress
from importlib import import_module
from io import StringIO
from itertools import product
from pathlib import Path

import click
import pytest
from mindrun import __main__ as mindrun
from mindrun.cli import tools
from mindrun.graph.bundle import Bundle, write_bundle
from mindrun.graph.policy import Policy
from mindrun.terminal.arguments import parser

from mindlang import limits
from mindlang.cli import commands
from mindlang.compiler.compile import load
from tests.calling import Call, write_rules
from tests.project.sources import ROOT, modules, tree

LONG = "99999999999999999999"
NUMBERS = (
    *("0", "-0", "-1", "1.5", "1e3", "0x10", "1_000_000_000_000", "٣٣٣", "²", LONG, f"-{LONG}", "18446744073709551616"),
    *("1e308", "-1e308", "1e-320", "1e400", "nan", "-nan", "inf", "-inf", "9" * 5000, f"0.{'9' * 5000}"),
)
WORDS = ("", " ", "-", "--", "/", "..", "a/", "~", "%s{0}", "$(touch x)", "caf\udce9", "\x1b[2J", "a\nb", "x" * 5000)
HOSTILE = NUMBERS + WORDS

Case = tuple[tuple[str, ...], click.Parameter]


def _commands() -> Iterator[tuple[tuple[str, ...], click.Command]]:
    context = click.Context(commands)
    for name in commands.list_commands(context):
        command = commands.get_command(context, name)
        assert command
        if isinstance(command, click.Group):
            for inner in command.list_commands(context):
                found = command.get_command(context, inner)
                assert found
                yield (name, inner), found
        elif name != "lsp":  # which has no values, and waits for an editor
            yield (name,), command


CASES: list[Case] = [
    (words, each) for words, command in _commands() for each in command.params if not getattr(each, "is_flag", False)
]  # fmt: skip


def test_no_value_is_a_fault_of_ours() -> None:
    """Each type of a value takes it, or says in a sentence why not."""
    kinds = {(type(each.type), repr(each.type)): each for _, each in CASES}
    assert len(kinds) > 10
    for each in kinds.values():
        for value in HOSTILE:
            with suppress(click.ClickException):
                each.type.convert(value, each, None)


def test_no_name_of_a_file_is_a_fault_of_ours(mindc: Call, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    names = ("caf\udce9", "\x1b[2J", "a\nb")
    folders = product(("show", "status", "build -o x"), ("/", ".."))  # check would look for files in all of them
    for words, value in (*product(("check", "show", "status", "build -o x"), names), *folders):
        said = mindc(*words.split(), "--", value)
        assert said.code in (1, 2)
        assert "failed" not in said.err
        assert "\x1b" not in said.err


def test_every_number_has_two_bounds_which_help_says() -> None:
    for words, each in CASES:
        if isinstance(each.type, click.types.IntParamType | click.types.FloatParamType):
            assert getattr(each.type, "min", None) is not None, (words, each.name)
            assert getattr(each.type, "max", None) is not None, (words, each.name)


BOUNDS = {
    "train rules.mind --generations 0": "from 1 to 10000000",
    "train rules.mind --scale inf": "above 0, and at most 1000",
    "train rules.mind --population 2000000000": "from 4 to 1000000",
    "bench rules.mind --runs 99999999999999999999": "from 1 to 10000000",
    "run rules.mind --speed nan": "from 0.01 to 1000",
    "prove rules.mind --leak 2": "above 0, and at most 1",
}


def test_the_message_says_the_bounds(mindc: Call) -> None:
    for words, bounds in BOUNDS.items():
        said = mindc(*words.split())
        assert said.code == 2
        assert bounds in said.err
        assert bounds.split()[-1] in mindc(*words.split()[:1], "--help").out


def _tools() -> Iterator[tuple[str, ArgumentParser]]:
    for name in tools():
        known = parser(name, None)
        import_module(f"mindrun.cli.{name}").options(known)
        yield name, known


def _actions() -> Iterator[tuple[str, Action]]:
    for name, known in _tools():
        yield from ((name, action) for action in known._actions if action.nargs != 0)


MINDRUN = [["--readings"], ["--fill"], ["--master"], ["--record"], ["--ticks"], ["--task"], ["--seed"]]


def test_mindrun_takes_no_offence(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    value = "9" * 5000
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("sys.stdin", StringIO())
    path, graph = tmp_path / "b.bundle", load(write_rules(tmp_path)).graph
    assert graph
    write_bundle(path, Bundle(Policy(graph, {}), {}))
    lines = [[path, f"{option}={value}"] for [option] in MINDRUN]
    lines += [
        [path, "--readings", "none", f"--master={value}"],
        [path, "--dry", "--ticks=x", f"--seed={value}"],
        [value],
    ]
    lines += [
        [name, *([path] if action.dest != "bundle" else []), f"{action.option_strings[0]}={value}"]
        if action.option_strings
        else [name, value, value]
        for name, action in _actions()
    ]
    for line in lines:
        monkeypatch.setattr("sys.argv", ["mindrun", *map(str, line)])
        with pytest.raises(SystemExit) as stop:
            mindrun.main()
        assert stop.value.code in (0, 1, 2), line
        assert "failed:" not in capsys.readouterr().err, line


def test_no_option_can_be_half_said() -> None:
    """`--a` must not arm a robot."""
    files = modules(ROOT / "mindlang", ROOT / "runtime", ROOT / "examples", ROOT / "benchmarks")
    calls = [
        (path, node)
        for path in files
        if "ArgumentParser" in path.read_text(encoding="utf-8")
        for node in ast.walk(tree(path))
        if isinstance(node, ast.Call) and getattr(node.func, "attr", "") == "ArgumentParser"
    ]
    assert len(calls) > 10
    for path, call in calls:
        said = {word.arg: getattr(word.value, "value", None) for word in call.keywords}
        assert said.get("allow_abbrev") is False, path


def test_what_no_memory_could_hold_is_refused_before_it_begins(
    mindc: Call, rules: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(limits, "available", lambda: 1 << 20)
    said = mindc("bench", rules, "--runs", 1_000_000)
    assert (said.code, said.out) == (2, "")
    assert "1,000,000 runs take about" in said.err
    assert "1 MiB" in said.err
    assert int(said.err.split("--runs ")[1].split()[0]) > 100
