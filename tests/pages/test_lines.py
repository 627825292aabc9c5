"""Lines that pages show without what they print are run where they can be: pytest -m slow tests/pages/test_lines.py."""

import re
from importlib.util import find_spec
from pathlib import Path

import pytest

from tests.pages.blocks import MADE, TERMINAL, blocks, pages
from tests.pages.command_lines import calls, program_of, typed
from tests.pages.running import Reader
from tests.pages.transcript import Command

NOT_RUN = {  # what cannot be, by what it begins with or contains
    r"--on (ssh|slurm|dask|processes)": "other machines, or tests/executors",
    r"^mindc deploy|robot\.local": "a robot",
    r"^mindc view (?!.*--export)|--view": "a page that is shown until somebody ends it",
    r"^(~/.*)?mindrun ": "a robot, or a dry run, which takes its real time",
    r"^mindc train .*(--attempts|--force|--tensorboard)": "minutes to hours of teaching",
    r"day\.rec|run\.rec|a\.mind|old/|day\.break": "files of the reader's own",
    r"^mindc (lint \. --fix|fmt \. --check)|plot runs|edit undo": "nothing to be done where all is as it should be",
}
NEEDS = {
    "examples/doorkey/README.md": "minigrid",
    "examples/gaits/README.md": "gymnasium",
    "examples/lander/README.md": "Box2D",
    "examples/walker/README.md": "Box2D",
}


def lines(page: str) -> list[str]:
    """Those of mindc and mindrun that can be run."""
    shown = [each.text for each in blocks(page) if each.language == TERMINAL and not each.text.startswith("$ ")]
    known = [line.partition(" #")[0].rstrip() for text in shown for line in typed(text)]
    ours = [line for line in known if {program_of(call) for call in calls(line)} <= {"mindc", "mindrun"}]
    return [line for line in ours if not any(re.search(pattern, line) for pattern in NOT_RUN)]


RUN = [page for page in pages() if page not in MADE and lines(page)]


@pytest.mark.slow
@pytest.mark.parametrize("page", RUN)
def test_what_a_page_shows_without_its_print_runs(page: str, tmp_path: Path) -> None:
    if page in NEEDS and find_spec(NEEDS[page]) is None:
        pytest.skip(f"{NEEDS[page]} is not installed")
    reader = Reader.of(page, tmp_path)
    for line in lines(page):
        status, printed = reader.run(Command(line, "", 0, 0))
        assert status == 0 or line.startswith("mindc status"), f"$ {line}\n{printed}"


def test_every_reason_has_a_line() -> None:
    shown = "\n".join(each.text for page in pages() for each in blocks(page) if each.language == TERMINAL)
    assert [pattern for pattern in NOT_RUN if not re.search(pattern, shown, re.MULTILINE)] == []
