"""What is known of numba's insides holds for the versions that are asked for; others are refused."""

import os
import subprocess
import sys
import tomllib

import pytest
from mindrun.errors import MindError
from mindrun.sim import versions

from tests.project.sources import ROOT

SIMULATE = "from mindlang.cli import main; main()", "run", "examples/collect/collect.mind", "--task", "Avoid"

FIRST = {"llvmlite": "0.46", "numba": "0.63"}


def test_what_is_asked_for_is_what_is_known() -> None:
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    assert {f"{name}{known}" for name, known in versions.KNOWN.items()} <= {*project["dependencies"]}


def test_what_is_installed_here_is_known() -> None:
    versions.refuse_unknown()


@pytest.mark.parametrize("found", ["0.61.2", "0.63.0rc2", "0.69.0", "0.69.0rc1", "1.0", "0.7"])
def test_another_version_is_refused(found: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(versions, "version", lambda name: found if name == "numba" else FIRST[name])
    with pytest.raises(MindError, match=f"numba {found} is installed, and the simulator knows >=0.63,<0.69") as e:
        versions.refuse_unknown()
    assert e.value.hint == "pip install 'numba>=0.63,<0.69'"


@pytest.mark.parametrize("found", ["0.63", "0.64.0rc2", "0.68.1", "0.68.10"])
def test_a_known_version_is_taken(found: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(versions, "version", lambda name: found if name == "numba" else FIRST[name])
    versions.refuse_unknown()


@pytest.mark.parametrize("optimised", ["", "2"])
def test_a_user_reads_one_sentence(optimised: str) -> None:
    """Before anything is imported that another version may not have; and `python -O` looks, too."""
    program = "import importlib.metadata as m; m.version = lambda name: '99.0'; " + SIMULATE[0]
    said = subprocess.run(
        [sys.executable, "-c", program, *SIMULATE[1:]],
        env=os.environ | {"PYTHONOPTIMIZE": optimised}, cwd=ROOT, capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert said.returncode == 1
    assert said.stderr.splitlines()[0].endswith("99.0 is installed, and the simulator knows >=0.46,<0.51")
    assert "Traceback" not in said.stderr
