"""What the rules about numbers tell, and of which part of the text: divisions, directions, ticks that are too long."""

import pytest

from mindlang.lint.rules.values import HINT, MESSAGE
from tests.lint.examples import Tell
from tests.lint.minds import WHEELS

EYES = "sensor eye is range_finder at 0 deg\nsensor ear is range_finder at 90 deg\nsensor north is compass\n"
TASK = "task Course in {}\n  lasts 9 s\n  rewards forward per tick\n  {}\n"


def skill(line: str) -> str:
    """A skill that does so, and another with its weights, of which nothing is told again."""
    read, alike = "  reads eye\n  reads ear\n  reads north\n", "  reads ear for eye\n  reads eye for ear\n"
    sent = f"  drives right_wheel\n  drives left_wheel {line}\n"
    return f"{EYES}skill Go is mlp\n{read}{sent}skill Too is like Go\n{alike}"


def task(line: str, scene: str = "arena") -> str:
    return EYES + TASK.format(scene, line)


@pytest.mark.parametrize(
    ("text", "divisions"),
    [
        (skill("at 0.1 / eye"), ["0.1 / eye"]),
        (skill("at 1 / eye when eye > 0 otherwise 1 / (1 - eye)"), []),
        (skill("at 1 / eye when eye >= 0 otherwise 1 / eye"), ["1 / eye"]),  # the other is never sent
        (skill("at 1 when eye >= 0.1 otherwise 1 / (1 - eye)"), []),
        (skill("at 1 when eye < 0.5 otherwise 1 / (1 - eye)"), ["1 / (1 - eye)"]),
        (skill("at 1 when eye <= 0 otherwise 1 / eye"), []),
        (skill("at 1 when eye < 0.1 or ear < 0.1 otherwise 1 / eye"), ["1 / eye"]),
        (skill("at 1 when eye < 0.1 and ear < 0.1 otherwise 1 / eye"), ["1 / eye"]),
        (skill("at 1 when 1 / eye > 2 otherwise 1 / ear"), ["1 / ear", "1 / eye"]),
        (skill("at 1 when 2 < 1 / eye"), ["1 / eye"]),
        (skill("at 1 when ear > 10% and 2 < 1 / ear"), []),
        (skill("at 1 when ear > 10% or 2 < 1 / ear"), ["1 / ear"]),
        (skill("at 1 when 1 / ear > 2 and 1 / eye > 2"), ["1 / ear", "1 / eye"]),
        (task("rewards 1 / eye per tick when 0 < eye"), []),
        (task("rewards 1 / eye per tick when 0 <= eye"), ["1 / eye"]),
        (task("rewards 1 / (eye - 1) per tick when 1 > eye"), []),
        (task("rewards 1 / (eye - 1) per tick when eye <= 1"), ["1 / (eye - 1)"]),
        (task("rewards 1 / (eye - 0.5) per tick when eye > 0.5 and eye < 0.9"), []),
        (task("rewards 1 / (eye - 0.5) per tick when eye < 0.9 and eye > 0.5"), []),
        (task("rewards 1 / (eye - 0.5) per tick when eye > 0.5 or eye < 0.9"), ["1 / (eye - 0.5)"]),
        (task("rewards 1 / (eye - 0.15) per tick when eye > 0.1 and eye > 0.2"), []),
        (task("rewards 1 / (eye - 0.15) per tick when eye > 0.2 and eye > 0.1"), []),
        (task("rewards 1 / (eye - 0.85) per tick when eye < 0.8 and eye < 0.9"), []),
        (task("rewards 1 / (eye - 0.85) per tick when eye < 0.9 and eye < 0.8"), []),
        (task("rewards 1 / (eye - ear) per tick when eye > 0.5 and ear < 0.5"), []),
        (task("rewards 1 / eye per tick when eye < 0"), []),
        (task("rewards 1 / eye per tick when eye > 1 and eye < 0.5 or eye < 0.1"), ["1 / eye"]),
        (task("rewards 1 / eye per tick when eye > ear"), ["1 / eye"]),
        (task("rewards 1 / eye per tick when eye + ear > 1"), ["1 / eye"]),
        (task("rewards 1 / p per tick for each p in eye"), ["1 / p"]),
        (task("rewards 1 / p per tick for each p in eye", "plain"), []),
        (task("rewards 1 per tick for each p in eye when 1 / p > 2"), ["1 / p"]),
        (task("rewards 1 per tick for each p in eye when 1 / p > 2", "plain"), []),
        (task("rewards 1 / eye per tick", "plain"), []),  # it sees nothing, and reads 1
        (task("ends when 1 / eye > 9 and ear > 0.5"), ["1 / eye"]),
        (f"{EYES}sensor both is computed at eye / ear\n", ["eye / ear"]),
        (f"{EYES}sensor both is computed at eye / ear when ear > 0 otherwise 0.1 / eye\n", ["0.1 / eye"]),
        (f"{EYES}sensor both is computed at eye / (ear + 1)\n", []),
    ],
)
def test_divisions_by_what_can_be_0(told: Tell, text: str, divisions: list[str]) -> None:
    found = told("zero-division", text)
    assert sorted(part for part, *_ in found) == divisions
    assert {each[1:] for each in found} <= {(MESSAGE, HINT)}


RIGHT = "north is a direction, and this is behind on the right alone, not on the left."
LEFT = "north is a direction, and this is behind on the left alone, not on the right."


