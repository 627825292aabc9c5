"""Artefacts whose hashes are right and whose content is anything: used, or refused in one sentence."""

import resource
import shutil
from collections import Counter
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from random import Random

import pytest
from mindrun.errors import MindError

from benchmarks.call_count import CallCount
from tests.resealed.artefacts import ARTEFACTS

MOST_CALLS = 6_000_000  # an artefact takes 600,000 at most: ten times as many is another order of work
LARGEST = 1 << 30  # bytes of memory


@contextmanager
def little_memory(most: int) -> Iterator[None]:
    """MemoryError for who asks for more than this, beside what the process has."""
    pages = int(Path("/proc/self/statm").read_text().split()[0])
    before = resource.getrlimit(resource.RLIMIT_AS)
    resource.setrlimit(resource.RLIMIT_AS, (pages * resource.getpagesize() + most, before[1]))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_AS, before)


def outcome(name: str, number: int, folder: Path) -> str:
    """What came of the artefact of this number; anything foreign is raised."""
    shutil.rmtree(folder, ignore_errors=True)
    artefact = ARTEFACTS[name]
    for path, data in artefact.tamper(Random(f"{name} {number}")).items():
        (folder / path).parent.mkdir(parents=True, exist_ok=True)
        (folder / path).write_bytes(data)
    try:
        with little_memory(LARGEST):
            artefact.use(folder)
        said = ""
    except MindError as error:
        said = str(error)
        assert said.strip()
    assert "\x1b" not in said
    return "refused" if said else "used"


@pytest.mark.parametrize("name", ARTEFACTS)
def test_a_few(name: str, tmp_path: Path) -> None:
    counts = Counter(outcome(name, number, tmp_path / "x") for number in range(15))
    assert counts["refused"] or name == "release"  # of which only is shown what can be


@pytest.mark.slow
@pytest.mark.parametrize("name", ARTEFACTS)
def test_a_thousand(name: str, tmp_path: Path) -> None:
    """Ten thousand of all together."""
    outcome(name, 0, tmp_path / "x")  # what is compiled and loaded once
    counts: Counter[str] = Counter()
    most = 0
    for number in range(1000):
        with CallCount(MOST_CALLS) as calls:
            counts[outcome(name, number, tmp_path / "x")] += 1
        most = max(most, calls.number)
    print(f"{name}: {dict(counts)}, at most {most:,} calls")
