"""`mindc why`: who made a command, an influence or a reward, of a run in the simulator."""

import json
from collections import Counter
from math import fsum
from pathlib import Path
from typing import Any

import pytest

from tests.calling import Call

ASKED = ("--task", "Chase", "--seed", 3)
LEFT_WHEEL = """left_wheel in tick 100 (1.67 s)
Chase with Roam in charge, seed 3

    share   of influence  command  path
   0.6676   83.3% ████     0.8011  Roam → Chase
           read ball_bearing 0.5
   0.1500   16.7% █        0.9000  Roam → Turn
   0.8176  command to left_wheel; influence 1.2 in all
"""


def found(mindc: Call, *words: object) -> dict[str, Any]:
    said = mindc("why", *words, "--json")
    assert said.code == 0, said.err
    data: dict[str, Any] = json.loads(said.out)
    return data


def test_a_command_and_who_made_it(mindc: Call, rules: Path) -> None:
    said = mindc("why", rules, *ASKED, "--tick", 100, "left_wheel")
    assert (said.code, said.out, said.err) == (0, LEFT_WHEEL, "")


def test_shares_add_up_to_the_command_of_the_run(mindc: Call, rules: Path, tmp_path: Path) -> None:
    trace = tmp_path / "run.csv"
    assert mindc("run", rules, *ASKED, "--trace", trace).code == 0
    names, *rows = (line.split(",") for line in trace.read_text().splitlines())
    column = next(place for place, name in enumerate(names) if name.endswith("left_wheel"))
    for first, last in ((1, 1), (100, 100), (40, 60)):
        data = found(mindc, rules, *ASKED, "--tick", f"{first}..{last}", "left_wheel")
        commands = [float(row[column]) for row in rows if first <= int(row[0]) <= last]
        made = [*(each["share"] for each in data["paths"]), data["rest"]["share"], data["neutral"], data["rounding"]]
        assert fsum(made) == pytest.approx(data["command"], rel=1e-12)
        assert data["command"] == data["acted"] == pytest.approx(fsum(commands) / len(commands), rel=1e-6)
        assert data["ticks"] == [first, last]


def test_who_influenced_a_skill(mindc: Call, rules: Path) -> None:
    data = found(mindc, rules, *ASKED, "--tick", 7, "Turn")
    assert [(each["path"], each["share"], each["part"]) for each in data["paths"]] == [
        (["Roam", "Turn"], pytest.approx(0.2), 1.0)
    ]
    assert (data["kind"], data["command"]) == ("skill", data["paths"][0]["share"])
    said = mindc("why", rules, *ASKED, "--tick", "7..9", "Turn")
    assert said.out.splitlines()[0] == "Turn in ticks 7 to 9 (0.12 to 0.15 s)"
    assert said.out.splitlines()[-1] == "   0.2000  influence on Turn, in the mean"
    assert found(mindc, rules, *ASKED, "Roam")["paths"][0]["path"] == ["Roam"]


def test_paths_that_are_not_named_are_the_rest(mindc: Call, rules: Path) -> None:
    said = mindc("why", rules, *ASKED, "--tick", 100, "left_wheel", "--paths", 1)
    assert "   0.1500   16.7% over 1 path more\n" in said.out
    assert "Turn" not in said.out
    turns = "skill Turn{} is rule\n  drives left_wheel at 0.9\n\n"
    text = rules.read_text().replace("skill Roam", "".join(map(turns.format, range(9))) + "skill Roam")
    rules.write_text(text.replace("at 0.2\n", "at 0.2\n" + "".join(f"  influences Turn{i} at 0.1\n" for i in range(9))))
    data = found(mindc, rules, *ASKED, "--tick", 100, "left_wheel")
    assert (len(data["paths"]), data["rest"]["paths"]) == (10, 1)


