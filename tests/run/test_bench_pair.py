"""`mindc bench` with two minds or two masters, and `--csv`: the same layouts for both, and every run in its row."""

import csv
import json
from pathlib import Path

import jsonschema
import numpy as np
import pytest

from mindlang.run.setup import layouts
from tests.calling import RULES, Call

SLOWER = RULES.replace("  drives left_wheel at 3 * ball_bearing - 0.7", "  drives left_wheel at 2 * ball_bearing - 0.6")
NUMBER, COUNT = {"type": ["number", "null"]}, {"type": "integer", "minimum": 0}
DIFFERENCE = {
    "type": "object",
    "properties": {
        **dict.fromkeys(("runs", "more", "less", "equal", "not_finite"), COUNT),
        **dict.fromkeys(("mean", "std", "standard_error", "low", "high", "unseen", "detectable"), NUMBER),
        "runs_to_tell": {"type": ["integer", "null"]},
    },
    "additionalProperties": False,
    "minProperties": 13,
}
SCHEMA = {
    "type": "object",
    "properties": {
        "task": {"type": "string"},
        **dict.fromkeys(("seed", "runs", "workers"), COUNT),
        "minds": {
            "type": "array",
            "minItems": 2,
            "maxItems": 2,
            "items": {"type": "object", "required": ["name", "file", "master", "score_mean", "by_event", "notes"]},
        },
        "confidence": {"const": 0.95},
        "differences": {
            "type": "object",
            "properties": {
                "score": DIFFERENCE,
                "success": DIFFERENCE,
                "by_event": {"type": "object", "additionalProperties": DIFFERENCE},
            },
            "required": ["by_event"],
            "additionalProperties": False,
        },
        "conclusion": {"type": "string"},
        "notes": {"type": "array", "items": {"type": "string"}},
    },
    "additionalProperties": False,
    "minProperties": 9,
}


