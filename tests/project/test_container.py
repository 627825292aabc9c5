"""The container: built from the files that it is given and no more; where there is a builder, built and used."""

import fnmatch
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from tests.project.sources import ROOT

BUILDERS = ("podman", "docker", "buildah")
IGNORE = ".containerignore"


def given() -> list[str]:
    """The names at the top that the builder is given."""
    lines = (ROOT / IGNORE).read_text(encoding="utf-8").splitlines()
    assert lines[0] == "*"
    return [line.removeprefix("!") for line in lines if line.startswith("!")]


def builder() -> str | None:
    """A program that builds containers, and answers."""
    asked = (name for name in BUILDERS if shutil.which(name))
    return next((name for name in asked if not subprocess.run([name, "info"], capture_output=True).returncode), None)


def test_what_it_is_given_is_there_and_enough_for_the_wheel(tmp_path: Path) -> None:
    for name in given():
        path = ROOT / name
        if path.is_dir():
            shutil.copytree(path, tmp_path / name, ignore=shutil.ignore_patterns("__pycache__", "compiled"))
        else:
            shutil.copy(path, tmp_path / name)
    command = [sys.executable, "-m", "hatchling", "build", "-t", "wheel"]
    subprocess.run(command, cwd=tmp_path, check=True, capture_output=True)
    assert [path for path in (tmp_path / "dist").iterdir() if fnmatch.fnmatch(path.name, "mindlang-*.whl")]


def test_docker_is_given_the_same() -> None:
    assert (ROOT / ".dockerignore").read_text() == (ROOT / IGNORE).read_text()


@pytest.mark.slow
@pytest.mark.skipif(not builder(), reason=f"no builder answers: {', '.join(BUILDERS)}")
def test_it_is_built_and_checks_a_mind() -> None:
    program = builder()
    assert program
    (base,) = re.findall(r"^ARG PYTHON=(\S+)$", (ROOT / "Containerfile").read_text(), re.MULTILINE)
    if subprocess.run([program, "pull", base], capture_output=True).returncode:
        pytest.skip(f"{base} is not to be had here")
    subprocess.run([program, "build", "-t", "mind-test", "-f", "Containerfile", "."], cwd=ROOT, check=True)
    if program == "buildah":
        pytest.skip("buildah builds, and runs nothing")
    folder = ROOT / "examples" / "collect"
    command = [program, "run", "--rm", "-v", f"{folder}:/work:ro,Z", "mind-test", "check", "collect.mind"]
    subprocess.run(command, check=True)
