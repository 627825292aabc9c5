"""`mindc completion`: what a real bash completes, what is installed where, and that other shells are told all words."""

import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from mindrun.shell_completion import SHELLS
from mindrun.tools import tools
from mindrun.tools.completion import script_of_mindrun

from tests.calling import Call

COMPLETE = """
source "$1"
COMP_WORDS=({words}); COMP_CWORD=$((${{#COMP_WORDS[@]}} - 1))
compopt() {{ echo "compopt $*"; }}
{function} {program}
printf '%s\\n' "${{COMPREPLY[@]}}"
"""


@pytest.fixture
def home(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("HOME", str(tmp_path))
    for name in ("XDG_DATA_HOME", "XDG_CONFIG_HOME"):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.fixture
def bash(home: Path, mindc: Call, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The installed script; `mindc` of the script is that of this test."""
    bin_ = home / "bin"
    bin_.mkdir()
    (bin_ / "mindc").write_text(f"#!/bin/sh\nexec {sys.executable} -c 'from mindlang.cli import main; main()' \"$@\"\n")
    (bin_ / "mindc").chmod(0o755)
    monkeypatch.setenv("PATH", f"{bin_}:/usr/bin:/bin")
    assert mindc("completion", "bash", "--install").code == 0
    return home / ".local" / "share" / "mind" / "completion.bash"


def completed(script: Path, words: str) -> list[str]:
    program = words.split()[0]
    function = {"mindc": "_mindc_completion", "mindrun": "_mindrun"}[program]
    text = COMPLETE.format(words=words, function=function, program=program)
    ran = subprocess.run(["bash", "-c", text, "bash", script], capture_output=True, text=True, check=True, timeout=600)
    return ran.stdout.split("\n")[:-1]


@pytest.mark.skipif(shutil.which("bash") is None, reason="needs bash")
def test_bash_completes_both_programs(bash: Path) -> None:
    assert completed(bash, "mindc che") == ["check"]
    assert completed(bash, "mindc edit enca") == ["encapsulate"]
    assert completed(bash, "mindc lint --sel") == ["--select"]
    assert completed(bash, "mindc lint --format sa") == ["sarif"]
    assert completed(bash, "mindc check coll")[:2] == ["compopt -o", "default"], "files"
    assert completed(bash, "mindrun rep") == ["compopt -o filenames", "replay", "report"]
    assert completed(bash, "mindrun ball.bundle --ar") == ["--arm"]
    assert completed(bash, "mindrun report --js") == ["--json"]


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


@pytest.mark.skipif(shutil.which("bash") is None, reason="needs bash")
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
        ("mindc run absent.mind --task W", ["compopt -o", "default"]),
        ("mindc why a", ["compopt -o", "default"]),
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
def test_every_shell_is_told_every_tool_and_option_of_mindrun(shell: str) -> None:
    text = script_of_mindrun(shell)
    assert all(name in text for name in (*tools(), "view-port", "step-seconds"))