def test_what_takes_too_long_for_one_answer_is_refused(
    mindc: Call, rules: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("mindlang.attribution.answer.MAX_EDGE_TICKS", 65)  # of six edges
    assert mindc("why", rules, *ASKED, "--tick", "41..50", "left_wheel").code == 0
    message = "11 ticks of 6 edges are too much for one answer\n  Ask for 10 ticks at most: --tick 41..50\n"
    assert mindc("why", rules, *ASKED, "--tick", "41..51", "left_wheel") == (2, "", message)


def test_what_each_reward_line_paid_adds_up_to_the_score(mindc: Call, rules: Path) -> None:
    outcome = json.loads(mindc("run", rules, *ASKED, "--json").out)
    whole = found(mindc, rules, *ASKED, "reward")
    assert whole["score"] == pytest.approx(outcome["score"], rel=1e-12)
    assert whole["by_line"] == pytest.approx(outcome["by_line"], rel=1e-12)
    assert whole["by_event"] == {text: times for text, times in outcome["by_event"].items() if times}
    spans = ("1", "2", "3..700", "701..1200")
    parts = [found(mindc, rules, *ASKED, "--tick", span, "reward") for span in spans]
    assert fsum(part["score"] for part in parts) == pytest.approx(whole["score"], rel=1e-9)
    assert sum((Counter(part["by_event"]) for part in parts), Counter()) == whole["by_event"]
    assert (parts[0]["by_event"], parts[0]["ticks"], parts[3]["ticks"]) == ({}, [1, 1], [701, 1200])
    said = mindc("why", rules, *ASKED, "reward")
    assert said.out.splitlines()[-1].startswith("happened: ")


def test_a_delayed_command_is_what_the_mind_said_and_so_is_what_acts(mindc: Call, rules: Path) -> None:
    text = rules.read_text()
    rules.write_text(text.replace("wheel side left neutral 0.5", "wheel side left neutral 0.5 delay 2 ticks"))
    first, third = (found(mindc, rules, *ASKED, "--tick", tick, "left_wheel") for tick in (1, 3))
    assert first["acted"] == 0.5 != first["command"]
    assert third["acted"] == first["command"]
    said = mindc("why", rules, *ASKED, "--tick", 1, "left_wheel")
    assert said.out.splitlines()[-1] == "what reached it then is 0.5000: its commands act later"


def test_nothing_influences_what_is_sent_its_neutral(mindc: Call, rules: Path) -> None:
    rules.write_text(rules.read_text().replace("Chase at 1", "Chase at 0").replace("Turn at 0.2", "Turn at 0"))
    data = found(mindc, rules, *ASKED, "--tick", "5..8", "left_wheel")
    assert (data["command"], data["neutral"], data["undriven"], data["paths"]) == (0.5, 0.5, 4, [])
    assert data["silent"] == ["Chase", "Turn"]
    said = mindc("why", rules, *ASKED, "--tick", 5, "left_wheel")
    assert "   0.5000  nothing influenced it: its neutral\n" in said.out
    assert said.out.endswith("sent it nothing: Chase and Turn\n")


@pytest.mark.parametrize(
    ("words", "message", "hint"),
    [
        (["left_whel"], "there is no actuator, memory or skill called left_whel", "Did you mean left_wheel?"),
        (["reward", "--paths", 3], "a reward comes along no paths", "Leave --paths out: all of its lines are said."),
        (
            ["left_wheel", "--tick", 1300],
            "there is no tick 1,300: it was over after 1,200 ticks",
            "Say one from 1 to 1200.",
        ),
        (
            ["Turn", "--master", "Chase"],
            "Turn is not below Chase, which is in charge",
            "It is below another: --master Roam",
        ),
        (
            ["Roam", "--master", "Chase"],
            "Roam is not below Chase, which is in charge",
            "Nothing is above it: --master Roam",
        ),
        (
            ["nothing"],
            "there is no actuator, memory or skill called nothing",
            "There is left_wheel, right_wheel and reward.",
        ),
        (["left_wheel", "--task", "Chas"], "there is no task called Chas", "Did you mean Chase?"),
    ],
)
def test_a_question_without_an_answer(mindc: Call, rules: Path, words: list[object], message: str, hint: str) -> None:
    assert mindc("why", rules, *words) == (2, "", f"{message}\n  {hint}\n")


@pytest.mark.parametrize("ticks", ["0", "9..3", "1..", "x", "..", "-1", "1..2..3", "9" * 50, "٣"])
def test_ticks_are_whole_and_from_one_on(mindc: Call, rules: Path, ticks: str) -> None:
    said = mindc("why", rules, "left_wheel", f"--tick={ticks}")
    assert (said.code, said.out) == (2, "")
    assert "is no tick from 1 on, and no span of ticks: 812 or 800..812." in said.err


@pytest.mark.parametrize("words", [["rules.mind"], ["a.mind", "b", "c", "d"], ["day.rec", "left_wheel"]])
def test_a_file_and_what_is_asked_about(mindc: Call, words: list[str]) -> None:
    said = mindc("why", *words)
    assert (said.code, said.out) == (2, "")
    assert "Say a file and what is asked about" in said.err


def test_a_mind_that_is_not_taught(mindc: Call, drive: Path) -> None:
    said = mindc("why", drive, "left_wheel")
    assert (said.code, said.out) == (1, "")
    assert "mindc train" in said.err
