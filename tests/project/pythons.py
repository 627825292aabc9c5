"""The Pythons of this machine, one of each version that the packages are for; whether pip has an index."""

import os
import shutil
import subprocess
import sys
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory

VERSIONS = ("3.11", "3.12", "3.13")
PYENV = Path(os.environ.get("PYENV_ROOT") or Path.home() / ".pyenv") / "versions"
PIP = ["-m", "pip", "--disable-pip-version-check"]


@cache
def python_of(version: str) -> Path | None:
    """A Python of a version: this one, one in the path, or one of pyenv's."""
    named = shutil.which(f"python{version}")
    there = sorted(PYENV.glob(f"{version}.*/bin/python"))
    candidates = [Path(sys.executable), *([Path(named)] if named else []), *there]
    return next((path for path in candidates if _version_of(path) == version), None)


def _version_of(python: Path) -> str:
    """The version of a Python; nothing of one that does not start, as a shim of pyenv's may not."""
    code = "import sys, venv, ensurepip; print('{}.{}'.format(*sys.version_info))"
    done = subprocess.run([python, "-c", code], capture_output=True, text=True, check=False)
    return done.stdout.strip()


@cache
def has_index() -> bool:
    """Whether pip finds anything at all in its index."""
    with TemporaryDirectory() as folder:
        command = [sys.executable, *PIP, "download", "--no-deps", "--dest", folder, "click"]
        return subprocess.run(command, capture_output=True, check=False).returncode == 0