@pytest.mark.parametrize(
    ("condition", "message", "hint"),
    [
        ("north > 90%", RIGHT, "Add or north < 0.1, or, where one side is meant, and north <= 1."),
        ("north >= 75%", RIGHT, "Add or north <= 0.25, or, where one side is meant, and north <= 1."),
        ("north > 74%", "", ""),
        ("1 <= north", RIGHT, "Add or north <= 0, or, where one side is meant, and north <= 1."),
        ("north > 1", "", ""),
        ("north >= 2", "", ""),
        ("north < 25%", LEFT, "Add or north > 0.75, or, where one side is meant, and north >= 0."),
        ("north < 26%", "", ""),
        ("0 >= north", LEFT, "Add or north >= 1, or, where one side is meant, and north >= 0."),
        ("0 > north", "", ""),
        (
            "north > 90% and eye > 0.5 or eye < 0.1",
            RIGHT,
            "Add or north < 0.1, or, where one side is meant, and north <= 1.",
        ),
        ("north > 90% or north < 10%", "", ""),
        ("north > 90% and north < 95%", "", ""),
        ("eye > 90%", "", ""),
        ("north > eye", "", ""),
    ],
)
def test_what_is_behind_on_one_side(told: Tell, condition: str, message: str, hint: str) -> None:
    expected = [("north", message, hint)] if message else []
    assert told("direction-as-number", skill(f"at 1 when {condition}")) == expected
    assert told("direction-as-number", task(f"ends when {condition}")) == expected
    assert told("direction-as-number", task(f"rewards 1 per tick when {condition}")) == expected


def test_a_latch_of_a_direction(told: Tell) -> None:
    latch = "sensor behind is latch of north below 20% above 80%"
    assert told("direction-as-number", f"{EYES}{latch}\nsensor near is latch of eye below 20% above 80%\n") == [
        (
            "behind",
            "north is a direction: behind the robot it goes from 0 to 1, and behind flips there.",
            "Take how far it is off: computed at greatest of north (1 - north) is 0.5 ahead and 1 behind.",
        )
    ]


def test_a_tick_that_is_too_long(told: Tell) -> None:
    fast = WHEELS.format("1/60 s", 0.2, 80, 80)
    at, course = fast.index("task Room"), fast[fast.index("task Room") :]
    short = course.replace("task Room", "task Short").replace("9 s", "2 ticks")
    hint = "Give it at most 0.018 of its thrust, a shorter tick, more density or more linear_damping."
    moves = "At full thrust Robot moves 8.49 units in a tick of Room, 42 times its size."
    assert told("coarse-tick", fast) == told("coarse-tick", fast + short) == [("Robot", moves, hint)]
    assert told("coarse-tick", fast[:at]) == []
    [(_, moves, _)] = told("coarse-tick", fast[:at] + short)
    assert "in a tick of Short" in moves


WHEEL = " is wheel side {} neutral 0.5{}\n"
ROOM = "task Room in {}\n  lasts 9 s\n  rewards forward per tick\n"


def robot(size: str, left: str = "", right: str = "", scene: str = "plain") -> str:
    """A robot of a size whose wheels say so much, in a world."""
    wheels = f"actuator left{WHEEL.format('left', left)}actuator right{WHEEL.format('right', right)}"
    skill = "skill Go is rule\n  drives left at 1\n  drives right at 1\n"
    return f"tick 1/60 s\nbody Robot is disc size {size}\n{wheels}{skill}{ROOM.format(scene)}"


def test_a_thrust_that_nobody_says(told: Tell) -> None:
    with_80 = "units a second, {} times its length, with a thrust of 80 that nobody says."
    assert told("unsaid-thrust", robot("0.2")) == [
        ("left", f"At full thrust Robot goes 509 {with_80.format(2500)}", ADD.format("0.063")),
    ]
    assert told("unsaid-thrust", robot("12")) == [
        ("left", f"At full thrust Robot goes 0.141 {with_80.format('0.012')}", ADD.format("14000")),
    ]
    [(_, _, hint)] = told("unsaid-thrust", robot("60"))
    assert (
        hint == "No thrust is that large: write lengths in a larger unit, such as 0.2 in metres for 200 in millimetres."
    )
    for fine in (robot("0.2", " thrust 80"), robot("0.2", "", " thrust 80"), robot("1.3"), robot("4")):
        assert told("unsaid-thrust", fine) == []
    assert told("unsaid-thrust", robot("0.2") + "  varies thrust of left 60 to 90\n") == []
    assert told("unsaid-thrust", robot("0.2").split("task")[0]) == []


ADD = "Add thrust {} to left and right: 2 times its length a second."


@pytest.mark.parametrize(
    ("sensor", "scene", "most"),
    [
        ("position along y", "arena size 4 19", "9.5"),
        ("position along y", "arena size 4 20", ""),
        ("position along y range 50", "arena size 4", ""),
        ("position along y", "plain", ""),
        ("range_finder at 0 deg", "arena size 1.2 0.9", "1.5"),
        ("range_finder at 0 deg", "arena size 4", ""),
        ("odometer side left", "arena size 4", "0.4"),
        ("bumper at 0 deg", "arena size 1", ""),
    ],
)
def test_a_range_that_nobody_says(told: Tell, sensor: str, scene: str, most: str) -> None:
    mind = robot("0.2", " thrust 0.063", " thrust 0.063", scene) + f"sensor it is {sensor}\n"
    hints = [f"Add range {most}: it reads its whole 0 to 1 then."] if most else []
    assert [hint for _, _, hint in told("unsaid-range", mind)] == hints
    larger = f"{mind}task Hall in arena size 100\n  lasts 9 s\n  rewards forward per tick\n"
    assert "odometer" in sensor or told("unsaid-range", larger) == []
