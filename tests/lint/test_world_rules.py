"""What the rules about worlds tell, word by word: what is in one place, walled off, or in the way."""

import pytest

from mindlang.lint.rules import lessons, walled_off, worlds
from tests.lint.examples import Tell, Told
from tests.lint.minds import SCHOOL


def task(*lines: str, scene: str = "arena size 40", name: str = "Hall") -> str:
    return f"task {name} in {scene}\n  lasts 9 s\n  counts reach of coin\n" + "".join(f"  {line}\n" for line in lines)


def twice(*lines: str) -> str:
    """A scene with two tasks."""
    scene = "scene Yard is arena size 40\n" + "".join(f"  {line}\n" for line in lines)
    return scene + task(scene="Yard") + task(scene="Yard", name="Other")


COIN = "contains coin is item size 2 at 13 0"
APART = "Write places that are farther apart, smaller sizes or a smaller jitter."
STEEL = "body Robot is box size 3 2\n"
ROBOT = "The robot starts in the border in some runs, as it happens to face."


@pytest.mark.parametrize(
    ("text", "found"),
    [
        (task("contains crate is box size 2 to 4 at 10 0", COIN), []),
        (
            task("contains crate is box size 2 to 4.1 at 10 0", COIN),
            [("coin", "coin is in crate when some runs begin.", APART, "crate")],
        ),
        (
            twice("contains crate is box size 2 to 6 at 10 0", COIN),
            [("coin", "coin is in crate when some runs begin.", APART, "crate")],
        ),
        (
            task("contains crate is box size 2 to 6 at 0 9 to 4 9", COIN),
            [("crate", "crate is in crate when some runs begin.", APART)],
        ),
        (
            task("contains crate is box size 2 to 6 at 3 0", COIN, "starts at 0 0"),
            [("crate", "The robot starts in crate in some runs.", worlds.START, "Hall")],
        ),
        (STEEL + task(COIN, "starts at 18.9 0"), [("Hall", ROBOT, worlds.START)]),
        (STEEL + task(COIN, "starts at 18.9 0 facing 90 deg"), []),
        (STEEL + task(COIN, "starts at 18 0"), []),
        (STEEL + task(COIN), []),
    ],
)  # fmt: skip
def test_what_is_in_one_place_in_some_runs(told: Tell, text: str, found: list[Told]) -> None:
    assert told("chance-meeting", text) == found


def test_a_line_of_a_scene_is_told_once(told: Tell) -> None:
    text = twice(
        "contains coin is item size 2 to 13 at 6 0", "starts at 0 0", "contains cat is walker along 3 5 to 13 5"
    )
    here = sorted(each[-1] for each in told("chance-meeting", text))
    assert here == ["Hall", "Other", "coin"], "of the robot it is told in each task"
    fence = "contains fence is wall from -20 3 to 20 3"
    assert len(told("walled-off", twice(fence, "starts at 0 0", "contains coin is item size 2 at 0 9"))) == 1
    assert len(told("wall-on-the-way", twice("contains cat is walker along 0 0 to 0 9", fence, COIN))) == 1


FENCE = "contains fence is wall from -20 0 to 20 0"
NO_WAY, OPEN = "No way leads from where the robot starts to coin.", walled_off.HINT


@pytest.mark.parametrize(
    ("lines", "found"),
    [
        ((FENCE, "contains coin is item size 1 at 0 3.9", "starts at 5 -5"), [("coin", NO_WAY, OPEN)]),
        ((FENCE, "contains coin is item size 1 at 0 1.4", "starts at 5 -5"), []),  # a claw reaches over the fence
        ((FENCE, "contains coin is zone size 4 at 0 3.9", "starts at 5 -5"), [("coin", NO_WAY, OPEN)]),
        ((FENCE, "contains coin is zone size 8 at 0 4.1", "starts at 5 -5"), [("coin", NO_WAY, OPEN)]),
        ((FENCE, "contains coin is zone size 12 at 0 4.1", "starts at 5 -5"), []),
        ((FENCE, "contains coin is item size 1 at 0 -9", "starts at 5 -5"), []),
        ((FENCE, "contains coin is item size 1 at 0 -9 to 0 9", "starts at 5 -5"), [("coin", NO_WAY, OPEN)]),
        ((FENCE, "contains coin is walker along 0 9 to 5 9", "starts at 5 -5"), []),
        (
            (FENCE, "contains coin is item size 1", "starts at 5 -5"),
            [(
                "Hall",
                "No way leads from where the robot starts to 50% of the floor of Hall, where something may be drawn.",
                OPEN,
            )],
        ),
        (
            (FENCE.replace(" 0 to 20 0", " 15 to 20 15"), "contains coin is item size 1 at 0 0"),
            [("Hall", "No way leads from the rest to 7% of the floor of Hall, where something may be drawn.", OPEN)],
        ),
        ((FENCE.replace(" 0 to 20 0", " 17.3 to 20 17.3"), "contains coin is item size 1 at 0 0"), []),
        ((FENCE.replace("to 20 0", "to 17.9 0"), "contains coin is item size 1"), []),
    ],
)  # fmt: skip
def test_where_no_way_leads(told: Tell, lines: tuple[str, ...], found: list[Told]) -> None:
    assert told("walled-off", task(*lines)) == found


