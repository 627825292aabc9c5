"""The architectures of the paper's section 2: a file each, taught, on the one task that they share."""

import json

import pytest

from benchmarks.background import FOLDER, NAMES
from tests.calling import Call

# What 20 runs of a minute score at least, a good deal below what they do.
LEAST = {}


@pytest.mark.parametrize("name", NAMES)
def test_it_is_taught_and_does_what_its_page_says(mindc: Call, name: str) -> None:
    mind = FOLDER / f"{name}.mind"
    for command in (["check"], ["lint"], ["fmt", "--check"]):
        said = mindc(*command, mind)
        assert said.code == 0, said.out + said.err
    said = mindc("bench", mind, "--task", "Forage", "--runs", 20, "--seed", 1, "--json")
    assert said.code == 0, said.err
    assert json.loads(said.out)["score_mean"] >= LEAST[name]


def test_each_has_a_paragraph() -> None:
    page = (FOLDER / "README.md").read_text(encoding="utf-8")
    assert all(f"[{name}.mind]({name}.mind)" in page for name in NAMES)
    assert {path.stem for path in FOLDER.glob("*.mind")} == {*NAMES, "parts"}
