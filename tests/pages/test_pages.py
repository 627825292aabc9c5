"""Every page of the documentation does what it says: its commands are run, in order, and print what is shown.

After a change of what commands print: UPDATE=1 pytest tests/pages, and read the difference.
"""

import os
import re
from pathlib import Path

import cv2
import numpy as np
import pytest

from tests.pages.blocks import MADE, pages
from tests.pages.comparing import MEANWHILE, fits
from tests.pages.programs import printed_by, runnable, with_marks
from tests.pages.running import Reader
from tests.pages.transcript import INDENT, Command, Program, Write, steps
from tests.project.sources import ROOT

RUN = [
    ROOT / page
    for page in pages()
    if page not in MADE
    and any(isinstance(step, Command | Program) for step in steps((ROOT / page).read_text(encoding="utf-8")))
]
# They take more than ten seconds of a core, are not read first, and other tests, as those of tests/run, do as they do.
SLOW = {"docs/tour.md", "docs/breakpoints.md", "docs/lifelong.md", "docs/logs.md", "docs/propose.md"}
PICTURE_BYTES = 180_000
LEFT = {"docs/tutorial.md": "rover"}  # what a page ends with, as an example
SAME_PIXELS = 2.0  # mean difference of two pictures, of 255, below which only a library draws its letters otherwise


def name(page: Path) -> str:
    """The page as its readers call it."""
    return str(page.relative_to(ROOT))


def marked() -> list[object]:
    """Those with something to run, the long ones marked."""
    return [pytest.param(page, id=name(page), marks=[pytest.mark.slow] if name(page) in SLOW else []) for page in RUN]


@pytest.mark.usefixtures("imported_mindc")
@pytest.mark.parametrize("page", marked())
def test_a_page_does_what_it_says(tmp_path: Path, page: Path) -> None:
    reader = Reader.of(name(page), tmp_path)
    text = page.read_text(encoding="utf-8")
    lines, wrong, parts = text.splitlines(), [], []
    for step in steps(text):
        match step:
            case Write():
                reader.write(step)
            case Program(part):
                parts.append(part)
            case Command():
                status, printed = reader.run(step)
                assert status in (0, 1), f"$ {step.line}\n{printed}"
                if not fits(step.output, printed):
                    wrong.append((step, printed))
    if os.environ.get("UPDATE"):
        for step, printed in reversed(wrong):
            now = MEANWHILE.sub("", printed).rstrip("\n").splitlines()
            lines[step.first : step.end] = [(INDENT + line).rstrip() for line in now]
        page.write_text("\n".join(lines) + "\n", encoding="utf-8")
    else:
        assert [f"$ {step.line}\n{printed}\nand not\n{step.output}" for step, printed in wrong] == []
    keep_or_compare(reader.folder, page)
    if name(page) in LEFT:
        compare_example(ROOT / "examples" / LEFT[name(page)], reader.folder)
    program, missing = runnable(parts)
    program, comments = with_marks(program)
    status, printed = reader.program(program)
    assert status == 0, printed
    said = [(comment, printed_by(printed, number)) for number, comment in enumerate(comments)]
    assert [f"{seen}\nand not\n{comment}" for comment, seen in said if not fits(comment, seen)] == []
    if missing:
        pytest.skip(f"all but what needs {', '.join(missing)} has been run")


def keep_or_compare(folder: Path, page: Path) -> None:
    """The pictures that a page shows and its commands have made."""
    for link in re.findall(r"!\[[^\]]*\]\(([^)]+\.png)\)", page.read_text(encoding="utf-8")):
        kept, made = page.parent / link, folder / Path(link).name
        if not made.exists():
            continue
        if os.environ.get("UPDATE") and (not kept.exists() or differ(kept, made)):
            kept.parent.mkdir(exist_ok=True)
            kept.write_bytes(made.read_bytes())
        assert not differ(kept, made), f"{link} is no longer what the page's commands draw"
        assert kept.stat().st_size <= PICTURE_BYTES


def compare_example(example: Path, made: Path) -> None:
    """An example that is what a page ends with: the source, the wiring, and what was learnt."""
    for kept in sorted(path for path in example.rglob("*") if path.is_file() and path.name != "README.md"):
        now = (made / kept.relative_to(example)).read_bytes()
        if os.environ.get("UPDATE"):
            kept.write_bytes(now)
        assert kept.read_bytes() == now, kept


def differ(one: Path, other: Path) -> bool:
    """Whether two pictures show something else."""
    a, b = cv2.imread(str(one)), cv2.imread(str(other))
    return a.shape != b.shape or float(np.abs(a.astype(int) - b).mean()) > SAME_PIXELS


@pytest.mark.parametrize("page", ["README.md", "docs/tutorial.md", "docs/tour.md", "docs/python.md"])
def test_there_is_something_to_run(page: str) -> None:
    assert ROOT / page in RUN
