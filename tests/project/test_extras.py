"""Every place that says how to install an extra names one that there is, by the name under which it is published."""

import re
import tomllib
from collections.abc import Iterator
from pathlib import Path

from mindrun import VERSION

from tests.project.sources import ROOT

PLACES = [
    "*.md",
    "Makefile",
    "Containerfile",
    "docs/**/*.md",
    "examples/**/*.md",
    "examples/**/*.py",
    "examples/**/*.sh",
]
PLACES += ["mindlang/**/*.py", "runtime/**/*.py", "runtime/*.md", "editors/vscode/*.js*", "editors/vscode/*.md"]
NAMED = re.compile(r"(?P<project>mindlang|mindrun|(?<=['\"])\.)\[(?P<extras>[a-z0-9]+(?:, *[a-z0-9]+)*)\]")
HERE = "."  # the folder in which one stands
WHERE_HERE = {"README.md", "CONTRIBUTING.md", "Makefile"}  # of whoever works on the sources


def project(folder: Path) -> dict:
    """What pyproject.toml says of a project."""
    return tomllib.loads((folder / "pyproject.toml").read_text(encoding="utf-8"))["project"]


MINDLANG, MINDRUN = project(ROOT), project(ROOT / "runtime")
EXTRAS = {each["name"]: set(each["optional-dependencies"]) for each in (MINDLANG, MINDRUN)}


def named() -> Iterator[tuple[str, str, str]]:
    """Every extra that is named: the file, the project, the extra."""
    for path in sorted({path for place in PLACES for path in ROOT.glob(place)}):
        if path.name == "package-lock.json" or "node_modules" in path.parts:
            continue
        for found in NAMED.finditer(path.read_text(encoding="utf-8")):
            for extra in found["extras"].split(","):
                yield str(path.relative_to(ROOT)), found["project"], extra.strip()


def test_those_that_are_named_are_there() -> None:
    everything = [*named()]
    assert len(everything) > 20
    for path, of, extra in everything:
        assert extra in EXTRAS["mindlang" if of == HERE else of], f"{path}: {of}[{extra}]"


def test_users_are_told_the_published_names() -> None:
    assert [each for each in named() if each[1] == HERE and each[0] not in WHERE_HERE] == []


def test_what_both_projects_need_is_the_same() -> None:
    assert MINDLANG["version"] == MINDRUN["version"] == VERSION
    assert MINDLANG["requires-python"] == MINDRUN["requires-python"]
    assert MINDLANG["optional-dependencies"]["robot"] == MINDRUN["optional-dependencies"]["robot"]
    assert set(map(name, MINDRUN["dependencies"])) <= set(map(name, MINDLANG["dependencies"]))


def name(requirement: str) -> str:
    """The distribution that a requirement is of."""
    return re.match(r"[\w-]+", requirement)[0]  # type: ignore[index]
