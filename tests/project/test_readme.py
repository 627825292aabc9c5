"""What the documentation shows is there."""

import re
from pathlib import Path

import click
import pytest

from mindlang.cli import commands
from tests.project.sources import ROOT

README = (ROOT / "README.md").read_text(encoding="utf-8")
ROADMAP = README.index("## Not there yet")


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


@pytest.mark.parametrize("page", ["README.md", "docs/design.md"])
def test_every_path_is_there(page: str) -> None:
    text = (ROOT / page).read_text(encoding="utf-8")
    links = [Path(page).parent / link for link in re.findall(r"\]\((?!http)([^)]+)\)", text)]
    paths = re.findall(r"\b(?:examples|mindlang|grammar|runtime/mindrun)/[\w/.]+\w", text)
    assert links
    assert [
        path for path in [*links, *paths] if not (ROOT / path).exists() and not (ROOT / f"{path}.py").exists()
    ] == []
