"""The playground, built of the sources in a folder of its own."""

import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from tests.project.sources import ROOT

PLAYGROUND = ROOT / "playground"


def built_playground(folder: Path) -> Path:
    """The folder that is served; a test is skipped where npm is not, or installs nothing."""
    if not shutil.which("npm"):
        pytest.skip("the playground is built where there is node with npm")
    sources = folder / "playground"
    shutil.copytree(PLAYGROUND, sources, ignore=shutil.ignore_patterns("node_modules", "__pycache__"))
    installed = PLAYGROUND / "node_modules"
    if installed.is_dir():
        (sources / "node_modules").symlink_to(installed)
    elif npm("ci", "--ignore-scripts", "--no-audit", "--no-fund", folder=sources).returncode:
        pytest.skip("npm cannot install the packages of playground/package-lock.json: there is no registry in reach")
    packed = [sys.executable, str(PLAYGROUND / "pack.py"), str(folder / "build" / "playground")]
    subprocess.run(packed, check=True)
    for words in (("run", "check"), ("run", "build", "--", str(folder / "site" / "playground"))):
        done = npm(*words, folder=sources)
        assert done.returncode == 0, done.stdout + done.stderr
    return folder / "site"


def npm(*words: str, folder: Path) -> subprocess.CompletedProcess[str]:
    """A command of npm in a folder."""
    return subprocess.run(["npm", *words], cwd=folder, capture_output=True, text=True, check=False)
