"""What benchmarks/mutation names is there: files, tests, and the mutants that are explained."""

import tomllib
from pathlib import Path

import pytest

from benchmarks.mutation.mutants import mutants
from benchmarks.mutation.rooms import ROOMS

ROOT = Path(__file__).parents[2]
HERE = ROOT / "benchmarks" / "mutation"


def test_rooms_name_files_and_tests_that_are_there() -> None:
    for room in ROOMS.values():
        assert [pattern for pattern in (*room.files, *room.but) if not [*ROOT.glob(pattern)]] == []
        for test in room.tests:
            path, _, function = test.partition("[")[0].partition("::")
            assert f"def {function}" in (ROOT / path).read_text(encoding="utf-8")


@pytest.mark.slow
def test_every_mutant_that_is_explained_can_still_be_made() -> None:
    listed = tomllib.loads((HERE / "explained.toml").read_text(encoding="utf-8"))["mutant"]
    made = {mutant.key for path in {one["path"] for one in listed} for mutant in mutants(ROOT, ROOT / path)}
    assert [one for one in listed if (one["path"], one["where"], one["was"], one["now"]) not in made] == []
