"""`mindc bench --credit`: what each skill, or what it learnt, is worth, from the same runs without that."""

import json
from pathlib import Path

from mindrun.graph.policy import Policy

import mindlang
from mindlang.compiler.compile import load
from mindlang.run.setup import run_timed, set_up
from tests.calling import RULES, Call

COLLECT = Path("examples/collect")


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


def test_beside_another_each_skill_has_its_weights_of_there(mindc: Call) -> None:
    mind, earlier = COLLECT / "all_on_the_job.mind", COLLECT / "scale_1/collect.mind"
    found = json.loads(mindc("bench", mind, earlier, "--task", "Collect", "--runs", 2, "--credit", "--json").out)
    skills = {each["skill"]: each["score_mean"] for each in found["skills"]}
    assert skills.keys() == {skill.name for skill in mindlang.load(mind).graph.skills} - {"Grab"}
    now, before = (set_up(str(file), load(file), "Collect", None) for file in (mind, earlier))
    for name, score in skills.items():
        weights = {**now.ready.policy.weights, name: before.ready.policy.weights[name]}
        mixed = now.with_policy(Policy(now.ready.policy.graph, weights))
        scores, *_ = run_timed(mixed.rollout(), mixed.layouts(1, 2))
        assert score == scores.total.mean()


def test_who_learnt_nothing_since_has_no_credit(mindc: Call) -> None:
    mind = COLLECT / "collect.mind"
    same = mindc("bench", mind, COLLECT / "monolith.mind", "--task", "Collect", "--credit")
    assert (same.code, same.out) == (2, "")
    assert "No skill of Collect in" in same.err
    twice = mindc("bench", mind, mind, "--credit")
    assert (twice.code, "Credit is given under one master." in twice.err) == (2, True)
