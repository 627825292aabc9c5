"""An answer for reading, of the data that it is made from: every sentence, and when it is said."""

from typing import Any

import numpy as np
import pytest
from rich.console import Group
from rich.text import Text

from mindlang.attribution.answer import answer_text, mean_direction
from mindlang.attribution.shares import MAX_COUNTED_PATHS

CHASE = {"share": 0.6676, "part": 5 / 6, "value": 0.8011, "influence": 1.0, "path": ["Roam", "Chase", "left_wheel"]}
FOUND: dict[str, Any] = {
    "task": "Chase",
    "master": "Roam",
    "seed": 3,
    "seconds_per_tick": 0.02,
    "ticks": [1000, 1000],
    "of": "left_wheel",
    "kind": "actuator",
    "paths": [CHASE | {"reads": {"ball_bearing": [0.5], "feeler": [0.1234, None, 1.0]}}],
    "rest": {"paths": 0, "part": 0.0, "share": 0.0},
    "are_largest": True,
    "undriven": 0,
    "neutral": 0.0,
    "rounding": 1e-6,
    "command": 0.8176,
    "influence": 1.2,
    "silent": [],
    "acted": 0.8176005,
    "stopped": 0,
}
SEVERAL = {"ticks": [1000, 2199]}
RECORDED = {"recording": "day.rec", "acted": 0.5}
REST = {"part": 0.25, "share": 0.15}
SKILLS = [f"Skill{number:02}" for number in range(9)]
TOTAL = "   0.8176  command to left_wheel; influence 1.2 in all"
MEAN = "   0.8176  command to left_wheel, in the mean; influence 1.2 in all"
SENT = "   0.8176  command to left_wheel, in the mean where it was sent one; influence 1.2 in all"
ANSWER = f"""\
left_wheel in tick 1,000 (20.00 s)
Chase with Roam in charge, seed 3

    share   of influence  command  path
   0.6676   83.3% ████     0.8011  Roam → Chase
           read ball_bearing 0.5, feeler 0.123 no number 1
{TOTAL}"""
INFLUENCE = """\
influence   of influence     sent  path
   0.6676   83.3% ████     0.8011  Roam
  -0.0000  rounding of the engine's sums
   0.8176  influence on Chase
nothing influenced it"""
PAID = """\
    20.000000  twice
-1,234.500000  once
 not a number  never
-1,214.500000  paid in all

happened: 2 × reach of ball, 1 × collision"""


def parts(**changed: Any) -> list[Text]:
    """The parts of an answer in which some of what was found is otherwise."""
    group = answer_text(FOUND | changed)
    assert isinstance(group, Group)
    return [part if isinstance(part, Text) else Text(str(part)) for part in group.renderables]


def lines(**changed: Any) -> list[str]:
    return "\n".join(map(str, parts(**changed))).splitlines()


@pytest.mark.parametrize(
    ("turns", "mean"),
    [
        ([0.98, 0.02], 0.0),
        ([0.95, 0.99, 0.01, 0.05], 0.0),
        ([0.2, 0.4], 0.3),
        ([0.75, 0.85], 0.8),
        ([0.25, 0.75], None),
    ],
)
def test_directions_have_their_mean_on_the_circle(turns: list[float], mean: float | None) -> None:
    found = mean_direction(np.array(turns))
    assert np.isnan(found) if mean is None else abs((found - mean + 0.5) % 1 - 0.5) < 1e-9


def test_what_an_answer_looks_like() -> None:
    assert lines() == ANSWER.splitlines()
    assert lines(**SEVERAL)[0] == "left_wheel in ticks 1,000 to 2,199 (20.00 to 43.98 s)"
    assert lines(recording="day.rec")[1] == "day.rec, Roam in charge"
    asked = {"of": "Chase", "paths": [CHASE | {"path": ["Roam"], "reads": {}}], "rounding": -2e-6, "undriven": 1}
    assert lines(**asked, kind="skill")[3:] == INFLUENCE.splitlines()


def test_what_rewards_look_like() -> None:
    paid = {"kind": "reward", "of": "reward", "by_line": {"twice": 20.0, "once": -1234.5, "never": None}}
    said = parts(**paid, score=-1214.5, by_event={"reach of ball": 2, "collision": 1})
    assert "\n".join(map(str, said[2:])) == PAID
    assert [part.style for part in said[2:]] == ["", "", "", "bold", "dim"]
    assert lines(**paid, score=-1214.5, by_event={}) == "\n".join(map(str, said)).splitlines()[:-2]


