"""What is public is what the page says, and importing it imports no more than is asked for."""

import importlib
import re
import subprocess
import sys
from pathlib import Path

import mindrun
import pytest

import mindlang

PAGE = Path(__file__).parents[2] / "docs" / "python.md"


def loaded(code: str, *packages: str) -> list[str]:
    """Which of these packages a program has imported when it ends."""
    code += f"\nimport sys; print(*[name for name in {packages!r} if name in sys.modules])"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return done.stdout.split()


@pytest.mark.parametrize("package", [mindlang, mindrun])
def test_the_page_names_all_that_is_public(package: object) -> None:
    name = package.__name__  # type: ignore[attr-defined]
    table = PAGE.read_text(encoding="utf-8").partition(f"| `{name}` |")[2].partition("\n\n")[0]
    rows = [line.split("|")[1] for line in table.splitlines()[2:]]
    assert sorted(re.findall(r"`(\w+)`", " ".join(rows))) == sorted(package.__all__)  # type: ignore[attr-defined]


@pytest.mark.parametrize("package", [mindlang, mindrun])
def test_every_public_name_is_there_and_explained(package: object) -> None:
    for name in package.__all__:  # type: ignore[attr-defined]
        assert getattr(package, name).__doc__, name
    with pytest.raises(AttributeError, match="has no attribute 'Nothing'"):
        package.Nothing  # type: ignore[attr-defined]  # noqa: B018


def test_modules_of_the_packages_can_be_imported_from_them() -> None:
    assert importlib.import_module("mindrun.engine.engine").Engine is mindrun.Engine
    assert loaded("from mindlang.editing import transaction", "numba") == []


def test_importing_them_imports_nothing() -> None:
    assert loaded("import mindlang, mindrun", "numpy", "numba", "lark", "mindlang.api", "mindrun.graph.graph") == []


def test_a_robot_needs_no_simulator() -> None:
    code = "from mindrun import Bundle, Engine, Graph, Policy, read_bundle, replay_recording, write_bundle"
    assert loaded(code, "numpy", "numba", "pymunk", "mindrun.sim", "mindlang") == ["numpy"]


def test_the_guardian_needs_no_numpy() -> None:
    assert loaded("import mindrun.robot.guardian.__main__, mindrun.robot.guardian.process", "numpy") == []