def test_in_a_plain_there_is_a_way_around(told: Tell) -> None:
    assert told("walled-off", task(FENCE, "contains coin is item", "starts at 0 -5", scene="plain")) == []


@pytest.mark.parametrize(
    ("way", "is_told"),
    [
        ("0 -5 to 0 5", True), ("-12 0.9 to 12 0.9", True), ("-12 1.1 to 12 1.1", False),
        ("0 -5 to 15 -5 to 15 5", True), ("0 -5 to 15 -5 to 15 5 to 15 -5", False), ("0 -5 to 15 -5", False),
    ],
)  # fmt: skip
def test_ways_through_walls(told: Tell, way: str, is_told: bool) -> None:
    fence = "contains fence is wall from -10 0 to 10 0"
    said = ("cat", "The way of cat leads through fence.", "Name places around it.", "fence")
    cat = f"contains cat is walker size 1 along {way}"
    assert told("wall-on-the-way", task(COIN, fence, cat)) == [said] * is_told
    assert told("wall-on-the-way", task(COIN, fence, "contains cat is walker at 0 -5")) == []


LEAVE = lessons.HINT
LESSON = "teaches Go on Course for 20 generations"


@pytest.mark.parametrize(
    ("text", "found"),
    [
        (
            SCHOOL.format("genetic population 20 elite 100%", ""),
            [(LESSON, "An elite of 100% leaves 1 of 20 genomes to be bred anew.", LEAVE)],
        ),
        (
            SCHOOL.format("genetic", "").replace("20 gen", "1 gen"),
            [(
                LESSON.replace("20", "1"),
                "One generation is the first genomes alone, and nothing is bred from them.",
                lessons.MORE_HINT,
            )],
        ),
        (
            SCHOOL.format("evolution_strategy mutation 0.0001", "").replace("20 gen", "2 gen"),
            [(LESSON.replace("20", "2"), "Steps of 0.0001 leave every weight where it was, in 2 generations.", LEAVE)],
        ),
    ],
)  # fmt: skip
def test_lessons_of_which_nothing_comes(told: Tell, text: str, found: list[Told]) -> None:
    assert told("standing-learner", text) == found


STILL = """\
master Go
sensor eye is range_finder at 0 deg noise 1%
skill Go is rule
  drives left_wheel at 1
skill Look is mlp
  reads eye
  drives left_wheel
skill Sit is mlp
  reads mood
  drives left_wheel
memory mood is cell decay 0.9
"""
YARD = task(COIN, "starts at 0 0 facing 0 deg")
MOVED = task(COIN, name="Moved")


@pytest.mark.parametrize(
    ("lessons", "is_told"),
    [((), True), (("Look on Hall",), False), (("Look on Moved",), True), (("Sit on Hall",), True),
     (("Look on Hall", "Sit on Hall"), False)],
)  # fmt: skip
def test_a_task_draws_what_any_of_its_lessons_draws(told: Tell, lessons: tuple[str, ...], is_told: bool) -> None:
    school = "curriculum School is genetic\n" + "".join(f"  teaches {each} for 9 generations\n" for each in lessons)
    found = told("nothing-drawn", STILL + YARD + MOVED + (school if lessons else ""))
    assert [part for part, *_ in found] == ["Hall"] * is_told
