"""What `paid-at-once` tells, word by word: what is decided, or paid for nothing, in the first tick."""

import pytest

from tests.lint.examples import Tell, Told
from tests.lint.minds import PAID

COIN = "contains coin is item size 2 at 13 0"


def task(*lines: str) -> str:
    said = "task Hall in arena size 40\n  lasts 9 s\n  counts reach of coin\n"
    return said + "".join(f"  {line}\n" for line in lines)


EVERY = "This is paid in the first tick of every run, for nothing."
ELSEWHERE, FACES = "Write another place for {} or the robot.", " Or write which way the robot faces."
GOAL, PAYS = ELSEWHERE.format("goal"), "rewards 1 on reach of goal"
UNPAID = PAID.replace(f"  {PAYS}\n", "  counts reach of goal\n")
DRAWN = PAID.replace("  starts at -10 0\n", "")
OUTSIDE = "Write another place for coin, outside of where it is to come."
BOXES = (
    "contains home is zone size 6 to 8 at 5 5",
    "contains coin is box size 1 at 5 {}",
    "rewards 1 on delivery of coin",
)


def ending(line: str, start: str = "-10 0") -> str:
    return UNPAID.replace("starts at -10 0", f"starts at {start}") + f"  {line}\n"


def at_once(line: str, why: str) -> list[Told]:
    return [(line, f"This ends every run in its first tick: {why}.", "Compare otherwise.")]


@pytest.mark.parametrize(
    ("text", "found"),
    [
        (PAID, []),
        (PAID.replace("at -10 0\n", "at 9 0\n"), [(PAYS, EVERY, GOAL)]),
        (PAID.replace("at -10 0\n", "at 4 6\n"), [(PAYS, EVERY, GOAL)]),
        (PAID.replace("at -10 0\n", "at 3.9 0\n"), []),
        (
            PAID.replace("size 12", "size 12 to 14").replace("at -10 0\n", "at 3.9 0\n"),
            [(PAYS, EVERY.replace("every run", "some runs"), GOAL)],
        ),
        (
            ending("ends on reach of coin"),
            [("ends on reach of coin", "This ends some runs in the first tick.", ELSEWHERE.format("coin") + FACES)],
        ),
        (ending("ends on 2 reach of coin"), []),
        (
            ending("rewards 2 on reach of coin", "-10 0 facing 90 deg"),
            [("rewards 2 on reach of coin", EVERY, ELSEWHERE.format("coin") + FACES)],
        ),
        (ending("rewards 2 on reach of coin", "-10 0 facing -90 deg"), []),
        (ending("ends when charge < 70%"), at_once("ends when charge < 70%", "charge is always 0.6, always below 0.7")),
        (
            ending("succeeds when in_goal > 0.5", "9 0"),
            at_once("succeeds when in_goal > 0.5", "in_goal is always 1, always above 0.5"),
        ),
        (
            ending("succeeds when in_goal < 0.5"),
            at_once("succeeds when in_goal < 0.5", "in_goal is always 0, always below 0.5"),
        ),
        (UNPAID.replace("  starts at -10 0\n", "") + "  succeeds when in_goal < 0.5\n", []),
        (ending("succeeds when in_goal < 0.5").replace("zone size 12 at 10 0", "zone size 12"), []),
        (ending("succeeds when in_goal < 0.5", "3.9 0").replace("size 12", "size 12 to 14"), []),
        (
            "memory mood is cell decay 0.9 start 0.3\n" + ending("ends when mood < 0.5"),
            at_once("ends when mood < 0.5", "mood is always 0.3, always below 0.5"),
        ),
        ("memory mood is cell decay 0.9 start 0.6\n" + ending("ends when mood < 0.5"), []),
        (ending("ends when left_wheel < 0.7"), []),
        (
            DRAWN,  # 12 · 12 of 34 · 34
            [(PAYS, EVERY.replace("every run", "about 12% of the runs"), GOAL)],
        ),
        (
            DRAWN.replace("arena size 40", "arena size 40 30").replace("size 12 at 10 0", "size 9 at 10 0 to -10 0"),
            [(PAYS, EVERY.replace("every run", "about 20% of the runs"), GOAL)],
        ),
        (DRAWN.replace("size 12", "size 3.5"), [(PAYS, EVERY.replace("every run", "about 1% of the runs"), GOAL)]),
        (DRAWN.replace("size 12", "size 3.3"), []),
        (DRAWN.replace("rewards 1 on", "succeeds on"), []),
        (DRAWN.replace("size 12 at 10 0", "size 12"), []),
        (
            DRAWN.replace("rewards 1 on reach of goal", "rewards 1 on reach of coin").replace("size 1 at", "size 9 at"),
            # π / 2 · 6² of 34 · 34: a claw reaches 1.5, and the item is 4.5 around its middle
            [
                (
                    "rewards 1 on reach of coin",
                    EVERY.replace("every run", "about 5% of the runs"),
                    ELSEWHERE.format("coin") + FACES,
                )
            ],
        ),
        (
            task(BOXES[0], BOXES[1].format(6), BOXES[2]),
            [(BOXES[2], EVERY, OUTSIDE)],
        ),
        (
            task(BOXES[0], BOXES[1].format(8.5), BOXES[2]),
            [
                (
                    BOXES[2],
                    EVERY.replace("every run", "some runs"),
                    OUTSIDE,
                )
            ],
        ),
        (task(BOXES[0], BOXES[1].format(9.5), BOXES[2]), []),
        (task(BOXES[0], BOXES[1].format(8), f"{BOXES[2]} to home"), [(f"{BOXES[2]} to home", EVERY, OUTSIDE)]),
        (
            task(BOXES[0], BOXES[1].format(6), f"{BOXES[2]} to away", "contains away is zone size 6 at -5 -5"),
            [],
        ),
        ("sensor charge is battery start 1%\n" + task(COIN, "rewards 1 on exhaustion"), []),
        (
            "sensor charge is battery start 0%\n" + task(COIN, "rewards 1 on exhaustion"),
            [("rewards 1 on exhaustion", EVERY, "Let the battery start above 0.")],
        ),
        (
            "sensor charge is battery start 0%\n"
            + task(COIN, "contains plug is power size 4 at 5 5", "starts at 5 5", "rewards 1 on exhaustion"),
            [],
        ),
    ],
)
def test_what_comes_in_the_first_tick(told: Tell, text: str, found: list[Told]) -> None:
    assert told("paid-at-once", text) == found


@pytest.mark.parametrize(
    ("place", "start", "often"),
    [
        ("-7 0", "-10 0 facing 0 deg", "every run"),  # a claw's place is 1 ahead, and it reaches 1.5
        ("-6.99 0", "-10 0 facing 0 deg", ""),
        ("-9 1.6", "-10 0 facing 0 deg", "every run"),
        ("-9.01 1.6", "-10 0 facing 0 deg", ""),
        ("-13 0", "-10 0 facing 180 deg", "every run"),
        ("-10 -2", "-10 0 facing -90 deg", "every run"),
        ("-11.9 1.5", "-10 0 facing 90 deg", "every run"),
        ("-12.1 1.5", "-10 0 facing 90 deg", ""),
        ("-10 3", "-10 0", "some runs"),
        ("-10 3.01", "-10 0", ""),
    ],
)
def test_what_is_in_a_claws_reach(told: Tell, place: str, start: str, often: str) -> None:
    text = ending("rewards 2 on reach of coin", start).replace("size 1 at -10 2", f"size 1 at {place}")
    messages = [message for _, message, *_ in told("paid-at-once", text)]
    assert messages == [EVERY.replace("every run", often)] * bool(often)
