"""The site: read whole, and written; some of its pages, or with `make test-slow` all of them."""

import fcntl
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from tests.project.sources import ROOT

STRICT = ("--quiet", "--fail-on-warning", "--keep-going")
# With the language, pictures, tables and HTML; of their links to others nothing is said.
SOME = ("docs/index", "docs/kinds", "README", "examples/collect/RESULTS")


@pytest.fixture(scope="session")
def doctrees(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of what Sphinx has read: every page, without a warning, and each of its links has an end."""
    return built("read", tmp_path_factory, *STRICT, "--builder", "dummy") / "doctrees"


@pytest.fixture(scope="session", params=["some", pytest.param("all", marks=pytest.mark.slow)])
def site(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of its pages."""
    if request.param == "all":
        return built("all", tmp_path_factory, *STRICT) / "site"
    patterns = ",".join(f"{page}.md" for page in SOME)
    return built("some", tmp_path_factory, "-Q", "--define", f"include_patterns={patterns}") / "site"


@pytest.fixture(scope="session")
def whole_site(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of all of its pages."""
    return built("all", tmp_path_factory, *STRICT) / "site"


def built(name: str, factory: pytest.TempPathFactory, *options: str) -> Path:
    """The folder of a build of this checkout; tests are skipped where what builds it is not installed."""
    for package in ("sphinx", "myst_parser", "furo"):
        pytest.importorskip(package, reason="the site is built with pip install -e '.[docs]'")
    base = factory.getbasetemp()
    folder = (base.parent if "PYTEST_XDIST_WORKER" in os.environ else base) / f"built-{name}"
    folder.mkdir(exist_ok=True)
    with (folder / "lock").open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)  # the first process that tests it builds it for the others
        if not (folder / "site").exists():
            places = ["--conf-dir", "docs", "--doctree-dir", folder / "doctrees", ".", folder / "site"]
            words = [sys.executable, "-m", "sphinx", *options, *places]
            done = subprocess.run(words, cwd=ROOT, capture_output=True, text=True)
            if done.returncode:
                shutil.rmtree(folder / "site", ignore_errors=True)
            assert done.returncode == 0, done.stderr
    return folder
