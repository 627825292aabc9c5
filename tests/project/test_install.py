"""Both installs, each from its wheel in an environment of its own: the compiler's, and the robot's with numpy alone."""

import subprocess
import sys
import sysconfig
from pathlib import Path
from shutil import copy

import pytest

from tests.project.sources import ROOT
from tests.project.test_packages import WITHOUT_OURS, run

PACKAGES = Path(sysconfig.get_path("purelib"))
PIP = [sys.executable, "-m", "pip", "--quiet", "--disable-pip-version-check"]


def wheel(source: Path, folder: Path) -> Path:
    """The wheel of a project."""
    run(sys.executable, "-m", "hatchling", "build", "-t", "wheel", "-d", folder, cwd=source)
    return next(folder.glob("*.whl"))


def environment(folder: Path) -> tuple[Path, Path]:
    """A bare virtual environment: its Python, and where its packages go."""
    run(sys.executable, "-m", "venv", "--without-pip", folder, cwd=folder.parent)
    python = folder / "bin" / "python"
    return python, Path(run(python, "-c", "import sysconfig; print(sysconfig.get_path('purelib'))", cwd=folder).strip())


def install(python: Path, wheel: Path, *options: str) -> None:
    """Install a wheel with nothing to download, so that what it needs must already be there."""
    run(*PIP, "--python", python, "install", "--no-index", "--no-compile", *options, wheel, cwd=wheel.parent)


@pytest.fixture(scope="module")
def workstation(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The Python of an environment with the compiler's wheel, which borrows its dependencies from this one."""
    folder = tmp_path_factory.mktemp("workstation")
    python, packages = environment(folder / "venv")
    install(python, wheel(ROOT, folder), "--no-deps")
    (packages / "borrowed.pth").write_text(f"{PACKAGES}\n")
    return python


@pytest.fixture(scope="module")
def robot(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The Python of an environment with the runtime's wheel and numpy, and nothing else."""
    folder = tmp_path_factory.mktemp("robot")
    python, packages = environment(folder / "venv")
    for part in PACKAGES.glob("numpy*"):
        (packages / part.name).symlink_to(part)
    install(python, wheel(ROOT / "runtime", folder))
    return python


@pytest.fixture(scope="module")
def bundle(workstation: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A mind that needs no training, built by the installed compiler."""
    folder = tmp_path_factory.mktemp("bundle")
    copy(ROOT / "examples" / "braitenberg.mind", folder)
    run(workstation.with_name("mindc"), "build", "braitenberg.mind", "-o", "b.bundle", cwd=folder)
    return folder / "b.bundle"


def test_the_compiler_is_where_it_was_installed(workstation: Path, tmp_path: Path) -> None:
    where = run(workstation, "-c", "import mindlang, mindrun; print(mindlang.__file__, mindrun.__file__)", cwd=tmp_path)
    assert all(Path(file).is_relative_to(workstation.parents[1]) for file in where.split())
    assert run(workstation.with_name("mindc"), "--version", cwd=tmp_path).startswith("mindc, version ")


def test_the_compiler_reports_mistakes_where_it_is_installed(workstation: Path, tmp_path: Path) -> None:
    (tmp_path / "wrong.mind").write_text("skill Avoid is mpl hidden 2\n")
    done = subprocess.run(
        [workstation.with_name("mindc"), "check", "wrong.mind"], capture_output=True, cwd=tmp_path, env=WITHOUT_OURS
    )
    assert done.returncode == 1
    assert b"wrong.mind:1" in done.stderr
    assert b"mlp" in done.stderr


def test_the_robot_has_no_compiler(robot: Path, tmp_path: Path) -> None:
    names = ("mindlang", "numba", "pymunk", "lark")
    missing = f"from importlib.util import find_spec; print([name for name in {names} if find_spec(name)])"
    assert run(robot, "-c", missing, cwd=tmp_path).strip() == "[]"


def test_the_robot_runs_a_bundle(robot: Path, bundle: Path, tmp_path: Path) -> None:
    readings = tmp_path / "readings.jsonl"
    readings.write_text("{}\n")
    line = run(robot.with_name("mindrun"), bundle, "--readings", readings, "--fill", "0.5", cwd=tmp_path)
    assert line.startswith('{"commands": {')
