"""The site, built once for all tests of it."""

import fcntl
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from tests.project.sources import ROOT


@pytest.fixture(scope="session")
def site(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Its folder; tests are skipped where what builds it is not installed."""
    for package in ("sphinx", "myst_parser", "furo"):
        pytest.importorskip(package, reason="the site is built with pip install -e '.[docs]'")
    base = tmp_path_factory.getbasetemp()
    folder = (base.parent if "PYTEST_XDIST_WORKER" in os.environ else base) / "built"
    folder.mkdir(exist_ok=True)
    with (folder / "lock").open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)  # the first process that tests it builds it for the others
        if not (folder / "site" / "index.html").exists():
            build(folder)
    return folder / "site"


def build(folder: Path) -> None:
    """The site of this checkout; a warning fails."""
    strict = ["--quiet", "--fail-on-warning", "--keep-going", "--conf-dir", "docs", "--doctree-dir"]
    words = [sys.executable, "-m", "sphinx", *strict, str(folder / "doctrees"), ".", str(folder / "site")]
    done = subprocess.run(words, cwd=ROOT, capture_output=True, text=True)
    if done.returncode:
        shutil.rmtree(folder / "site", ignore_errors=True)
    assert done.returncode == 0, done.stderr
