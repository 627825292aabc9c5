"""The architectures of the paper's section 2: a file each, on the one task that they share."""

import pytest

from benchmarks.background import FOLDER, NAMES
from tests.calling import Call


@pytest.mark.parametrize("command", [["check"], ["lint"], ["fmt", "--check"]], ids=lambda words: words[0])
def test_nothing_is_said_against_them(mindc: Call, command: list[str]) -> None:
    said = mindc(*command, *(FOLDER / f"{name}.mind" for name in NAMES))
    assert said.code == 0, said.out + said.err


def test_each_has_a_paragraph() -> None:
    page = (FOLDER / "README.md").read_text(encoding="utf-8")
    assert all(f"[{name}.mind]({name}.mind)" in page for name in NAMES)
    assert {path.stem for path in FOLDER.glob("*.mind")} == {*NAMES, "parts"}
