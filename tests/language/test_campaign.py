"""Some hundreds of the million sources of `benchmarks/fuzz.py`: what must hold of any source holds of each."""

from pathlib import Path

import pytest

from benchmarks.fuzz import Place, check, ended_at
from benchmarks.sources import source

EXAMPLES = Path(__file__).parents[2] / "examples"


@pytest.mark.parametrize("block", range(4))
def test_any_source(tmp_path: Path, block: int) -> None:
    place = Place(tmp_path)
    for case in range(block * 10_000, block * 10_000 + 40):
        check(place, case, source(case))


NAMES = ("sort", "soccer", "patrol", "maze", "line", "light", "shaping", "sumo", "tmaze", "stations", "quiz")
OPEN_WORLD = [EXAMPLES / name / f"{name}.mind" for name in NAMES]


@pytest.mark.parametrize("block", range(2))
def test_any_mutant_of_an_open_world(tmp_path: Path, block: int) -> None:
    place = Place(tmp_path, OPEN_WORLD)
    for case in range(block * 10_000, block * 10_000 + 50):
        check(place, case, place.source(case))


def test_a_case_is_always_the_same() -> None:
    assert [source(case) for case in range(50)] == [source(case) for case in range(50)]


def test_a_run_goes_on_where_its_log_ends(tmp_path: Path) -> None:
    log = tmp_path / "log"
    assert ended_at(log) is None
    log.write_text("done 1000 3 s {}\nfound 1500 KeyError 'x'\ndone 2000 6 s {}\nfound 2001 KeyError 'x'\n")
    assert ended_at(log) == 2000
