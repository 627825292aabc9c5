"""All code of all pages is run or held against what it is for; what is not, stands below with the reason why.

What is run is in `test_pages`; the pages that tests/explain makes are compiled there.
"""

import json
import re
import subprocess
import tomllib
from pathlib import Path

import pytest
import yaml
from jsonschema import Draft202012Validator

from mindlang.compiler.compile import load
from mindlang.lint.settings import settings_of
from mindlang.robot.options import schema
from mindlang.robot.wire import load_wiring
from tests.pages.blocks import MADE, TERMINAL, Block, blocks, pages
from tests.pages.command_lines import PROGRAMS, calls, is_known, program_of, refused, typed
from tests.pages.programs import runnable
from tests.project.sources import ROOT

COLLECT = ROOT / "examples" / "collect"
NOT_HELD = {  # languages that nothing here reads; what runs them is tests/server/test_in_other_editors.py
    "text": "pictures and formulas",
    "lua": "Neovim",
    "elisp": "Emacs",
}
NOT_OURS = {  # programs of which it is only tried that the line is one of a shell
    ". alias cat cd code cp cut do done echo export git grep mkdir rm sed until": "the shell's and the system's own",
    "apt apt-get i2cdetect raspi-config sudo systemctl": "a Raspberry Pi, or the system",
    "openssl podman sbatch srun tensorboard": "not installed here, or begun by tests of their own",
    "mypy npm pip pytest ruff": "the network, or the tests themselves; the extras of pip are in tests/project",
}
EXCERPTS = {"README.md", "docs/index.md"}  # what they show of the language is part of an example
OF_A_PART = {"unwired-sensor", "unwired-actuator", "unknown-sensor"}  # what a robot.yaml lacks of which a part is shown
ALL = [block for page in pages() if page not in MADE for block in blocks(page)]


def of(language: str, rest: str = "") -> list[Block]:
    """The blocks in a language."""
    found = [each for each in ALL if each.language == language and each.rest.startswith(rest)]
    assert found
    return found


def test_every_block_is_in_a_language_that_is_held_or_listed() -> None:
    held = {TERMINAL, "mind", "diff", "python", "yaml", "toml", "json", *NOT_HELD}
    assert [str(each) for each in ALL if each.language not in held] == []
    assert {each.language for each in ALL} == held


def test_what_is_no_code_has_no_command() -> None:
    lines = [(str(block), line) for block in of("text") for line in block.text.splitlines()]
    assert [each for each in lines if each[1].split()[:1] in (["$"], ["mindc"], ["mindrun"])] == []


def test_what_is_typed_is_what_the_programs_take(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    Path("scheduler.json").write_text('{"address": "tls://head:8786"}')  # at which --on looks at once
    Path("tls.pem").touch()
    foreign = {name for names in NOT_OURS for name in names.split()}
    lines = {str(block): typed(block.text) for block in of(TERMINAL)}
    script = "".join(f"# {block}\n" + "\n".join(typed) + "\n" for block, typed in lines.items())
    said = subprocess.run(["bash", "-n"], input=script, capture_output=True, text=True, check=False)
    assert (said.returncode, said.stderr) == (0, ""), script
    for block, typed_there in lines.items():
        words = [call for line in typed_there for call in calls(line)]
        assert words, block
        assert {program_of(call) for call in words} <= foreign | PROGRAMS.keys(), block
        assert [(call, why) for call in words if (why := refused(call))] == [], block


def test_what_is_shown_of_the_language_is_a_file_that_is_run_or_part_of_an_example() -> None:
    example = (COLLECT / "collect.mind").read_text(encoding="utf-8")
    excerpts = [block for block in of("mind") if block.page in EXCERPTS]
    assert excerpts
    assert [part for block in excerpts for part in block.text.split("\n\n") if part.strip() not in example] == []
    assert [str(block) for block in of("mind") if block.page not in EXCERPTS and not block.rest] == []


def test_a_program_is_python() -> None:
    """What of it can be run here is, in `test_pages`."""
    for block in of("python"):
        compile(block.text, str(block), "exec")
        missing = runnable([block.text])[1]
        known = ["gymnasium", "lab_kinds", "pettingzoo", "stable_baselines3", "supersuit", "torch"]
        assert {*missing} <= {*known}, str(block)


def test_robots_are_wired_as_the_schema_and_the_compiler_have_it(tmp_path: Path) -> None:
    here = [each for each in ALL if each.page == "docs/robot-yaml.md"]
    whole, part = (each.text for each in here if each.rest == "robot.yaml")
    for each in here:
        if each.language == "python":
            (tmp_path / each.rest).write_text(each.text, encoding="utf-8")
    graph = load(COLLECT / "ball.mind").graph
    assert graph
    for text in (whole, whole.replace("sensors:\n", part)):
        (tmp_path / "robot.yaml").write_text(text, encoding="utf-8")
        assert list(Draft202012Validator(schema()).iter_errors(yaml.safe_load(text))) == []
        assert {each.code for each in load_wiring(tmp_path / "robot.yaml", graph).diagnostics} <= OF_A_PART


def test_settings_are_read_by_what_reads_settings(tmp_path: Path) -> None:
    for block in of("toml", "mind.toml"):
        (tmp_path / "mind.toml").write_text(block.text, encoding="utf-8")
        assert settings_of(tmp_path / "mind.toml"), str(block)


def test_what_other_programs_read_has_their_form() -> None:
    assert [block for block in of("toml") if not tomllib.loads(block.text)] == []
    assert [block for block in of("json") if not json.loads(f"{{{block.text}}}")] == []
    for block in of("yaml"):
        yaml.safe_load(block.text)


def test_the_hooks_before_a_commit_are_there() -> None:
    there = yaml.safe_load((ROOT / ".pre-commit-hooks.yaml").read_text(encoding="utf-8"))
    [shown] = [yaml.safe_load(each.text)["repos"] for each in ALL if each.language == "yaml" and "repos" in each.text]
    assert {hook["id"] for repo in shown for hook in repo["hooks"]} == {hook["id"] for hook in there}


def test_the_examples_of_each_command_are_what_it_takes(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Those of its help, as docs/commands.md has them: words, and behind two spaces what they are for."""
    monkeypatch.chdir(tmp_path)
    Path("scheduler.json").write_text('{"address": "tls://head:8786"}')
    lines = [line for each in blocks("docs/commands.md") for line in each.text.splitlines()[1:]]
    words = [call for line in lines for call in calls(line.partition("  ")[0])]
    assert {program_of(call) for call in words} == {"mindc", "mindrun", "dot"}
    assert [(call, why) for call in words if (why := refused(call))] == []


SAID = re.compile(r"`(mind(?:c|run) [a-z]+(?: [^`]+)?)`")


def test_what_sentences_say_of_the_programs_is_there() -> None:
    """`mindc run --video`: the command, and each of its options."""
    fenced = re.compile(r"^ *```.*?^ *```$", re.DOTALL | re.MULTILINE)
    texts = {page: fenced.sub("", (ROOT / page).read_text(encoding="utf-8")) for page in pages() if page not in MADE}
    assert [(page, said) for page, text in texts.items() for said in SAID.findall(text) if not is_known(said)] == []
