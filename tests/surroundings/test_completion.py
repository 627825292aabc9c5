"""`mindc completion`: what click completes of the words of mindc, by itself and in a real bash."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from mindlang.executors import KINDS
from tests.calling import Call

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
MINDC = f'#!/bin/sh\nexec "{sys.executable}" -c "from mindlang.cli import main; main()" "$@"\n'
ASK = """
source "$1"
compopt() { :; }
read -r -a COMP_WORDS <<< "$2"
COMP_CWORD=$((${#COMP_WORDS[@]} - 1))
_mindc_completion mindc
printf '%s\\n' "${COMPREPLY[@]}"
"""


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with a mind of which two lines are wrong."""
    monkeypatch.chdir(tmp_path)
    Path("a.mind").write_text(MIND)
    Path("wheels.mind").write_text("actuator left_wheel is wheel side left\n")
    return tmp_path


@pytest.mark.parametrize(
    ("line", "found"),
    [
        ("mindc che", ["plain,check"]),
        ("mindc edit enca", ["plain,encapsulate"]),
        ("mindc lint --sel", ["plain,--select"]),
        ("mindc lint --format sa", ["plain,sarif"]),
        ("mindc lint --format=sa", ["plain,sarif"]),
        ("mindc check bal", ["file,bal"]),
        ("mindc train a.mind --on t", ["plain,threads"]),
        ("mindc train a.mind --on d", [f"plain,{kind}:" for kind in KINDS if kind.startswith("d")]),
        ("mindc run a.mind --task W", ["plain,Walk", "plain,Wait"]),
        ("mindc run --task Wal", ["plain,Walk"]),
        ("mindc bench a.mind --master W", ["plain,Wander", "plain,Watch"]),
        ("mindc train a.mind Wander Wa", ["plain,Watch"]),
        ("mindc train a.mind --curriculum S", ["plain,School"]),
        ("mindc whatif a.mind --sensor f", ["plain,front"]),
        ("mindc why a.mind base.l", ["plain,base.left_wheel"]),
        ("mindc edit rename a.mind fr", ["plain,front"]),
        ("mindc edit connect a.mind Watch base.", ["plain,base.left_wheel"]),
        ("mindc edit encapsulate a.mind Wander New --with Wat", ["plain,Watch"]),
        ("mindc explain ultras", ["plain,ultrasonic"]),
        ("mindc kinds act", ["plain,actuator"]),
        ("mindc lint --select few-ticks,unread-s", ["plain,few-ticks,unread-sensor"]),
        ("mindc run absent.mind --task W", ["file,W"]),
        ("mindc why a", ["file,a"]),
    ],
)
def test_what_may_come_next(
    folder: Path, mindc: Call, monkeypatch: pytest.MonkeyPatch, line: str, found: list[str]
) -> None:
    """Words of mindc, names that the mind declares, and files where any word may stand."""
    monkeypatch.setenv("_MINDC_COMPLETE", "bash_complete")
    monkeypatch.setenv("COMP_WORDS", line)
    monkeypatch.setenv("COMP_CWORD", str(line.count(" ")))
    said = mindc()
    assert (said.code, said.out.split()) == (0, found)


@pytest.mark.skipif(shutil.which("bash") is None, reason="needs bash")
def test_a_real_bash_completes(folder: Path, mindc: Call) -> None:
    script, program = folder / "script", folder / "bin" / "mindc"
    script.write_text(mindc("completion", "bash").out)
    program.parent.mkdir()
    program.write_text(MINDC)
    program.chmod(0o755)
    environment = {**os.environ, "PATH": f"{program.parent}:{os.environ['PATH']}"}
    for line, word in (("mindc che", "check"), ("mindc run a.mind --task Wal", "Walk")):
        command = ["bash", "-c", ASK, "bash", script, line]
        ran = subprocess.run(command, capture_output=True, text=True, check=True, env=environment)
        assert (ran.stdout.split(), ran.stderr) == ([word], "")


@pytest.mark.parametrize("shell", ["zsh", "fish"])
def test_other_shells_have_a_script(mindc: Call, shell: str) -> None:
    assert f"_MINDC_COMPLETE={shell}_complete" in mindc("completion", shell).out