def rows(path: Path) -> list[dict[str, str]]:
    """A CSV file as spreadsheets read it."""
    with path.open(newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


@pytest.fixture
def slower(rules: Path) -> Path:
    """A mind that turns less."""
    path = rules.with_name("slower.mind")
    path.write_text(SLOWER, encoding="utf-8")
    return path


def test_a_row_for_each_run_says_what_run_says_of_its_seed(mindc: Call, rules: Path, tmp_path: Path) -> None:
    path = tmp_path / "runs.csv"
    said = mindc("bench", rules, "--task", "Roam", "--runs", 5, "--seed", 7, "--csv", path, "--json")
    table, found = rows(path), json.loads(said.out)
    assert f"{path}: a row for each of 5 runs" in said.err
    assert [int(row["seed"]) for row in table] == layouts(7, 5)
    for row in table:
        one = json.loads(mindc("run", rules, "--task", "Roam", "--seed", row["seed"], "--json").out)
        assert float(row["score"]) == one["score"]
        assert {text: float(row[f"total {text}"]) for text in one["by_line"]} == one["by_line"]
        assert int(row["event reach of ball"]) == one["by_event"]["reach of ball"]
        assert (int(row["ticks"]), int(row["faults"])) == (one["ticks"], one["faults"])
        assert row["ended by"] == (one["ended_by"] or "time")
        assert int(row["event collision"]) == (one["ended_by"] == "collision")
    assert np.mean([float(row["score"]) for row in table]) == pytest.approx(found["score_mean"])


def test_a_success_is_a_column_and_a_score_that_is_no_number_is_empty(mindc: Call, rules: Path, tmp_path: Path) -> None:
    text = RULES.replace("  counts reach of ball", "  counts reach of ball\n  succeeds on 2 reach of ball", 1)
    rules.write_text(text.replace("rewards 10 on reach", "rewards 1 / (feeler - feeler) on reach", 1).replace(
        "at 0 30 330 deg", "at 0 deg"))  # fmt: skip
    path = tmp_path / "runs.csv"
    mindc("bench", rules, "--task", "Chase", "--runs", 4, "--csv", path)
    for row in rows(path):
        one = json.loads(mindc("run", rules, "--task", "Chase", "--seed", row["seed"], "--json").out)
        assert row["succeeded"] == str(int(one["succeeded"]))
    assert {row["score"] for row in rows(path)} == {""}


def test_two_minds_meet_the_same_layouts(mindc: Call, rules: Path, slower: Path, tmp_path: Path) -> None:
    path, options = tmp_path / "runs.csv", ("--task", "Chase", "--runs", 12, "--seed", 3)
    said = mindc("bench", rules, slower, *options, "--csv", path, "--json")
    found = json.loads(said.out)
    jsonschema.validate(found, SCHEMA)
    alone = [json.loads(mindc("bench", file, *options, "--json").out) for file in (rules, slower)]
    for mind, expected in zip(found["minds"], alone, strict=True):
        assert mind["score_mean"] == expected["score_mean"]
        assert mind["by_event"] == expected["by_event"]
    table = rows(path)
    assert [row["mind"] for row in table] == [str(rules)] * 12 + [str(slower)] * 12
    assert [row["seed"] for row in table[:12]] == [row["seed"] for row in table[12:]]
    ours, theirs = np.array([float(row["score"]) for row in table]).reshape(2, 12)
    score = found["differences"]["score"]
    assert score["mean"] == pytest.approx((theirs - ours).mean())
    assert score["standard_error"] == pytest.approx((theirs - ours).std(ddof=1) / 12**0.5)
    assert (score["more"], score["less"]) == ((theirs > ours).sum(), (theirs < ours).sum())
    assert found["conclusion"].startswith(f"On layouts of Chase, {rules} scores ")


def test_two_masters_of_one_mind(mindc: Call, rules: Path) -> None:
    options = ("--task", "Roam", "--runs", 12, "--master", "Chase", "--master", "Turn")
    said = mindc("bench", rules, *options)
    lines = said.out.splitlines()
    assert lines[0] == "Roam on the same layouts, 12 runs from seed 1"
    assert lines[1:3] == [f"  A  {rules} with Chase in charge", f"  B  {rules} with Turn in charge"]
    assert lines[4].split() == ["A", "B", "B", "−", "A", "95", "%", "confidence"]
    found = json.loads(mindc("bench", rules, *options, "--json").out)
    assert [mind["master"] for mind in found["minds"]] == ["Chase", "Turn"]
    assert lines[-1] == found["conclusion"]
    assert all(line == line.rstrip() for line in lines)


def test_each_of_two_minds_may_have_a_master_of_its_own(mindc: Call, rules: Path, slower: Path) -> None:
    said = mindc("bench", rules, slower, "--runs", 2, "--master", "Chase", "--master", "Turn", "--json")
    found = json.loads(said.out)
    assert [(mind["file"], mind["master"]) for mind in found["minds"]] == [(str(rules), "Chase"), (str(slower), "Turn")]
    assert [mind["name"] for mind in found["minds"]] == [f"{rules} with Chase", f"{slower} with Turn"]
    one = json.loads(mindc("bench", rules, slower, "--runs", 2, "--master", "Chase", "--json").out)
    assert [mind["master"] for mind in one["minds"]] == ["Chase", "Chase"]


def test_a_mind_beside_itself_differs_in_nothing(mindc: Call, rules: Path) -> None:
    found = json.loads(mindc("bench", rules, rules, "--runs", 12, "--json").out)
    assert [mind["name"] for mind in found["minds"]] == [f"{rules} (A)", f"{rules} (B)"]
    assert found["differences"]["score"]["equal"] == 12
    assert "come to the same score in 12 runs" in found["conclusion"]


def test_in_one_world_one_run_says_it_all(mindc: Call, rules: Path, slower: Path) -> None:
    for path, text in ((rules, RULES), (slower, SLOWER)):
        placed = text.replace(
            "size 2 reached moves\n  lasts 1200", "size 2 at 9 4\n  starts at 0 0 facing 30 deg\n  lasts 1200"
        )
        path.write_text(placed, encoding="utf-8")
    said = mindc("bench", rules, slower, "--task", "Chase", "--runs", 12)
    found = json.loads(mindc("bench", rules, slower, "--task", "Chase", "--runs", 12, "--json").out)
    jsonschema.validate(found, SCHEMA)
    assert (found["runs"], found["differences"]["score"]["runs"]) == (1, 1)
    assert all("1 world" in note for mind in found["minds"] for note in mind["notes"])
    better = slower if found["differences"]["score"]["mean"] > 0 else rules
    assert found["conclusion"].startswith(f"In the one world of Chase, {better} scores ")
    assert "confidence" not in said.out


def test_workers_change_nothing(mindc: Call, rules: Path, slower: Path) -> None:
    both = [
        json.loads(mindc("bench", rules, slower, "--runs", 9, "--workers", workers, "--json").out) for workers in (1, 2)
    ]
    assert both[0]["differences"] == both[1]["differences"]


def test_other_rewards_are_no_scores_to_compare(mindc: Call, rules: Path, slower: Path) -> None:
    slower.write_text(SLOWER.replace("rewards 10 on reach", "rewards 20 on reach"), encoding="utf-8")
    said = mindc("bench", rules, slower, "--task", "Chase", "--runs", 12, "--json")
    found = json.loads(said.out)
    jsonschema.validate(found, SCHEMA)
    assert [*found["differences"]] == ["by_event"]
    assert "counts" in found["conclusion"]
    assert f"note: the scores are not compared: in {slower} Chase has other rewards" in said.err
    assert len(found["notes"]) == 2


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("rules.mind", "rules.mind", "rules.mind"), "Two are compared, not more."),
        (("rules.mind", *("--master", "Chase") * 3), "Two are compared, not more."),
        (("rules.mind", "--master", "Chase", "--master", "Tur"), "there is no skill called Tur"),
        (("rules.mind", "none.mind"), "none.mind"),
        ((), "Missing argument"),
        (("rules.mind", "--csv", "runs.txt"), "runs.txt must end in .csv"),
        (("rules.mind", "--csv", "no/runs.csv"), "no/runs.csv cannot be written: there is no folder no"),
    ],
)
def test_what_cannot_be_compared_is_said(
    mindc: Call, rules: Path, monkeypatch: pytest.MonkeyPatch, words: tuple[str, ...], message: str
) -> None:
    monkeypatch.chdir(rules.parent)
    said = mindc("bench", *words)
    assert (said.code, said.out) == (2, "")
    assert message in said.err


def test_a_task_that_the_other_does_not_have_is_said(mindc: Call, rules: Path, slower: Path) -> None:
    slower.write_text(SLOWER.replace("task Chase", "task Hunt"), encoding="utf-8")
    said = mindc("bench", rules, slower, "--task", "Chase", "--runs", 2)
    assert (said.code, said.out) == (2, "")
    assert "there is no task called Chase" in said.err
