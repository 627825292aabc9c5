"""`mindc completion`: what real shells complete, and what is installed where."""

import os
import shutil
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
from mindrun.cli.driving_arguments import driving_parser
from mindrun.cli.shell_completion import SHELLS, reply, words_of
from mindrun.cli.tools import tool_parser, tools
from mindrun.graph.bundle import write_bundle

from mindlang.executors import KINDS
from tests.calling import Call
from tests.engine.bundles import wired
from tests.surroundings.shells import START, Shell, programs, started

ASK = """
source "$1"
compopt() { echo "compopt $*"; }
COMP_LINE=$2; COMP_POINT=${#COMP_LINE}; program=${COMP_LINE%% *}
_"$program"_completion "$program" "${COMP_LINE##*[ :=]}"
printf '%s\\n' "${COMPREPLY[@]}"
"""
FILES = ["compopt -o filenames"]
needs_bash = pytest.mark.skipif(shutil.which("bash") is None, reason="needs bash")


@pytest.fixture
def home(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("HOME", str(tmp_path))
    for name in ("XDG_DATA_HOME", "XDG_CONFIG_HOME"):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.fixture
def path(home: Path, tmp_path_factory: pytest.TempPathFactory, monkeypatch: pytest.MonkeyPatch) -> None:
    """Programs called mindc and mindrun are those of this test."""
    found = programs(tmp_path_factory.mktemp("programs") / "bin", home / ".ran")
    monkeypatch.setenv("PATH", f"{found}:{os.environ['PATH']}")


@pytest.fixture
def bash(home: Path, path: None, mindc: Call, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The installed script."""
    assert mindc("completion", "bash", "--install").code == 0
    (home / "work").mkdir()
    monkeypatch.chdir(home / "work")
    return home / ".local" / "share" / "mind" / "completion.bash"


@pytest.fixture(params=[pytest.param(name, marks=pytest.mark.skipif(
    shutil.which(name) is None, reason=f"needs {name}")) for name in START])  # fmt: skip
def shell(request: pytest.FixtureRequest, home: Path, path: None, mindc: Call) -> Iterator[Shell]:
    """A real shell in which completion is installed."""
    name = request.param
    script = home / f"script.{name}"
    script.write_text(mindc("completion", name).out)
    with started(name, home, script) as shell:
        yield shell


def completed(script: Path, line: str) -> list[str]:
    """What bash has of the end of a line, and what it is told to do with it."""
    command = ["bash", "-c", ASK, "bash", script, line]
    ran = subprocess.run(command, capture_output=True, text=True, check=True, timeout=600)
    assert ran.stderr == ""
    return ran.stdout.split("\n")[:-1]


@needs_bash
def test_bash_completes_both_programs(bash: Path) -> None:
    Path("ball.bundle").write_bytes(b"")
    Path("day.rec").write_bytes(b"")
    Path("recordings").mkdir()
    assert completed(bash, "mindc che") == ["check"]
    assert completed(bash, "mindc edit enca") == ["encapsulate"]
    assert completed(bash, "mindc lint --sel") == ["--select"]
    assert completed(bash, "mindc lint --format sa") == ["sarif"]
    assert completed(bash, "mindc lint --format=sa") == ["sarif"]
    assert completed(bash, "mindc check bal") == [*FILES, "ball.bundle"]
    assert completed(bash, "mindrun rep") == [*FILES, "replay", "report"]
    assert completed(bash, "mindrun ba") == [*FILES, "ball.bundle"]
    assert completed(bash, "mindrun ball.bundle --ar") == ["--arm"]
    assert completed(bash, "mindrun report --js") == ["--json"]


@needs_bash
@pytest.mark.parametrize(
    ("line", "found"),
    [
        ("mindrun replay ", [*FILES, "day.rec", "recordings"]),
        ("mindrun replay --he", ["--help"]),
        ("mindrun replay day.rec ", [*FILES, "ball.bundle", "recordings"]),
        ("mindrun replay day.rec ball.bundle ", [""]),
        ("mindrun report day.rec ball.bundle --js", ["--json"]),
        ("mindrun report --json day", [*FILES, "day.rec"]),
        ("mindrun completion ", ["bash", "zsh", "fish"]),
        ("mindrun calibrate ball.bundle ", ["r0"]),
        ("mindrun calibrate absent.bundle ", [""]),
        ("mindrun calibrate ball.bundle --seconds ", [""]),
        ("mindrun ball.bundle --master ", ["Top", "Go+On", "Grip"]),
        ("mindrun ball.bundle --master=T", ["Top"]),
        ("mindrun --task C", [""]),
        ("mindrun ball.bundle --dry --task C", ["Carry"]),
        ("mindrun ball.bundle --dry --dr", [""]),
        ("mindrun ball.bundle --break ", [*FILES, "a.break", "recordings"]),
        ("mindrun ball.bundle --readings log", [*FILES, "log.jsonl"]),
        ("mindrun ball.bundle --record=da", [*FILES, "day.rec"]),
        ("mindrun ball.bundle --fill ", [""]),
        ("mindrun ball.bundle -", None),
    ],
)
def test_bash_completes_what_an_argument_of_mindrun_may_be(bash: Path, line: str, found: list[str] | None) -> None:
    """Files of the kind it takes, names that are in the bundle, and nothing where nothing is known or left."""
    write_bundle(Path("ball.bundle"), wired())
    for name in ("day.rec", "a.break", "log.jsonl"):
        Path(name).write_text("")
    Path("recordings").mkdir()
    assert completed(bash, line) == (_options() if found is None else found)


def _options() -> list[str]:
    return [each.option_strings[-1] for each in driving_parser()._actions if each.option_strings]


@needs_bash
def test_files_of_any_name_are_offered_where_none_is_of_the_kind(bash: Path) -> None:
    Path("monday's run").write_text("")
    assert completed(bash, "mindrun replay mon") == [*FILES, "monday's run"]
    assert completed(bash, "mindrun replay x") == [*FILES, "compopt -o default", ""]


@needs_bash
@pytest.mark.parametrize(
    ("line", "found"),
    [
        ("mindc train a.mind --on ", [*["compopt -o nospace"] * 4, "threads", *(f"{each}:" for each in KINDS)]),
        ("mindc bench a.mind --on th", ["threads"]),
        ("mindc train a.mind --on=proc", ["compopt -o nospace", "processes:"]),
        ("mindc train a.mind --on processes:1", ["1"]),
        ("mindc train a.mind --on dask:", [*FILES, "scheduler.json"]),
        ("mindc train a.mind --on ssh:", [""]),
        ("mindc train a.mind --on slurm:", [""]),
        ("mindc train a.mind --on nowhere:", [""]),
    ],
)  # fmt: skip
def test_bash_completes_where_jobs_are_done(bash: Path, line: str, found: list[str]) -> None:
    Path("scheduler.json").write_text("")
    assert completed(bash, line)[: len(found)] == found


def test_a_real_shell_runs_what_it_has_completed(shell: Shell) -> None:
    """Typed behind a terminal, tabs and all, in each shell that is installed."""
    write_bundle(Path("ball.bundle"), wired())
    Path("day.rec").write_text("")
    Path("scheduler.json").write_text("")
    assert shell.words("mindrun repl\td\tball\t") == ["mindrun", "replay", "day.rec", "ball.bundle"]
    assert shell.words("mindrun ball.bundle --inf\t--mas\tTo\t") == [
        "mindrun", "ball.bundle", "--influence", "--master", "Top",
    ]  # fmt: skip
    assert shell.words("mindrun calibrate ball.bundle r\t--sec\t3") == [
        "mindrun", "calibrate", "ball.bundle", "r0", "--seconds", "3",
    ]  # fmt: skip
    assert shell.words("mindc tra\ta.mind --on proc\t2") == ["mindc", "train", "a.mind", "--on", "processes:2"]
    assert shell.words("mindc train a.mind --on dask:sch\t") == [
        "mindc", "train", "a.mind", "--on", "dask:scheduler.json",
    ]  # fmt: skip
    assert shell.words("mindc lint --format=sa\t") == ["mindc", "lint", "--format=sarif"]


def test_every_tool_and_option_of_mindrun_is_offered() -> None:
    from mindrun.cli.completing import answers

    assert {each.text for each in answers([], "")} >= {*tools()}
    for name in tools():
        options = {each.option_strings[-1] for each in tool_parser(name)._actions if each.option_strings}
        assert {each.text for each in answers([name], "-")} == options
    assert [each.text for each in answers(["x.bundle"], "-")] == _options()
    assert all(each.about for each in answers(["x.bundle"], "-"))


@pytest.mark.parametrize(
    ("line", "words"),
    [
        ("mindc ", ["mindc", ""]),
        ("mindc ru", ["mindc", "ru"]),
        ("mindc run 'my mi", ["mindc", "run", "my mi"]),
        ("mindc run my\\ mind --on=x:y", ["mindc", "run", "my mind", "--on=x:y"]),
        ("", [""]),
    ],
)
def test_a_line_is_words_as_bash_has_them(line: str, words: list[str]) -> None:
    assert words_of(line) == words


def test_what_is_asked_without_a_word_is_answered() -> None:
    assert reply("bash", [], lambda before, begun: []) == reply("zsh", [], lambda before, begun: []) == ""


MIND = """
mind 1
use "wheels.mind" as base
sensor front is range_finder at 0 deg
skill Wander is rule
  drives left_wheel at 1
skill Watch is rule
  raeds front
task Walk in plain
task Wait in plain
curriculum School is genetic
"""


@needs_bash
@pytest.mark.parametrize(
    ("words", "found"),
    [
        ("mindc run a.mind --task W", ["Walk", "Wait"]),
        ("mindc run --task Wal", ["Walk"]),
        ("mindc bench a.mind --master W", ["Wander", "Watch"]),
        ("mindc train a.mind Wander Wa", ["Watch"]),
        ("mindc train a.mind --curriculum S", ["School"]),
        ("mindc whatif a.mind --sensor f", ["front"]),
        ("mindc why a.mind base.l", ["base.left_wheel"]),
        ("mindc edit rename a.mind fr", ["front"]),
        ("mindc edit connect a.mind Watch base.", ["base.left_wheel"]),
        ("mindc edit encapsulate a.mind Wander New --with Wat", ["Watch"]),
        ("mindc explain ultras", ["ultrasonic"]),
        ("mindc kinds act", ["actuator"]),
        ("mindc lint --select few-ticks,unread-s", ["few-ticks,unread-sensor"]),
        ("mindc run a.mind --task=W", ["Walk", "Wait"]),
        ("mindc run absent.mind --task W", [*FILES, "compopt -o default"]),
        ("mindc why a", [*FILES, "a.mind"]),
    ],
)
def test_bash_completes_what_the_mind_declares(bash: Path, words: str, found: list[str]) -> None:
    """Although two lines of it are wrong."""
    Path("a.mind").write_text(MIND)
    Path("wheels.mind").write_text("actuator left_wheel is wheel side left\n")
    assert completed(bash, words)[: len(found)] == found


def test_it_is_installed_once(home: Path, mindc: Call) -> None:
    (home / ".zshrc").write_text("alias l=ls")
    for _ in range(2):
        said = mindc("completion", "zsh", "--install")
        assert (said.code, said.out) == (0, "")
    script = home / ".local" / "share" / "mind" / "completion.zsh"
    assert (home / ".zshrc").read_text() == f'alias l=ls\nsource "{script}"\n'
    assert str(script) in said.err


def test_fish_has_a_folder_for_it(home: Path, mindc: Call) -> None:
    assert mindc("completion", "fish", "--install").code == 0
    names = sorted(path.name for path in (home / ".config" / "fish" / "completions").iterdir())
    assert names == ["mindc.fish", "mindrun.fish"]


def test_the_shell_is_that_of_the_user(home: Path, mindc: Call, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("SHELL", "/usr/bin/fish")
    assert "complete" in mindc("completion").out
    assert not list(home.iterdir())
    monkeypatch.setenv("SHELL", "/bin/tcsh")
    said = mindc("completion")
    assert (said.code, said.out) == (2, "")
    assert "Write mindc completion bash, zsh or fish." in said.err


def test_a_home_that_cannot_be_written_is_a_sentence(home: Path, mindc: Call) -> None:
    (home / ".local").write_text("")
    said = mindc("completion", "bash", "--install")
    assert said.code == 2
    assert "cannot be written" in said.err


@pytest.mark.parametrize("shell", SHELLS)
def test_mindrun_prints_the_script_that_mindc_installs(shell: str, mindc: Call) -> None:
    command = [sys.executable, "-m", "mindrun", "completion", shell]
    said = subprocess.run(command, capture_output=True, text=True, check=True, timeout=600).stdout
    assert "_MINDRUN_COMPLETE" in said
    assert mindc("completion", shell).out.endswith(said)
