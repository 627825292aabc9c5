"""The site, built once for all tests of it."""

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
    folder = tmp_path_factory.mktemp("site")
    strict = ["--quiet", "--fail-on-warning", "--keep-going", "--conf-dir", "docs", "--doctree-dir"]
    words = [sys.executable, "-m", "sphinx", *strict, str(folder / "doctrees"), ".", str(folder / "site")]
    done = subprocess.run(words, cwd=ROOT, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return folder / "site"