@pytest.mark.parametrize(
    ("changed", "below"),
    [
        (SEVERAL, [MEAN]),
        ({"rest": {"paths": 1, **REST}}, ["   0.1500   25.0% over 1 path more", TOTAL]),
        (
            {"rest": {"paths": 1200, **REST}, "are_largest": False},
            ["   0.1500   25.0% over 1,200 paths more, of which some may be larger", TOTAL],
        ),
        ({"rest": {"paths": MAX_COUNTED_PATHS, **REST}}, ["   0.1500   25.0% over 10^15 paths or more", TOTAL]),
        ({"undriven": 1, "neutral": 0.5}, ["   0.5000  nothing influenced it: its neutral", TOTAL]),
        (
            {"undriven": 1100, "neutral": 0.5, **SEVERAL},
            ["   0.5000  nothing influenced it in 1,100 of 1,200 ticks: its neutral", MEAN],
        ),
        ({"rounding": 1.01e-6}, ["   0.0000  rounding of the engine's sums", TOTAL]),
        ({"kind": "memory", "undriven": 1, "command": None}, ["        –" + TOTAL[9:], "nothing drove it"]),
        ({"kind": "memory", "undriven": 1100, **SEVERAL}, [SENT, "nothing drove it in 1,100 of 1,200 ticks"]),
        ({"silent": SKILLS[:5]}, [TOTAL, "sent it nothing: Skill00, Skill01, Skill02, Skill03 and Skill04"]),
        ({"silent": SKILLS[:6]}, [TOTAL, "sent it nothing: Skill00, Skill01, Skill02, Skill03 and 2 more"]),
        ({"acted": 0.8175}, [TOTAL, "what reached it then is 0.8175: its commands act later"]),
        ({"acted": 0.5, **SEVERAL}, [MEAN, "what reached it then is 0.5000, in the mean: its commands act later"]),
        ({"acted": 1e-6, "command": 0.0}, ["   0.0000" + TOTAL[9:]]),
        (RECORDED, [TOTAL, "what was sent to the guardian is 0.5000"]),
        (RECORDED | {"stopped": 1}, [TOTAL, "what was sent to the guardian is 0.5000: the robot was stopped"]),
        (
            RECORDED | SEVERAL | {"stopped": 1100},
            [
                MEAN,
                "what was sent to the guardian is 0.5000, in the mean: the robot was stopped in 1,100 of 1,200 ticks",
            ],
        ),
    ],
)
def test_what_stands_below_the_paths(changed: dict[str, Any], below: list[str]) -> None:
    assert lines(**changed)[6:] == below


@pytest.mark.parametrize(
    ("skills", "path"),
    [
        ([*SKILLS[:4], "Sk004"], "Skill00 → Skill01 → Skill02 → Skill03 → Sk004"),
        ([*SKILLS[:4], "Ski004"], "Skill00 → 1 more → Skill02 → Skill03 → Ski004"),
        (SKILLS, "Skill00 → 6 more → Skill07 → Skill08"),
        (["A" * 40, "B" * 40, "C" * 40], f"{'A' * 40} → 1 more → {'C' * 40}"),
        (["A" * 40, "B" * 40], f"{'A' * 40} → {'B' * 40}"),
    ],
)
def test_of_a_path_that_is_too_long_both_ends_are_named(skills: list[str], path: str) -> None:
    found = [CHASE | {"path": [*skills, "left_wheel"], "reads": {}}]
    assert lines(paths=found)[4:] == [f"   0.6676   83.3% ████     0.8011  {path}", TOTAL]


def test_of_what_was_read_a_line_is_named() -> None:
    long = "a" * 60  # with which the line has 80 characters
    reads = [{"five": [0.0] * 5}, {"six": [0.0] * 6}, {long: [0.5]}, {f"{long}a": [0.5]}]
    assert lines(paths=[CHASE | {"reads": each} for each in reads])[5:-1:2] == [
        "           read five 0 0 0 0 0",
        "           read six 0 0 0 0 0 …",
        f"           read {long} 0.5",
        f"           read {long}a 0…",
    ]
