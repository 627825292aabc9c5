"""The page is what its sources make: small, in the colours of the pictures, the same bytes wherever it is built."""

import re
import shutil
import subprocess
import zipfile
from pathlib import Path

import pytest

from mindlang.pictures.theme import NIGHT, PAPER, Colour, Theme
from tests.project.sources import ROOT
from tests.project.test_install import wheel
from tests.project.test_style import FILE_LINES

PAGE, VIEWER = ROOT / "mindlang" / "view" / "page", ROOT / "viewer"
FILES = ("LICENSES.txt", "index.html", "view.css", "view.js")
BUNDLE_BYTES = 200_000
SHARED = ("page", "floor", "grid", "wall", "rock", "rock_edge", "ink", "robot", "lamp", "ray", "crash", "dark", "glow")


def test_it_is_small() -> None:
    assert sorted(path.name for path in PAGE.iterdir()) == sorted(FILES)
    assert sum((PAGE / name).stat().st_size for name in FILES) < BUNDLE_BYTES


def test_its_sources_are_as_short_as_all_others() -> None:
    for path in sorted((VIEWER / "src").glob("*.ts")):
        lines = path.read_text(encoding="utf-8").splitlines()
        assert len(lines) <= FILE_LINES, path.name
        assert lines[0].startswith("/** "), f"{path.name} does not say what it is"


@pytest.mark.slow
def test_the_wheel_has_it(tmp_path: Path) -> None:
    with zipfile.ZipFile(wheel(ROOT, tmp_path)) as archive:
        for name in FILES:
            assert archive.read(f"mindlang/view/page/{name}") == (PAGE / name).read_bytes()


def test_it_asks_nobody_and_runs_nothing_that_stands_in_a_text() -> None:
    page, style, program = ((PAGE / name).read_text(encoding="utf-8") for name in FILES[1:])
    assert re.findall(r"<script(?![^>]* src=\"view.js\")|<style| style=| on[a-z]+=|https?:", page) == []
    assert re.findall(r"url\(|@import", style) == []
    assert {*re.findall(r"https?://[^\s\"'`)]+", program)} <= {"http://www.w3.org/2000/svg"}
    sources = "".join(path.read_text(encoding="utf-8") for path in (VIEWER / "src").glob("*.ts"))
    assert re.findall(r"innerHTML|outerHTML|insertAdjacentHTML|document\.write|\beval\(|new Function", sources) == []


@pytest.mark.parametrize(("theme", "scheme"), [(PAPER, ""), (NIGHT, '[data-theme="dark"]')])
def test_its_colours_are_those_of_the_pictures(theme: Theme, scheme: str) -> None:
    text = (VIEWER / "src" / "view.css").read_text(encoding="utf-8")
    [block] = re.findall(rf":root{re.escape(scheme)} {{(.*?)}}", text, re.DOTALL)
    found = dict(re.findall(r"--([a-z-]+): ([^;]+);", block))
    for name in SHARED:
        assert found[name.replace("_", "-")] == code(getattr(theme, name)), name
    assert found["skills"].split() == [code(colour) for colour in theme.skills]


def code(colour: Colour) -> str:
    """#rrggbb."""
    blue, green, red = colour
    return f"#{red:02x}{green:02x}{blue:02x}"


@pytest.mark.skipif(not shutil.which("npm"), reason="the page is built again where there is node 20 with npm")
def test_it_is_what_its_sources_make(tmp_path: Path) -> None:
    """The packages are those of the lock file; without a network, those that were installed before."""
    viewer = tmp_path / "viewer"
    shutil.copytree(VIEWER, viewer, ignore=shutil.ignore_patterns("node_modules"))
    installed = VIEWER / "node_modules"
    if installed.is_dir():
        (viewer / "node_modules").symlink_to(installed)
    elif npm("ci", "--ignore-scripts", "--no-audit", "--no-fund", folder=viewer).returncode:
        pytest.skip("npm cannot install the packages of viewer/package-lock.json: there is no registry in reach")
    checked = npm("run", "check", folder=viewer)
    assert checked.returncode == 0, checked.stdout
    built = npm("run", "build", "--", str(tmp_path / "page"), folder=viewer)
    assert built.returncode == 0, built.stderr
    for name in FILES:
        assert (tmp_path / "page" / name).read_bytes() == (PAGE / name).read_bytes(), f"npm run build: {name}"


def npm(*words: str, folder: Path) -> subprocess.CompletedProcess[str]:
    """A command of npm in a folder."""
    return subprocess.run(["npm", *words], cwd=folder, capture_output=True, text=True, check=False)
