"""The examples in environments of Gymnasium: each is checked, and its shipped weights do what its page says."""

import json
from dataclasses import dataclass
from pathlib import Path

import pytest

from tests.calling import Call
from tests.language.examples import ROOT

PICTURE_BYTES = 120_000


@dataclass(frozen=True)
class Example:
    """Which package its environment needs, its task, and what 5 runs from seed 1 score at least."""

    name: str
    package: str
    task: str
    score: float

    @property
    def path(self) -> Path:
        return ROOT / "examples" / self.name / f"{self.name}.mind"


EXAMPLES = [
    Example("lander", "Box2D", "Land", 220.0),
    Example("walker", "Box2D", "Walk", -80.0),
    Example("doorkey", "minigrid", "Fetch", 85.0),
    Example("gaits", "gymnasium", "Seek", 70.0),
]


@pytest.fixture(params=EXAMPLES, ids=lambda example: example.name)
def example(request: pytest.FixtureRequest) -> Example:
    """One whose environment is installed."""
    pytest.importorskip("gymnasium")
    pytest.importorskip(request.param.package)
    found: Example = request.param
    return found


@pytest.mark.parametrize("command", [["check"], ["lint"], ["fmt", "--check"], ["prove"]], ids=lambda words: words[0])
def test_nothing_is_said_against_it(mindc: Call, example: Example, command: list[str]) -> None:
    said = mindc(*command, example.path)
    assert said.code == 0, said.out + said.err


def test_all_that_learns_is_taught(mindc: Call, example: Example) -> None:
    said = mindc("status", example.path, "--json")
    states = {skill["status"] for skill in json.loads(said.out)["skills"]}
    assert said.code == 0
    assert states <= {"trained", "does not learn"}, said.out


def test_its_shipped_weights_do_what_its_page_says(mindc: Call, example: Example) -> None:
    said = mindc("bench", example.path, "--task", example.task, "--runs", 5, "--seed", 1, "--json")
    assert said.code == 0, said.err
    assert json.loads(said.out)["score_mean"] >= example.score


@pytest.mark.parametrize("name", [example.name for example in EXAMPLES])
def test_its_page_and_its_picture_stand_beside_it(name: str) -> None:
    folder = ROOT / "examples" / name
    assert (folder / f"{name}.png").stat().st_size <= PICTURE_BYTES
    assert f"mindc bench examples/{name}/{name}.mind" in (folder / "README.md").read_text(encoding="utf-8")
