"""What the documentation shows is there."""

import re
import tomllib
from pathlib import Path

import click
import pytest

from mindlang.cli import commands
from tests.project.sources import ROOT

README = (ROOT / "README.md").read_text(encoding="utf-8")
INSTALL = (ROOT / "docs" / "install.md").read_text(encoding="utf-8")
WALK = (ROOT / "docs" / "tour.md").read_text(encoding="utf-8")


def test_the_excerpt_is_part_of_the_example() -> None:
    excerpt = README.partition("```mind\n")[2].partition("```\n")[0]
    example = (ROOT / "examples" / "collect" / "collect.mind").read_text(encoding="utf-8")
    assert all(part.strip() in example for part in excerpt.split("\n\n"))


def test_every_command_is_there() -> None:
    shown = set(re.findall(r"mindc (\w+) \S", README))
    assert shown
    assert shown <= set(commands.list_commands(click.Context(commands)))


def test_every_target_is_in_the_makefile() -> None:
    targets = set(re.findall(r"^([\w-]+):", (ROOT / "Makefile").read_text(encoding="utf-8"), re.MULTILINE))
    assert set(re.findall(r"\bmake ([\w-]+)(?=`|  )", README)) <= targets


def test_what_ci_runs_stands_in_the_readme() -> None:
    command = (ROOT / ".ci" / "run").read_text(encoding="utf-8").splitlines()[-1].removeprefix("exec ")
    assert f"\n    {command} " in README


def test_every_extra_is_there() -> None:
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    table = INSTALL.partition("| extra | for |")[2].partition("\n\n")[0]
    named = [name for row in table.splitlines()[2:] for name in re.findall(r"`(\w+)`", row.split("|")[1])]
    assert sorted(named) == sorted(project["optional-dependencies"])


@pytest.mark.parametrize("page", ["README.md", "docs/design.md"])
def test_every_path_is_there(page: str) -> None:
    text = (ROOT / page).read_text(encoding="utf-8")
    links = [Path(page).parent / link for link in re.findall(r"\]\((?!http|#)([^)]+)\)", text)]
    paths = re.findall(r"\b(?:examples|mindlang|grammar|runtime/mindrun)/[\w/.]+\w", text)
    assert links
    assert [
        path for path in [*links, *paths] if not (ROOT / path).exists() and not (ROOT / f"{path}.py").exists()
    ] == []


def test_a_page_shows_the_commands() -> None:
    """Those that run do so in tests/pages."""
    assert set(re.findall(r"^    (?:\$ |.*\| )?mindc (\w+)", WALK, re.MULTILINE)) >= {
        "check", "lint", "prove", "show", "train", "bench", "plot", "run", "view", "why", "whatif", "edit", "status",
        "diff",
    }  # fmt: skip


def test_the_moving_picture_is_small() -> None:
    assert (ROOT / "docs" / "collect.gif").stat().st_size < 500_000


PRINTED = re.compile(r"^    \$ .*\n(?:    (?!\$ ).*\n|\n(?=    ))*", re.MULTILINE)  # a command, and what it prints
TOO_LONG = re.compile(r"^(?:!\[.*\]\(.*\)|<a href=.*</a>)$")  # pictures, of which a terminal shows the words
COLUMNS = 80


def test_it_can_be_read_in_a_terminal() -> None:
    """But for what programs print, which is as wide as it is."""
    lines = PRINTED.sub("", README).splitlines()
    assert len(lines) > 100
    assert [line for line in lines if len(line) > COLUMNS and not TOO_LONG.match(line)] == []
