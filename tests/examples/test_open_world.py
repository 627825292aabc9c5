"""The examples of the open world: each is checked as its user would, and its shipped weights do what its page says."""

import json
from pathlib import Path

import pytest

from tests.calling import Call
from tests.language.examples import ROOT

# What 20 runs from seed 1 reach at least: a figure of `mindc bench --json`, a good deal below what it is.
REACHED = {
    "ball": ("Fetch", ["score_mean"], 32.0),
    "hunt": ("Hunt", ["count_mean"], 0.65),
    "light": ("SeekLight", ["by_event", "reach of lamp", "mean"], 4.0),
    "line": ("Unseen", ["score_mean"], 70.0),
    "maze": ("Explore", ["success", "mean"], 0.85),
    "micromouse": ("Solve", ["success", "mean"], 0.85),
    "patrol": ("Guard", ["score_mean"], 190.0),
    "quiz": ("Ask", ["success", "mean"], 0.95),
    "road": ("Drive", ["score_mean"], 130.0),
    "shaping": ("Live", ["by_event", "reach of prey", "mean"], 5.0),
    "soccer": ("Score", ["success", "mean"], 0.9),
    "sort": ("Sort", ["success", "mean"], 0.85),
    "stations": ("Tour", ["success", "mean"], 0.9),
    "sumo": ("Push", ["success", "mean"], 0.7),
    "tmaze": ("Run", ["success", "mean"], 0.95),
}
PICTURE_BYTES = 125_000

each = pytest.mark.parametrize("name", REACHED)


def mind(name: str) -> Path:
    return ROOT / "examples" / name / f"{name}.mind"


@each
@pytest.mark.parametrize("command", [["check"], ["lint"], ["fmt", "--check"], ["prove"]], ids=lambda words: words[0])
def test_nothing_is_said_against_it(mindc: Call, name: str, command: list[str]) -> None:
    said = mindc(*command, mind(name))
    assert said.code == 0, said.out + said.err


@each
def test_all_that_learns_is_taught(mindc: Call, name: str) -> None:
    said = mindc("status", mind(name), "--json")
    states = {skill["status"] for skill in json.loads(said.out)["skills"]}
    assert said.code == 0
    assert states <= {"trained", "does not learn"}, said.out


@each
def test_its_shipped_weights_do_what_its_page_says(mindc: Call, name: str) -> None:
    task, figure, least = REACHED[name]
    said = mindc("bench", mind(name), "--task", task, "--runs", 20, "--seed", 1, "--json")
    assert said.code == 0, said.err
    found = json.loads(said.out)
    for key in figure:
        found = found[key]
    assert found >= least


@each
def test_its_page_and_its_picture_stand_beside_it(name: str) -> None:
    folder = mind(name).parent
    assert (folder / f"{name}.png").stat().st_size <= PICTURE_BYTES
    assert f"mindc bench examples/{name}/{name}.mind" in (folder / "README.md").read_text(encoding="utf-8")
