"""What the parts of the language mean once compiled: units, lists, ranges, memories, overrides."""

from math import pi

import pytest
from mindrun.graph.graph import Graph
from mindrun.kinds.learners import EvolutionStrategy, Genetic, Restarting
from mindrun.kinds.registry import arguments, kinds
from mindrun.kinds.sensors.rays import RangeFinder
from mindrun.kinds.things.obstacle import Obstacle
from mindrun.numbers.quantity import Span

from mindlang.compiler.compile import load
from tests.language.examples import TOUR, changed, codes, compiled


@pytest.fixture(scope="module")
def tour() -> Graph:
    graph = load(TOUR).graph
    assert graph is not None
    return graph


def test_a_list_shares_the_unit_of_its_last_number(tour: Graph) -> None:
    assert tour.sensors[0].kind == RangeFinder((-pi / 2, -pi / 4, 0.0, pi / 4, pi / 2), 12.0, 0.01)


@pytest.mark.parametrize(("written", "value"), [("20%", 0.2), ("7%", 0.07), ("1/4", 0.25), ("1", 1.0), ("0.2", 0.2)])
def test_a_share_is_written_as_a_number_or_in_percent(written: str, value: float) -> None:
    graph = changed(("decay 0.9", f"decay {written}")).graph
    assert graph is not None
    assert graph.memories[0].kind.decay == value


def test_a_task_lasts_ticks_or_seconds() -> None:
    graph = changed(("1000 ticks", "2.5 s")).graph
    assert graph is not None
    assert graph.tasks[0].ticks == 150


def test_a_memory_reads_after_the_sensors_and_is_driven(tour: Graph) -> None:
    assert tour.memories[0].start == tour.width - 1
    live = next(skill for skill in tour.skills if skill.name == "Live")
    assert [(edge.to, edge.target) for edge in live.edges if edge.to == "memory"] == [("memory", 0)]


def test_a_skill_may_drive_and_influence_at_once(tour: Graph) -> None:
    work = next(skill for skill in tour.skills if skill.name == "Work")
    assert [(edge.to, edge.output) for edge in work.edges] == [
        *(("skill", 0), ("skill", 1), ("skill", None), ("skill", None), ("actuator", 2)),
    ]


def test_the_derivative_of_a_wide_sensor_is_as_wide() -> None:
    graph = changed(("sensor eyes", "sensor drift is derivative of eyes\nsensor eyes")).graph
    assert graph is not None
    assert [(sensor.name, sensor.start, sensor.width) for sensor in graph.sensors[:2]] == [
        ("drift", 0, 2),
        ("eyes", 2, 2),
    ]


def test_a_lesson_overrides_its_curriculum(tour: Graph) -> None:
    learners = [lesson.learner for lesson in tour.lessons]
    assert learners[0] == Genetic(40, 2, 3, 0.1, 0.5, 0.2)
    assert learners[1] == Genetic(60, 2, 3, 0.1, 0.5, 0.2)
    assert learners[2].mutation == 0.3
    assert [lesson.from_scratch for lesson in tour.lessons] == [False, False, False, True, False, False, False]
    assert [lesson.with_subskills for lesson in tour.lessons] == [False, False, False, False, False, True, True]
    assert learners[4] == Restarting(attempts=3, octaves=1, patience=30)
    assert learners[6] == EvolutionStrategy(mutation=0.3)


def test_minus_binds_tighter_than_times_and_the_left_comes_first() -> None:
    graph = changed(("1 - holding", "1 - 2 / 4 / -holding + 3")).graph
    assert graph is not None
    go = graph.skills[0]
    holding = ("reading", 3)
    numbers = [("number", float(number)) for number in (1, 2, 4, 3)]
    assert go.edges[0].value == (
        *(numbers[0], numbers[1], numbers[2], ("/", 0), holding, ("negate", 0), ("/", 0), ("-", 0), numbers[3]),
        ("+", 0),
    )


def test_a_sensor_about_a_thing_of_another_task_is_fine() -> None:
    other = "task Other in plain\n  lasts 5 ticks\n\ncurriculum"
    assert changed(("curriculum", other)).diagnostics == ()


def test_a_mind_without_tasks_may_sense_what_it_likes() -> None:
    found = compiled(
        "tick 1/60 s\nmaster Go\nbody Robot is disc\nactuator left is wheel side left neutral 0.5\n"
        "sensor ball is bearing of ball\nskill Go is rule\nreads ball\ndrives left at ball\n"
    )
    assert found.diagnostics == ()


def test_each_noun_has_its_own_names_and_no_word_is_reserved() -> None:
    found = compiled(
        "tick 1/60 s\nmaster Reads\nbody Reads is disc\nactuator reads is servo neutral 0\n"
        "sensor per is inertial\nsensor on is inertial\nsensor at is sine period 1 s\nmemory when is cell decay 0\n"
        "skill Reads is rule\nreads per\nreads at\nreads when\ndrives reads at at + when\n"
        "task Reads in plain\nlasts 1 ticks\nrewards per + at per tick when when < on\n"
    )
    assert found.diagnostics == ()


def test_no_measure_or_event_has_an_argument_that_would_end_its_phrase() -> None:
    made = [cls for noun in ("measure", "event") for cls in kinds(noun).values()]
    assert made
    assert not {"per", "on", "for", "when"} & {argument.key for cls in made for argument in arguments(cls)}


def test_a_range_and_a_grid() -> None:
    graph = changed(("  lasts", "  contains rock is obstacle count 3 size 2 to 4 away 5 to 9\n  lasts")).graph
    assert graph is not None
    assert graph.tasks[0].things[2].kind == Obstacle(size=Span(2, 4), count=3, away=Span(5, 9))


def test_comments_tabs_blank_lines_and_windows_ends_change_nothing() -> None:
    plain = changed().graph
    assert changed(("  reads ball_bearing", "\t reads\tball_bearing\t# what for?\n\n#\n")).graph == plain
    text = TOUR.with_name("parts.mind").read_text(encoding="utf-8")
    assert codes(compiled(text.replace("\n", "\r\n"))) == ["no-master"]


def test_reads_may_stand_below_drives() -> None:
    moved = changed(("  reads ball_bearing\n", ""), ("  drives right\n", "  drives right\n  reads ball_bearing\n"))
    assert moved.graph == changed().graph
