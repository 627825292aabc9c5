"""Both packages as they are published: source archives, wheels, and installs into empty environments of each Python."""

import os
import shutil
import subprocess
import sys
import tarfile
import zipfile
from collections.abc import Iterator
from pathlib import Path

import pytest
from mindrun import VERSION

from tests.calling import RULES
from tests.project.pythons import PIP, VERSIONS, has_index, python_of
from tests.project.sources import ROOT

PROJECTS = {"mindlang": ROOT, "mindrun": ROOT / "runtime"}
NEEDED_TO_WORK_ON_IT = ("Makefile", "CONTRIBUTING.md", "CHANGELOG.md", "Containerfile", "editors/vscode/package.json")
NEEDED_BY_TESTS = (
    "playground/package-lock.json",
    "playground/src/index.html",
    "tests/formats/0.1.0/rover.bundle",
    "examples/collect/collect.lock",
    "tests/robot/recordings/simulated.rec",
)
CHASE = RULES.replace("skill Chase is rule", "skill Chase is mlp hidden 1").replace(" at 3 * ball_bearing - 0.7", "")
LESSON = """
curriculum School is genetic population 4
  teaches Chase on Chase for 2 generations
"""
LEARNT = CHASE.replace(" at 2.3 - 3 * ball_bearing", "") + LESSON
WITHOUT_OURS = {name: value for name, value in os.environ.items() if name not in ("PYTHONPATH", "VIRTUAL_ENV")}


def run(*words: object, cwd: Path) -> str:
    """What a program that must succeed prints, without the sources in its path."""
    command = [str(word) for word in words]
    done = subprocess.run(command, capture_output=True, text=True, cwd=cwd, env=WITHOUT_OURS, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


def built(source: Path, target: str, folder: Path) -> Path:
    """What hatchling builds of a folder."""
    run(sys.executable, "-m", "hatchling", "build", "-t", target, "-d", folder, cwd=source)
    (made,) = folder.iterdir()
    return made


def members(wheel: Path) -> dict[str, bytes]:
    """The files of a wheel."""
    with zipfile.ZipFile(wheel) as archive:
        return {name: archive.read(name) for name in archive.namelist()}


@pytest.fixture(scope="module")
def archives(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Path]:
    """The source archive of each project."""
    return {name: built(source, "sdist", tmp_path_factory.mktemp(name)) for name, source in PROJECTS.items()}


@pytest.fixture(scope="module")
def wheels(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Path]:
    """The wheel of each project."""
    return {name: built(source, "wheel", tmp_path_factory.mktemp(name)) for name, source in PROJECTS.items()}


@pytest.mark.slow
@pytest.mark.parametrize("project", PROJECTS)
def test_a_source_archive_builds_the_same_wheel(
    project: str, archives: dict[str, Path], wheels: dict[str, Path], tmp_path: Path
) -> None:
    with tarfile.open(archives[project]) as archive:
        archive.extraction_filter = getattr(tarfile, "data_filter", None)  # of Python 3.11.4 and later
        archive.extractall(tmp_path / "unpacked")
    (source,) = (tmp_path / "unpacked").iterdir()
    assert members(built(source, "wheel", tmp_path / "wheel")) == members(wheels[project])


@pytest.mark.slow
def test_the_source_archive_has_what_working_on_it_needs(archives: dict[str, Path]) -> None:
    with tarfile.open(archives["mindlang"]) as archive:
        names = {name.partition("/")[2] for name in archive.getnames()}
    assert {*NEEDED_TO_WORK_ON_IT, *NEEDED_BY_TESTS} - names == set()
    assert not [name for name in names if "node_modules" in name or "__pycache__" in name or name.endswith(".code")]


def test_a_wheel_has_its_package_and_nothing_else(wheels: dict[str, Path]) -> None:
    packages = {name: {path.partition("/")[0] for path in members(wheel)} for name, wheel in wheels.items()}
    assert {each for each in packages["mindlang"] if ".dist-info" not in each} == {"mindlang", "mindrun"}
    assert {each for each in packages["mindrun"] if ".dist-info" not in each} == {"mindrun"}
    assert "mindlang/grammar/mind.lark" in members(wheels["mindlang"])


@pytest.fixture(scope="module", params=VERSIONS)
def empty(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Path]:
    """A folder with an empty environment of each Python in `venv`; it goes away afterwards, for it becomes large."""
    python = python_of(request.param)
    if python is None:
        pytest.skip(f"there is no Python {request.param}")
    if not has_index():
        pytest.skip("pip reaches no index of packages")
    folder = tmp_path_factory.mktemp(f"python{request.param}-")
    run(python, "-m", "venv", folder / "venv", cwd=folder)
    yield folder
    shutil.rmtree(folder)


@pytest.mark.slow
def test_the_robot_s_package_runs_where_nothing_else_is(empty: Path, wheels: dict[str, Path], tmp_path: Path) -> None:
    place = empty / "venv" / "bin"
    run(place / "python", *PIP, "install", "--quiet", wheels["mindrun"], cwd=empty)
    assert run(place / "mindrun", "--version", cwd=tmp_path).strip() == f"mindrun, version {VERSION}"
    formats = ROOT / "tests" / "formats" / "0.1.0"
    readings = ["--readings", formats / "rover.readings.jsonl", "--influence"]
    said = run(place / "mindrun", formats / "rover.bundle", *readings, cwd=tmp_path)
    assert said == (formats / "rover.commands.jsonl").read_text(encoding="utf-8")
    run(place / "python", *PIP, "uninstall", "--quiet", "--yes", "mindrun", cwd=empty)


@pytest.mark.slow
def test_the_compiler_checks_and_teaches_where_nothing_else_is(
    empty: Path, wheels: dict[str, Path], tmp_path: Path
) -> None:
    place = empty / "venv" / "bin"
    run(place / "python", *PIP, "install", "--quiet", wheels["mindlang"], cwd=empty)
    assert run(place / "mindc", "--version", cwd=tmp_path).strip() == f"mindc, version {VERSION}"
    assert run(place / "mindrun", "--version", cwd=tmp_path).strip() == f"mindrun, version {VERSION}"
    (tmp_path / "learnt.mind").write_text(LEARNT, encoding="utf-8")
    run(place / "mindc", "check", "learnt.mind", cwd=tmp_path)
    run(place / "mindc", "train", "learnt.mind", "--seed", 1, cwd=tmp_path)
    assert "weights" in (tmp_path / "learnt.lock").read_text(encoding="utf-8")
    run(place / "mindc", "build", "learnt.mind", "-o", "learnt.bundle", cwd=tmp_path)
    run(place / "mindrun", "learnt.bundle", "--describe", cwd=tmp_path)
