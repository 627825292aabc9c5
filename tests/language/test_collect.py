"""The paper's whole curriculum, compiled."""

from itertools import pairwise

import pytest
from mindrun.graph.graph import Edge, End, Graph, Reward, Skill
from mindrun.kinds.functions.function import Rule
from mindrun.kinds.functions.mlp import Mlp
from mindrun.kinds.learners import Genetic
from mindrun.kinds.measures.measure import CommandChange, Forward
from mindrun.kinds.scenes.scene import Arena
from mindrun.kinds.sensors.waves import Sine
from mindrun.kinds.things.obstacle import Obstacle
from mindrun.kinds.things.thing import Item
from mindrun.numbers.quantity import Span

from mindlang.compiler.compile import load
from tests.language.examples import COLLECT, compiled


@pytest.fixture(scope="module")
def graph() -> Graph:
    found = load(COLLECT)
    assert found.diagnostics == ()
    assert found.graph is not None
    return found.graph


def weights(skill: Skill) -> int:
    """Eq. 5: as many layers as `hidden` says, each of max(inputs, outputs) + 2 neurons, without biases."""
    if not isinstance(skill.function, Mlp):
        return 0
    inputs = len(skill.inputs)
    width = skill.function.width or max(inputs, skill.outputs) + 2
    layers = [inputs, *[width] * skill.function.hidden, skill.outputs]
    return sum(above * below for above, below in pairwise(layers))


def inputs(graph: Graph, name: str) -> list[str]:
    """The inputs of a skill by name, one per reading."""
    names = [sensor.name for sensor in graph.sensors for _ in range(sensor.width)]
    names += [memory.name for memory in graph.memories]
    skill = next(skill for skill in graph.skills if skill.name == name)
    return [names[index] for index in skill.inputs]


def test_every_skill_reads_what_it_says(graph: Graph) -> None:
    eyes = ["proximity"] * 10
    assert inputs(graph, "GoToObject") == ["object_bearing"]
    assert inputs(graph, "GoToDropZone") == ["drop_zone_bearing"]
    assert inputs(graph, "Avoid") == [*eyes, "moving", "pulse"]
    assert inputs(graph, "Grab") == ["object_in_reach", "holding", "in_drop_zone"]
    assert inputs(graph, "GoToObject+Avoid") == [*eyes, "object_bearing", "object_drift", "object_in_reach"]
    assert inputs(graph, "GoToDropZone+Avoid") == [*eyes, "drop_zone_bearing", "drop_zone_drift", "in_drop_zone"]
    assert inputs(graph, "Collect") == [
        *("object_bearing", "object_drift", "object_in_reach"),
        *("drop_zone_bearing", "drop_zone_drift", "in_drop_zone", "holding"),
    ]


def test_the_six_skills_have_1510_weights(graph: Graph) -> None:
    assert sum(map(weights, graph.skills)) == 1510


def test_the_monolith_has_1610_weights() -> None:
    angles = " ".join(str(angle) for angle in range(21))
    found = compiled(
        f"tick 1/60 s\nmaster M\nbody Robot is disc\nsensor eyes is range_finder at {angles} deg\n"
        "actuator a is servo neutral 0\nactuator b is servo neutral 0\nactuator c is servo neutral 0\n"
        "skill M is mlp hidden 3\nreads eyes\ndrives a\ndrives b\ndrives c\n"
    )
    assert found.graph is not None
    assert [weights(skill) for skill in found.graph.skills] == [1610]


def test_parents_stand_before_their_subskills(graph: Graph) -> None:
    assert [skill.name for skill in graph.skills] == [
        *("Collect", "Grab", "GoToObject+Avoid", "GoToObject", "GoToDropZone+Avoid", "GoToDropZone", "Avoid"),
    ]
    for place, skill in enumerate(graph.skills):
        assert all(edge.target > place for edge in skill.edges if edge.to == "skill")


def test_readings_are_laid_out_in_the_order_of_the_source(graph: Graph) -> None:
    assert graph.width == 19
    assert [(sensor.name, sensor.start, sensor.width) for sensor in graph.sensors][:3] == [
        ("proximity", 0, 10),
        ("object_bearing", 10, 1),
        ("object_drift", 11, 1),
    ]
    assert graph.sensors[-1].kind == Sine(2.0)


def test_an_edge_with_at_takes_no_output(graph: Graph) -> None:
    collect, grab = graph.skills[:2]
    assert collect.edges == (
        Edge("skill", 2, 0),
        Edge("skill", 4, 1),
        Edge("skill", 1, None, (("number", 1.0),)),
    )
    assert all(edge.to != "skill" for edge in grab.edges)
    assert grab.function == Rule()
    assert grab.edges[0].value == (
        ("reading", 14),
        ("reading", 16),
        ("+", 0),
        ("number", 1.0),
        ("reading", 15),
        ("-", 0),
        ("*", 0),
    )


def test_the_task_avoid(graph: Graph) -> None:
    task = next(task for task in graph.tasks if task.name == "Avoid")
    assert task.scene == Arena(100.0)
    assert task.things[0].kind == Obstacle(size=Span(4, 8), grid=20, jitter=1)
    assert task.measures == (Forward(), CommandChange("thrust", 0.2, 10))
    assert len(task.events) == 2
    assert task.ends == (End(task.rewards[1].on),)
    assert task.counts == (task.rewards[0].on,)
    each = task.rewards[3]
    assert isinstance(each, Reward)
    assert each.each == (0, 10)
    assert each.text == "rewards -0.03 * (1 - 4 * p) per tick for each p in proximity when p < 1/4"
    assert each.when is not None
    assert each.when == (("each", 0), ("number", 0.25), ("<", 0))


def test_a_schedule_and_the_lessons(graph: Graph) -> None:
    assert graph.tasks[0].things[0].kind == Item(size=Span(3, 1, 0.1), reached="moves")
    assert [lesson.master for lesson in graph.lessons[:6]] == [lesson.skill for lesson in graph.lessons[:6]]
    assert [lesson.generations for lesson in graph.lessons[:6]] == [1000, 1000, 1000, 1500, 1500, 1500]


def test_scenario_2_is_one_line() -> None:
    graph = load(COLLECT.with_name("on_the_job.mind")).graph
    assert graph is not None
    lesson = graph.lessons[0]
    assert (lesson.skill, lesson.task, lesson.master, lesson.generations) == ("Avoid", "Collect", "Collect", 1500)
    assert lesson.from_scratch
    assert lesson.learner == Genetic(population=100)
