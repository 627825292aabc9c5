"""`mindc check` and `mindc show` as a user calls them: what is printed where, and the exit codes."""

import json
import os
import subprocess
import sys
from pathlib import Path

import click
import networkx
import pytest

from mindlang.cli import commands
from mindlang.editing import edits
from tests.calling import Call
from tests.language.examples import COLLECT, EXAMPLES, RIGHT, TOUR

WRONG = Path(__file__).parent / "wrong" / "unknown-sensor.mind"


def process(*arguments: object, text: str = "", **environment: str) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-c", "from mindlang.cli import main; main()", *map(str, arguments)]
    return subprocess.run(
        command, input=text, capture_output=True, text=True, check=False, env=os.environ | environment, timeout=600
    )


def test_check_says_that_nothing_is_wrong(mindc: Call) -> None:
    minds = [path for path in EXAMPLES if path.name not in ("parts.mind", "robot.mind")]  # what minds share
    assert mindc("check", *minds) == (0, "", "nothing wrong\n")


def test_check_reports_and_ends_with_one(mindc: Call) -> None:
    code, out, err = mindc("check", RIGHT, WRONG)
    assert (code, out) == (1, "")
    assert WRONG.with_suffix(".txt").read_text(encoding="utf-8").splitlines()[1] in err
    assert err.endswith("1 mistake\n")


def test_check_ends_with_two_where_a_file_cannot_be_read(mindc: Call) -> None:
    code, out, err = mindc("check", "nowhere.mind", RIGHT)
    assert (code, out) == (2, "")
    assert err.startswith("error: nowhere.mind cannot be read")


def test_check_as_json_is_one_document(mindc: Call) -> None:
    code, out, err = mindc("check", "--json", RIGHT, WRONG)
    data = json.loads(out)
    assert (code, err) == (1, "")
    assert [file["ok"] for file in data["files"]] == [True, False]
    assert [diagnostic["code"] for diagnostic in data["diagnostics"]] == ["unknown-sensor"]


def test_a_dash_is_standard_input_and_colours_are_only_on_a_terminal() -> None:
    found = process("check", "-", text="reads x\n", NO_COLOR="", FORCE_COLOR="")
    assert found.returncode == 1
    assert "<stdin>:1:1: error:" in found.stderr
    assert "\x1b" not in found.stderr


def test_show_draws_a_shared_skill_once(mindc: Call) -> None:
    code, out, err = mindc("show", COLLECT)
    assert (code, err) == (0, "")
    assert out.startswith("Collect is the master\n")
    assert out.count("Avoid  (shown above)") == 1
    assert "Grab at 1  rule" in out
    assert "drives claw at (object_in_reach + holding) * (1 - in_drop_zone)" in out
    assert "reads proximity, moving, pulse" in out


def test_show_as_graphviz_as_json_and_as_graphml(mindc: Call) -> None:
    _, dot, _ = mindc("show", TOUR, "--dot")
    assert dot.startswith("digraph mind {")
    assert dot.endswith("}\n")
    assert '  "skill Work" -> "skill Avoid" [label="1/2"]' in dot
    _, data, _ = mindc("show", TOUR, "--json")
    graph = networkx.node_link_graph(json.loads(data), edges="links")
    assert [name for name, is_master in graph.nodes(data="master") if is_master] == ["skill Live"]
    assert {"actuator left_wheel", "actuator claw"} <= networkx.descendants(graph, "skill Live")
    _, xml, _ = mindc("show", TOUR, "--graphml")
    said = networkx.parse_graphml(xml)
    assert (dict(said.nodes(data=True)), [*said.edges(data=True)]) == (
        dict(graph.nodes(data=True)),
        [*graph.edges(data=True)],
    )


@pytest.mark.parametrize(("path", "code"), [(WRONG, 1), ("nowhere.mind", 2)])
def test_show_of_a_bad_file_is_its_report(path: object, code: int, mindc: Call) -> None:
    found = mindc("show", path)
    assert found[:2] == (code, "")
    assert "error: " in found[2]


@pytest.mark.parametrize("arguments", [["chekc"], ["check"], ["check", "--jsn", "x"], ["show", "x", "--dot", "--json"]])
def test_wrong_usage_ends_with_two(arguments: list[str], mindc: Call) -> None:
    code, out, err = mindc(*arguments)
    assert (code, out) == (2, "")
    assert "Traceback" not in err


def test_a_misspelt_command_is_suggested(mindc: Call) -> None:
    assert "Did you mean check?" in mindc("chekc")[2]


@pytest.mark.parametrize(
    ("raised", "code", "said"),
    [
        (KeyboardInterrupt(), 130, ""),
        (click.Abort(), 130, ""),
        (OSError(28, "No space left on device", "runs"), 1, "No space left on device: runs"),
        (RuntimeError("what?"), 1, "MIND_DEBUG=1"),
    ],
)
def test_no_exception_becomes_a_traceback(
    raised: BaseException, code: int, said: str, mindc: Call, monkeypatch: pytest.MonkeyPatch
) -> None:
    def fail(*_: object) -> None:
        raise raised

    monkeypatch.setattr("mindlang.editing.neighbours.load", fail)
    monkeypatch.delenv("MIND_DEBUG", raising=False)
    found = mindc("check", RIGHT)
    assert found[0] == code
    assert said in found[2]
    assert "Traceback" not in found[2]


@pytest.mark.parametrize("words", [(), ("edit",), ("weights",)])
def test_the_lists_of_commands_are_not_cut_at_80_columns(
    words: tuple[str, ...], mindc: Call, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("COLUMNS", "80")
    listed = mindc(*words, "--help").out.partition("Commands:\n")[2].split("\n\n")[0].splitlines()
    assert listed
    assert [line for line in listed if line.endswith("...")] == []


def test_every_flag_of_check_and_show_has_an_example(mindc: Call) -> None:
    for name, flags in (("check", ["--json"]), ("show", ["--dot", "--json"])):
        _, out, _ = mindc(name, "--help")
        assert "Examples:" in out
        assert all(out.count(flag) >= 2 for flag in flags)


@pytest.mark.parametrize(
    "command",
    ["", *commands.list_commands(click.Context(commands)), *(f"edit {name}" for name in [*edits.names(), "undo"])],
)
def test_help_fits_into_80_columns(mindc: Call, monkeypatch: pytest.MonkeyPatch, command: str) -> None:
    monkeypatch.setenv("COLUMNS", "80")
    said = mindc(*command.split(), "--help")
    assert said.code == 0
    assert [line for line in said.out.splitlines() if len(line) > 80] == []


@pytest.mark.parametrize("group", ["", "edit"])
def test_no_one_line_help_is_cut_at_80_columns(mindc: Call, monkeypatch: pytest.MonkeyPatch, group: str) -> None:
    monkeypatch.setenv("COLUMNS", "80")
    said = mindc(*group.split(), "--help")
    lines = said.out.partition("\nCommands:\n")[2].partition("\n\n")[0].splitlines()
    assert len(lines) > 10
    assert [line for line in lines if not line.endswith(".") or line.endswith("...")] == []
    assert max(map(len, lines)) <= 80
