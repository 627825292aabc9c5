"""What `mindc whatif` says, of the data that it is made from: where two courses differ first, and what came of them."""

from typing import Any, cast

import numpy as np
from rich.console import Group, RenderableType

from mindlang.run.recorded_run import RecordedRun, RunResult
from mindlang.whatif.comparison import (
    Compared,
    OpenLoop,
    TickDifference,
    comparison_summary,
    differences_text,
    first_differences,
    recording_data,
    recording_summary,
)
from mindlang.whatif.request import Request

WAS: dict[str, Any] = {
    "task": "Roam",
    "master": "Go",
    "seed": 3,
    "ticks": 1200,
    "ended_by": None,
    "by_event": {"reach of ball": 2, "collision": 0},
    "faults": 0,
    "by_line": {"rewards 10 on reach of ball": 20.0, "rewards speed": None},
    "score": None,
}
NOW = WAS | {
    "ticks": 81,
    "ended_by": "2 reach of ball",
    "succeeded": True,
    "by_event": {"visit of patch": 12},
    "faults": 1234,
    "by_line": {"rewards -5 on collision": -5.0},
    "score": -5.0,
}
RUNS = """\
Roam with Go in charge, seed 3
without Avoid, from tick 20 on

   tick 20  influence of Avoid 1 → 0
tick 1,200  score 20 → nan

                                as it was          changed
ticks                               1,200               81
ended by                             time  2 reach of ball
success                                no              yes
reach of ball                           2                –
collision                               0                –
visit of patch                          –               12
faults                                  0            1,234
rewards 10 on reach of ball         20.00                –
rewards speed                not a number                –
rewards -5 on collision                 –            -5.00
score                        not a number            -5.00"""
SWAPPED = """\
                                   as it was       changed
ticks                                     81         1,200
ended by                     2 reach of ball          time
success                                  yes            no
visit of patch                            12             –
reach of ball                              –             2
collision                                  –             0
faults                                 1,234             0
rewards -5 on collision                -5.00             –
rewards 10 on reach of ball                –         20.00
rewards speed                              –  not a number
score                                  -5.00  not a number"""
RECORDING = """\
day.rec with Go in charge, 1,200 ticks
without Avoid, from tick 20 on
open loop: the readings are those of the recording, whatever other commands would have led to

nothing differs, to the bit

command      differs in ticks   mean  most  in tick
left_wheel              1,100  0.123     1    1,200
right_wheel                 0      0     0        –"""


def text(said: RenderableType) -> str:
    assert isinstance(said, Group)
    return "\n".join(map(str, said.renderables))


def test_two_runs() -> None:
    found = [TickDifference(20, "influence", "Avoid", 1.0, 0.0), TickDifference(1200, "reward", "score", 20.0, np.nan)]
    was, now = (RunResult(cast(RecordedRun, None), each) for each in (WAS, NOW))
    request = Request(20, without=("Avoid",))
    assert text(comparison_summary(request, Compared(was, now, found))) == RUNS
    assert text(comparison_summary(request, Compared(now, was, []))).endswith(
        f"nothing differs, to the bit\n\n{SWAPPED}"
    )


def test_a_recording() -> None:
    sent = {
        "left_wheel": {"ticks": 1100, "mean": 0.123, "most": 1.0, "most_tick": 1200},
        "right_wheel": {"ticks": 0, "mean": 0.0, "most": 0.0, "most_tick": None},
    }
    request, found = Request(20, without=("Avoid",)), OpenLoop("Go", 1200, [], sent)
    assert text(recording_summary(request, "day.rec", found)) == RECORDING
    commands = recording_data(request, found)["commands"]
    assert [each["most_tick"] for each in commands.values()] == [1200, None]


def test_so_many_of_a_kind_are_named() -> None:
    def said(count: int) -> str:
        return str(differences_text([TickDifference(7, "reading", f"eye {i}", i, 1 / 3) for i in range(count)]))

    six = "tick 7  read " + ", ".join(f"eye {i} {i} → 0.333333" for i in range(6))
    assert (said(6), said(7), said(9)) == (six, f"{six} and 1 more", f"{six} and 3 more")


def test_a_number_that_is_not_finite_is_none_in_data() -> None:
    assert TickDifference(3, "reading", "eye", np.inf, 0.5).as_data() == {
        "tick": 3,
        "what": "reading",
        "name": "eye",
        "was": None,
        "now": 0.5,
    }


def test_differences_stand_in_the_order_of_time_and_of_causes() -> None:
    a = {"reading": {"x": np.array([0.0, np.nan, 1.0])}, "command": {"w": np.zeros(3), "v": np.zeros(3)}}
    b = {"reading": {"x": np.array([0.0, np.nan, 2.0])}, "command": {"w": np.array([0.0, 1.0, 1.0]), "v": np.zeros(2)}}
    assert first_differences(a, b) == [
        TickDifference(2, "command", "w", 0.0, 1.0),
        TickDifference(3, "reading", "x", 1.0, 2.0),
    ]
    b["command"]["v"] = b["command"]["w"] = np.array([0.0, 0.0, 1.0])
    assert [each.name for each in first_differences(a, b)] == ["x", "w", "v"]


def test_what_is_asked_is_said_as_it_is() -> None:
    assert Request(1, None, ("Avoid",)).words == "without Avoid, from the first tick on"
    assert Request(1000, 5, (), ("eyes=1",)).words == "eyes=1, in ticks 1,000 to 1,004"
    assert Request(7, None, (), (), ("mood=1",)).words == "mood=1, in tick 7"
    assert Request(7, None, ("A",), (), ("mood=1",)).words == "without A, from tick 7 on; mood=1, in tick 7"
    assert Request(7, 2, ("A",), (), ("mood=1",)).words == "without A and mood=1, in ticks 7 to 8"
    assert Request(1, None, ("A", "B"), ("c=1",)).words == "without A, without B and c=1, from the first tick on"
