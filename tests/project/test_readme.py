"""What the documentation shows is there."""

import os
import re
import shutil
import subprocess
import sys
import tomllib
from collections.abc import Iterator
from pathlib import Path

import click
import pytest

from mindlang.cli import commands
from tests.project.sources import ROOT

README = (ROOT / "README.md").read_text(encoding="utf-8")
ROADMAP = README.index("## Not there yet")
STEPS = README[README.index("## First steps") : README.index("## In an editor")]
# the test copies; the others take their time, and a view does not end
LONG = ("cp ", "mindc prove ", "mindc train ", "mindc plot ", "mindc view ")


def shown() -> Iterator[tuple[str, str]]:
    """The commands of the first steps, and what each is said to print."""
    for block in re.findall(r"(?:^    .*\n|^\n(?=    ))+", STEPS, re.MULTILINE):
        lines = re.sub(r"^    ", "", block, flags=re.MULTILINE)
        for command, text in re.findall(r"^\$ (.*)\n((?:(?!\$ ).*\n)*)", lines, re.MULTILINE):
            yield command.partition("    #")[0], text.rstrip("\n")


def test_the_excerpt_is_part_of_the_example() -> None:
    excerpt = README.split("```\n")[1]
    example = (ROOT / "examples" / "collect" / "collect.mind").read_text(encoding="utf-8")
    assert all(part.strip() in example for part in excerpt.split("\n\n"))


def test_every_command_is_there() -> None:
    shown = set(re.findall(r"mindc (\w+) \S", README[:ROADMAP]))
    assert shown
    assert shown <= set(commands.list_commands(click.Context(commands)))


def test_every_target_is_in_the_makefile() -> None:
    targets = set(re.findall(r"^([\w-]+):", (ROOT / "Makefile").read_text(encoding="utf-8"), re.MULTILINE))
    assert set(re.findall(r"\bmake ([\w-]+)(?=`|  )", README)) <= targets


def test_every_extra_is_there() -> None:
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    table = README.partition("| extra | for |")[2].partition("\n\n")[0]
    named = [name for row in table.splitlines()[2:] for name in re.findall(r"`(\w+)`", row.split("|")[1])]
    assert sorted(named) == sorted(project["optional-dependencies"])


@pytest.mark.parametrize("page", ["README.md", "docs/design.md"])
def test_every_path_is_there(page: str) -> None:
    text = (ROOT / page).read_text(encoding="utf-8")
    links = [Path(page).parent / link for link in re.findall(r"\]\((?!http)([^)]+)\)", text)]
    paths = re.findall(r"\b(?:examples|mindlang|grammar|runtime/mindrun)/[\w/.]+\w", text)
    assert links
    assert [
        path for path in [*links, *paths] if not (ROOT / path).exists() and not (ROOT / f"{path}.py").exists()
    ] == []


@pytest.fixture(scope="module")
def scratch(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The copy on which the first steps are taken."""
    folder = tmp_path_factory.mktemp("readme")
    shutil.copytree(ROOT / "examples", folder / "examples", ignore=shutil.ignore_patterns("runs"))
    shutil.copytree(folder / "examples", folder / "scratch")
    return folder / "scratch" / "collect"


@pytest.mark.parametrize(("command", "text"), [each for each in shown() if not each[0].startswith(LONG)])
def test_the_first_steps_print_what_is_shown(scratch: Path, command: str, text: str) -> None:
    """Results first, then what is said about them; … stands for anything, on a line of its own for any lines."""
    program = f'"{sys.executable}" -c "from mindlang.cli import main; main()"'
    done = subprocess.run(
        command.replace("mindc ", f"{program} "), shell=True, cwd=scratch, capture_output=True, text=True, check=False,
        env={**os.environ, "PYTHONPATH": os.pathsep.join(map(str, (ROOT, ROOT / "runtime")))},
    )  # fmt: skip
    pattern = re.escape(text).replace("\\\n…\\\n", "\n(?:.*\n)*").replace("…", ".*")
    assert done.returncode in (0, 1), done.stderr
    assert re.match(pattern, done.stdout + done.stderr), done.stdout + done.stderr


def test_the_first_steps_are_there() -> None:
    assert {command.split()[1] for command, _ in shown() if command.startswith("mindc ")} >= {
        "check", "prove", "show", "train", "bench", "plot", "run", "edit", "status", "diff",
    }  # fmt: skip
