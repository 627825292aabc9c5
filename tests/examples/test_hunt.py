"""The race of predators and prey: who meets whom, and what is said of it."""

import sys
from pathlib import Path
from shutil import copytree
from typing import Any

import numpy as np
import pytest

import mindlang
from tests.calling import Call
from tests.language.examples import ROOT

HUNT = ROOT / "examples" / "hunt"


@pytest.fixture(scope="module")
def race() -> Any:
    """race.py as a module."""
    sys.path.insert(0, str(HUNT))
    try:
        import race
    finally:
        sys.path.remove(str(HUNT))
    return race


@pytest.fixture
def short(race: Any, tmp_path: Path) -> Any:
    """A race of two rounds, of lessons of one generation."""
    folder = copytree(HUNT, tmp_path / "hunt")
    text = (folder / "hunt.mind").read_text(encoding="utf-8")
    (folder / "hunt.mind").write_text(text.replace("for 20 generations", "for 1 generations"), encoding="utf-8")
    mind = mindlang.load(folder / "hunt.mind")
    return race.Race(mind, {side: mind.rollout(side, side, race.SIDES) for side in race.SIDES}, 2, 7)


@pytest.mark.parametrize("side", ["Hunt", "Flee"])
def test_a_layout_is_against_the_opponent_that_its_seed_names(race: Any, short: Any, side: str) -> None:
    rollout, rng = short.rollouts[side], np.random.default_rng(1)
    other = next(each for each in race.SIDES if each != side)
    own, foes = (race.Against(rollout, name, ()).draw(3, rng) for name in (side, other))
    found = race.Against(rollout, side, [foe[np.newaxis] for foe in foes]).score(own, [5, 9, 1, 3, 4])
    for column, seed in enumerate([5, 9, 1, 3, 4]):
        for row, genome in enumerate(own):
            both = {side: genome, other: foes[seed % 3]}
            pair = np.concatenate([both["Hunt"], both["Flee"]])[np.newaxis]
            alone = rollout.score(pair, [seed])
            assert found.total[row, column] == alone.total[0, 0]
            assert found.counts[row, column] == alone.counts[0, 0]


def test_half_of_a_hall_of_fame_is_the_newest(race: Any) -> None:
    champions = [np.full((1, 1), number, np.float32) for number in range(4)]
    drawn = {hall: [int(each[0, 0]) for each in race.drawn_from(champions, hall)] for hall in (False, True)}
    assert drawn == {False: [3], True: [0, 1, 2, 3, 3, 3]}
    assert race.drawn_from(champions[:1], True) == champions[:1]


def test_a_race_is_the_same_again(short: Any) -> None:
    champions = short.run(True)
    assert [len(each) for each in champions.values()] == [2, 2]
    catches = short.catches(champions, 10)
    assert catches.shape == (2, 2)
    assert catches.tolist() == short.catches(short.run(True), 10).tolist()


def test_a_table_has_predators_in_rows(race: Any) -> None:
    catches = np.array([[0.2, 0.4, 0.1], [0.6, 0.5, 0.2], [0.9, 0.8, 0.3]])
    assert race.table(catches).splitlines()[1].split() == ["of", "round", "1", "20", "40", "10", "23"]
    assert "in at least 80% of the runs, earlier predators the last prey in at most 20%" in race.progress(catches)


def test_nothing_is_said_against_either_side(mindc: Call) -> None:
    for command in (["check"], ["lint"], ["fmt", "--check"]):
        said = mindc(*command, HUNT / "predators.mind", HUNT / "prey.mind")
        assert said.code == 0, said.out + said.err


def test_weights_are_tried_against_what_the_other_side_was_taught(mindc: Call, tmp_path: Path) -> None:
    mind, file = copytree(HUNT, tmp_path / "hunt") / "hunt.mind", tmp_path / "flee.safetensors"
    assert mindc("weights", "export", mind, "Flee", file).code == 0
    said = mindc("weights", "import", mind, "Flee", file)
    assert said.code == 0, said.err
    lock = mind.with_suffix(".lock")
    lock.write_text("".join(line for line in lock.read_text().splitlines(True) if not line.startswith("Hunt is")))
    said = mindc("weights", "import", mind, "Flee", file)
    assert said.code == 1
    assert "Hunt has not been taught" in said.err
