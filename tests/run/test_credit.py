"""`mindc bench --credit`: what each skill is worth, from the same runs without it."""

import json
from pathlib import Path

from tests.calling import RULES, Call


def test_without_a_skill_runs_are_what_whatif_makes_of_them(mindc: Call, rules: Path) -> None:
    found = json.loads(mindc("bench", rules, "--task", "Roam", "--runs", 2, "--credit", "--json").out)
    assert len(found["skills"]) == 3
    for each in found["skills"]:
        once = ("whatif", rules, "--task", "Roam", "--without", each["skill"], "--json")
        scores = [json.loads(mindc(*once, "--seed", seed).out)["changed"]["score"] for seed in ("1/1", "1/2")]
        assert each["score_mean"] == sum(scores) / 2


def test_who_is_not_heard_is_worth_nothing_and_who_is_alone_all(mindc: Call, rules: Path) -> None:
    rules.write_text(RULES.replace("influences Turn at 0.2", "influences Turn at 0"), encoding="utf-8")
    found = json.loads(mindc("bench", rules, "--task", "Chase", "--runs", 6, "--credit", "--json").out)
    worth = {each["skill"]: each["credit"]["mean"] for each in found["skills"]}
    whole = found["by_event"]["reach of ball"]["mean"]
    assert whole > 0
    assert worth == {"Chase": whole, "Roam": whole, "Turn": 0}
