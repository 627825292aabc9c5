"""The container: built from the files that it is given and no more; where there is a builder, built and used."""

import fnmatch
import os
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


def copy_given(folder: Path) -> None:
    """The files that a builder is given, in a folder."""
    folder.mkdir(exist_ok=True)
    for name in given():
        path = ROOT / name
        if path.is_dir():
            shutil.copytree(path, folder / name, ignore=shutil.ignore_patterns("__pycache__", "compiled"))
        else:
            shutil.copy(path, folder)


def test_what_it_is_given_is_there_and_enough_for_the_wheel(tmp_path: Path) -> None:
    copy_given(tmp_path)
    command = [sys.executable, "-m", "hatchling", "build", "-t", "wheel"]
    subprocess.run(command, cwd=tmp_path, check=True, capture_output=True)
    assert [path for path in (tmp_path / "dist").iterdir() if fnmatch.fnmatch(path.name, "mindlang-*.whl")]


@pytest.mark.slow
def test_its_steps_work_in_an_empty_environment(tmp_path: Path) -> None:
    """Its RUN lines, one after the other, where there is nothing but Python, in folders of their own."""
    venv, work = tmp_path / "venv", tmp_path / "work"
    subprocess.run([sys.executable, "-m", "venv", venv], check=True)
    path, cache = f"{venv / 'bin'}:/usr/bin:/bin", f"{tmp_path / 'cache'}"
    environment = {"PATH": path, "HOME": f"{tmp_path}", "NUMBA_CACHE_DIR": cache}
    environment |= {name: value for name, value in os.environ.items() if name.startswith(("PIP_", "SSL_"))}
    asked = ["pip", "download", "-q", "--no-deps", "-d", f"{tmp_path}", "click"]
    if subprocess.run(asked, env=environment, capture_output=True).returncode:
        pytest.skip("there is no package index")
    copy_given(tmp_path / "source")
    lines = re.findall(r"^RUN ((?:.*\\\n)*.*)$", (ROOT / "Containerfile").read_text(encoding="utf-8"), re.MULTILINE)
    assert len(lines) == 2
    for line in lines:
        here = re.sub(r"(?<= )/(source|wheels|cache|work)\b", rf"{tmp_path}/\1", line)
        subprocess.run(["sh", "-c", here], env=environment, check=True, capture_output=True)
    assert not (tmp_path / "wheels").exists()
    shutil.copy(ROOT / "examples" / "collect" / "collect.mind", work)
    subprocess.run(["mindc", "check", "collect.mind"], cwd=work, env=environment, check=True)


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
