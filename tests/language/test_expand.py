"""What stands for something else means what it stands for: numbers, scenes, likeness, rates."""

import re

import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from mindrun.graph.graph import Graph
from mindrun.numbers.quantity import DECAY, RATE

from mindlang.compiler.comparison import MindDifference, mind_differences
from mindlang.compiler.compile import Compiled
from mindlang.compiler.names import mentions
from tests.language.examples import compiled

PARTS = """\
tick 1/60 s
master Go
body Robot is disc size 2
actuator left is wheel side left neutral 0.5
sensor eye is range_finder at -90 0 90 deg range 12
sensor ball_bearing is bearing of ball
sensor battery is battery
skill Go is rule
  reads battery
  drives left at battery / 2
"""
TASK = """\
task A in arena size 60
  contains rock is obstacle grid 20 size 4 to 8 jitter 1
  contains ball is item size 2
  lasts 100 ticks
  ends on collision
  rewards 10 on reach of ball
  rewards 0.01 * forward per tick
  rewards -0.5 * forward per tick when battery < 0.2
  rewards 2 * p per tick for each p in eye when p < 1/4
  counts reach of ball
"""


def graph(text: str) -> Graph:
    found = compiled(text)
    assert found.graph, [diagnostic.message for diagnostic in found.diagnostics]
    return found.graph


def task(text: str, name: str) -> list[str]:
    """The facts of a task, as they stand somewhere."""
    mind = compiled(PARTS + text).mind
    assert mind, compiled(PARTS + text).diagnostics
    [found] = [task for task in mind.tasks if task.name == name]
    return [fact.span.text.strip() for fact in found.facts]


def codes(found: Compiled) -> list[tuple[str, int]]:
    return [(each.code, each.span.line if each.span else 0) for each in found.diagnostics]


@given(st.data())
@example(None)
def test_a_number_may_stand_wherever_a_quantity_may(data: st.DataObject | None) -> None:
    """Each number that begins an argument, an expression or a fact may have a name."""
    places = [*re.finditer(r"(?<=[a-z<*] )-?[0-9.]+(?:/[0-9.]+)?(?: deg| ticks)?(?= |$)", PARTS + TASK, re.MULTILINE)]
    places = [place for place in places if "tick " not in (PARTS + TASK)[place.start() - 5 : place.start()]]
    chosen = places if data is None else data.draw(st.lists(st.sampled_from(places), unique=True))
    text, numbers = PARTS + TASK, ""
    for index, place in sorted(enumerate(chosen), key=lambda each: -each[1].start()):
        before, amount = text[: place.start()], place[0]
        minus = amount.startswith("-")
        in_list = before.endswith("at ") and text[place.end()] == " " and text[place.end() + 1].isdigit()
        name = f"{'-' if minus else '+' if in_list else ''}n{index}"
        text, numbers = before + name + text[place.end() :], f"{numbers}number n{index} is {amount.lstrip('-')}\n"
    plain, named = graph(PARTS + TASK), graph(numbers + text)
    assert _without_texts(plain) == _without_texts(named)


def _without_texts(graph: Graph) -> str:
    return re.sub(r"text='[^']*'", "", repr(graph))


def test_a_world_in_a_scene_is_the_same_world() -> None:
    scene = "scene Rocks is arena size 60\n" + TASK.splitlines()[1] + "\n"
    lines = TASK.replace("arena size 60", "Rocks").splitlines()
    text = PARTS + scene + "\n".join([lines[0], *lines[2:]]) + "\n"
    assert graph(text) == graph(PARTS + TASK)
    old, new = compiled(PARTS + TASK).mind, compiled(text).mind
    assert old
    assert new
    assert mind_differences(old, new) == []
    wider = compiled(text.replace("size 4 to 8", "size 4 to 9")).mind
    assert wider
    assert [found.what for found in mind_differences(new, wider)] == ["task A"]


def test_a_task_like_another_says_what_that_says() -> None:
    assert graph(PARTS + TASK + "task B is like A\n").tasks[1] == graph(PARTS + TASK.replace("A in", "B in")).tasks[0]


