"""Examples of the rules beside their own: other ways to write what those show, and corners."""

from mindlang.explaining.collection import RULE, codes
from tests.lint.minds import BACK, CHOICES, COURSE, EYE, HALL, IDLE, NECK, PAID, READS, SENSORS, SKILL, WALLED_HALL

BEGIN = EYE + COURSE
GOOD = {
    "edge-at-zero": (f"{BACK}  influences Back at 0\n  chooses one\n",),
    "idle-influence": (f"{IDLE}  chooses one\n",),
    "deep-hierarchy": (CHOICES.replace("  influences", "  chooses one\n  influences", 1),),
    "single-way": (f"{NECK}  influences Look at 1\n",),
    "direction-as-number": (
        f"{SENSORS}{SKILL} north > 90% and north <= 1\n",
        f"{SENSORS}{SKILL} north > 1\n",
        f"{SENSORS}{SKILL} 2 * north > 1\n",
    ),
    "unused-memory": (
        """
memory tired is cell decay 0.99
skill Go is rule
  drives left_wheel at 1
  drives tired at 1
task Run in arena
  lasts 9 s
  ends when tired > 0.5
""",
    ),
    "walled-off": (WALLED_HALL.format(17.9, ""),),
    "zero-division": (f"{BEGIN}  rewards eye / 2 per tick\n",),
}
BAD = {
    "single-way": (f"{NECK}  influences Look at 1\n  chooses one\n",),
    "chance-meeting": (
        HALL.format(2).replace("  lasts", "  starts at 8 2\n  lasts") + "body Robot is box size 4 1\n",
        HALL.format(2).replace("size 40", "size 40 8") + "body Robot is box size 10 1\n",
    ),
    "constant-condition": (f"{READS}  drives left_wheel at 1 when eye > -1\n",),
    "direction-as-number": (
        f"{SENSORS}sensor calm is average of north over 5 ticks\nsensor behind is latch of calm below 20% above 80%\n",
        f"{SENSORS}{SKILL} 0.2 > north otherwise 0\n",
        f"{SENSORS}{SKILL} north <= 0.9\n",
        f"{SENSORS}{SKILL} 1 - north < 10%\n",
        f"{SENSORS}{SKILL} 2 * north - 1.8 > 0\n",
        f"{SENSORS}sensor turned is computed at north + 0.25\nsensor behind is latch of turned below 20% above 80%\n",
    ),
    "edge-at-zero": (f"{BACK}  influences Back at 1/2 - 0.5\n",),
    "paid-at-once": tuple(
        f"sensor moving is inertial\nsensor {sensor}\n" + PAID.replace("-10 0\n", f"-10 0\n  ends when {when}\n")
        for sensor, when in (
            ("pace is speed", "moving < 10%"),
            ("low is latch of charge below 70% above 80%", "low > 0.5"),
            ("mean is average of moving over 5 ticks", "mean < 10%"),
            ("rising is derivative of charge", "rising >= 0.5"),
            ("sum is computed at charge - moving", "sum > 0.5"),
            ("beat is clock period 2 s", "beat < 0.5"),
        )
    ),
    "value-out-of-range": (f"{READS}  drives left_wheel at-eye\n",),
    "walled-off": (
        WALLED_HALL.format("18.1", ""),
        """
task Cell in arena size 40
  contains goal is zone size 1 at 10 0
  contains left is wall from 9 -1 to 9 1
  contains right is wall from 11 -1 to 11 1
  contains top is wall from 9 1 to 11 1
  contains bottom is wall from 9 -1 to 11 -1
  lasts 9 s
  succeeds on reach of goal
""",
        """
task Pen in plain
  contains goal is zone size 2
  contains left is wall from -5 -5 to -5 5
  contains right is wall from 5 -5 to 5 5
  contains top is wall from -5 5 to 5 5
  contains bottom is wall from -5 -5 to 5 -5
  lasts 9 s
  succeeds on reach of goal
""",
        """
task Maze in arena size 20
  contains walls is map from "maze.txt"
  contains goal is zone size 2
  lasts 9 s
  succeeds on reach of goal
-- maze.txt --
..#..
..#..
..#g.
..#..
..#..
""",
    ),
    "zero-division": (f"{BEGIN}  rewards 1 / eye per tick when eye >= 0\n", f"{BEGIN}  ends when 1 / eye > 9\n"),
}


RULES = {code: article for code, article in codes().items() if article.noun == RULE}


def good_examples() -> list[tuple[str, str]]:
    """Every rule, by its code, with a mind that it has nothing to say of."""
    return [(code, text) for code, rule in RULES.items() for text in (*rule.right, *GOOD.get(code, ()))]


def bad_examples() -> list[tuple[str, str]]:
    """Every rule, by its code, with a mind that it has something to say of."""
    return [(code, text) for code, rule in RULES.items() for text in (*rule.wrong, *BAD.get(code, ()))]
