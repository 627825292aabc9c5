"""`mindc probe`: what a memory knows of what was drawn, since when, and what it does not know."""

import json
import re
from pathlib import Path

import pytest

from tests.calling import Call

MIND = """
mind 1
tick 1/10 s
master Go
body Robot is disc
actuator lit is lamp neutral 0
sensor side is order 1 to 3
sensor tone is order 0 to 1
sensor other is order 0 to 1 every 0.1 s
sensor clock is clock period 10 s
memory kept is register
memory trace is cell decay 0.5
memory deaf is register
skill Write is rule
  reads side2
  reads tone
  drives kept at side2
  drives trace at tone
sensor side2 is reading 2 of side
skill Go is rule
  reads other
  reads clock
  influences Write at 1 when clock > 19.5% and clock < 30%
  drives deaf at other
  drives lit at 0.5
task Go in plain
  draws shift from 0 1
  lasts 6 s
  rewards shift per tick
"""
FORGETTING = re.sub(r"memory .*?(?=skill Go)|  influences .*?\n|  drives deaf.*?\n", "", MIND, flags=re.S)


@pytest.fixture
def mind(tmp_path: Path) -> Path:
    path = tmp_path / "kept.mind"
    path.write_text(MIND)
    return path


def knows(mindc: Call, mind: Path, *words: str) -> dict[str, dict[str, float]]:
    """What each memory knows, by its name."""
    return {each["name"]: each for each in json.loads(mindc("probe", mind, *words, "--json").out)["knows"]}


def test_a_register_knows_from_the_tick_in_which_it_was_written(mindc: Call, mind: Path) -> None:
    found = knows(mindc, mind, "--of", "side", "--runs", "150")
    assert 20 <= found["kept"]["since"] <= 23  # it is asked about every two or three ticks
    assert found["kept"]["last"] > 0.6 > 0.45 > found["kept"]["chance"]  # one of three is told from the others
    assert found["deaf"]["since"] is None
    assert found["deaf"]["last"] < 0.5


def test_of_a_number_it_is_the_variance_that_is_explained_while_it_is_there(mindc: Call, mind: Path) -> None:
    found = knows(mindc, mind, "Go", "--of", "tone", "--runs", "60")
    assert found["trace"]["best"] > 0.99
    assert found["trace"]["best_tick"] >= 21
    before = [known for tick, known in zip(found["trace"]["ticks"], found["trace"]["scores"], strict=True) if tick < 20]
    assert max(before) <= 0
    assert found["deaf"]["best"] < 0.3


def test_nobody_knows_what_nobody_was_told(mindc: Call, mind: Path) -> None:
    found = knows(mindc, mind, "--of", "shift", "--runs", "100")
    assert all(each["since"] is None for each in found.values())
    assert all(abs(each["last"] - 0.5) < 0.25 for each in found.values())


def test_a_table_of_80_columns(mindc: Call, mind: Path) -> None:
    said = mindc("probe", mind, "--of", "side", "--runs", "40").out
    assert "side, share right, 40 runs of Go under Go" in said
    assert "memory kept" in said
    assert max(map(len, said.splitlines())) <= 80


@pytest.mark.parametrize(
    ("words", "text", "says"),
    [
        (("--of", "sid"), MIND, "draws nothing called sid"),
        (("--of", "side"), FORGETTING, "this mind remembers nothing"),
        (("--of", "side", "--runs", "1"), MIND, "the same in all of these runs"),
    ],
)  # fmt: skip
def test_what_cannot_be_asked(mindc: Call, mind: Path, words: tuple[str, ...], text: str, says: str) -> None:
    mind.write_text(text)
    said = mindc("probe", mind, *words)
    assert said.code != 0
    assert says in said.err