@pytest.mark.parametrize(
    ("line", "instead_of"),
    [
        ("contains ball is item size 3 to 1 by 0.1", "contains ball is item size 2"),
        ("lasts 99 s", "lasts 100 ticks"),
        ("rewards -1 on reach of ball", "rewards 10 on reach of ball"),
        ("rewards forward per tick", "rewards 0.01 * forward per tick"),
        ("rewards 9 * forward * 2 per tick when battery   < 0.2", "rewards -0.5 * forward per tick when battery < 0.2"),
        ("rewards p per tick for each p in eye when p < 1/4", "rewards 2 * p per tick for each p in eye when p < 1/4"),
        ("counts reach of ball", "counts reach of ball"),
        ("ends on collision", "ends on collision"),
        ("rewards 1 on reach of ball when battery < 0.5", None),
        ("rewards battery * forward per tick", None),
        ("rewards -3 on collision", None),
        ("contains dock is power", None),
        ("counts collision", None),
        ("ends on reach of ball", None),
    ],
)
def test_a_line_of_the_same_replaces(line: str, instead_of: str | None) -> None:
    before = task(TASK, "A")
    after = task(f"{TASK}task B is like A\n  {line}\n", "B")
    line_ = line.strip()
    assert after == ([line_ if each == instead_of else each for each in before] if instead_of else [*before, line_])


def test_a_scene_below_scenes_replaces_where_the_thing_stands() -> None:
    text = (
        "scene One is arena\n  contains ball is item\n  contains b is zone\n"
        "scene Two is like One\n  contains ball is item size 2\n  contains c is power\n"
        "task T in Two\n  contains c is power size 9\n  lasts 9 s\n"
    )
    assert task(text, "T") == [
        "contains ball is item size 2", "contains b is zone", "contains c is power size 9", "lasts 9 s",
    ]  # fmt: skip


def test_what_is_said_twice_in_one_task_is_not_replaced() -> None:
    again = compiled(PARTS + TASK + "task B is like A\n  contains x is item\n  contains x is item\n")
    assert codes(again) == [("duplicate-thing", 23)]


def test_what_several_tasks_have_wrong_is_told_once() -> None:
    scene = "scene Rocks is arena\n  contains rock is obstacle\n  contains ball is item size 3 deg\n"
    tasks = "".join(f"task {name} in Rocks\n  lasts 9 s\n" for name in ("A", "B", "C"))
    assert codes(compiled(PARTS + scene + tasks)) == [("no-obstacles", 12), ("wrong-unit", 13)]


def test_a_scene_that_no_task_is_in_is_checked() -> None:
    assert ("wrong-unit", 21) in codes(compiled(PARTS + TASK + "scene S is arena size 4 deg\n"))


@pytest.mark.parametrize(("tick", "said", "per_tick"), [("1/60", 0.003, 0.00005), ("1/50", 0.05, 0.001)])
def test_a_rate_per_second_is_so_much_less_per_tick(tick: str, said: float, per_tick: float) -> None:
    text = PARTS.replace("1/60", tick).replace("is battery\n", f"is battery drain {said} per s\n")
    [battery] = [sensor.kind for sensor in graph(text).sensors if sensor.name == "battery"]
    assert battery.battery
    assert battery.battery.drain == pytest.approx(per_tick, rel=1e-12)
    assert graph(text.replace("per s", "per tick").replace(str(said), f"{per_tick:.6f}")).sensors


@given(st.floats(1e-6, 1.0), st.integers(1, 400))
def test_what_is_kept_each_tick_makes_what_is_kept_each_second(share: float, rate: int) -> None:
    assert DECAY.in_tick(share, 1 / rate) ** rate == pytest.approx(share, rel=1e-9)
    assert RATE.in_tick(share, 1 / rate) * rate == pytest.approx(share, rel=1e-12)


def test_another_number_is_one_difference() -> None:
    number, use = "number far is 12\n", PARTS.replace("range 12", "range far")
    old, new, bare = (compiled(text + TASK).mind for text in (number + use, "number far is 13\n" + use, PARTS))
    assert old
    assert new
    assert bare
    assert mind_differences(old, new) == [MindDifference("number far", ("number far is 12",), ("number far is 13",))]
    assert mind_differences(bare, old) == []


def test_a_lesson_names_the_number_that_stands_after_its_argument() -> None:
    text = PARTS.replace("rule", "mlp").replace("  drives left at battery / 2", "  drives left") + TASK
    lesson = "curriculum School is genetic\n  teaches Go on A for 10 generations population many\n"
    mind = compiled(f"{text}{lesson}number many is 30\n").mind
    assert mind
    found = [each for each in mentions(mind.files, mind.names) if each.noun == "number"]
    assert [(each.name.text, each.is_own) for each in found] == [("many", True), ("many", False)]
