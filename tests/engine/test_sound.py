"""What holds a graph together: each promise broken by itself, and named."""

from collections.abc import Callable
from dataclasses import replace

import pytest
from mindrun.events import Collision
from mindrun.expression import is_sound
from mindrun.functions import Mlp
from mindrun.graph import Condition, Edge, Graph, Lesson, Memory, Reward, Sensor, Task
from mindrun.learners import Genetic
from mindrun.measures import Forward
from mindrun.memory import Cell
from mindrun.sensors import Battery, Derivative, RangeFinder
from mindrun.sound import flaw
from mindrun.world import Plain

from tests.minds import always, mind, rule, skill

ONE = (("number", 1.0),)
REWARD = Reward("", (("reading", 0), ("measure", 0), ("+", 0)), 0)
TASK = Task("Go", Plain(), (), 10, (Forward(),), (Collision(),), (0,), (REWARD,), (0,))


def whole() -> Graph:
    """A mind with one of each."""
    top = rule("Top", always("skill", 1, 1.0), always("memory", 0, 1.0), reads=(0,))
    go = skill("Go", Mlp(1), (0, 3), ("actuator", 0), ("actuator", 1))
    sensors = (
        Sensor("eyes", RangeFinder(at=(0.0, 1.0)), 0, 2),
        Sensor("change", Derivative("eyes"), 2, 2),
        Sensor("again", Derivative("m0"), 4, 1),
    )
    lesson = Lesson("All", "Go", "Go", "Top", 5, False, False, Genetic())
    graph = mind(top, go, cells=(Cell(0.5),))
    memories = (Memory("m0", Cell(0.5), 5),)
    return replace(graph, sensors=sensors, memories=memories, tasks=(TASK,), lessons=(lesson,))


def test_a_whole_one_has_no_flaw() -> None:
    assert flaw(whole()) is None


def with_sensor(index: int, **changes: object) -> Callable[[Graph], Graph]:
    def change(graph: Graph) -> Graph:
        sensors = list(graph.sensors)
        sensors[index] = replace(sensors[index], **changes)
        return replace(graph, sensors=tuple(sensors))

    return change


def with_skill(index: int, **changes: object) -> Callable[[Graph], Graph]:
    def change(graph: Graph) -> Graph:
        skills = list(graph.skills)
        skills[index] = replace(skills[index], **changes)
        return replace(graph, skills=tuple(skills))

    return change


def with_task(**changes: object) -> Callable[[Graph], Graph]:
    return lambda graph: replace(graph, tasks=(replace(graph.tasks[0], **changes),))


def with_reward(**changes: object) -> Callable[[Graph], Graph]:
    return with_task(rewards=(replace(REWARD, **changes),))


def with_lesson(**changes: object) -> Callable[[Graph], Graph]:
    return lambda graph: replace(graph, lessons=(replace(graph.lessons[0], **changes),))


def sends(*edges: Edge) -> Callable[[Graph], Graph]:
    return with_skill(0, edges=edges)


FLAWED: list[tuple[Callable[[Graph], Graph], str]] = [
    (lambda g: replace(g, tick=0.0), "its tick cannot be 0 s"),
    (lambda g: replace(g, master="Nobody"), "its master 'Nobody' is not one of its skills"),
    (with_skill(1, name="Top"), "there cannot be a part called 'Top' twice"),
    (with_skill(1, name=" "), "there cannot be a part called ' '"),
    (with_sensor(0, name="m0"), "there cannot be a part called 'm0' twice"),
    (with_sensor(1, start=1), "sensor change has not the readings of its kind"),
    (with_sensor(0, start=1), "sensor eyes has not the readings of its kind"),
    (with_sensor(0, width=3), "sensor eyes has not the readings of its kind"),
    (with_sensor(1, width=1), "sensor change has not the readings of its kind"),
    (with_sensor(2, kind=Battery(), width=2), "sensor again has not the readings of its kind"),
    (with_sensor(0, kind=RangeFinder(at=()), width=0), "sensor eyes has not the readings of its kind"),
    (with_sensor(2, kind=Derivative("nothing")), "sensor again has not the readings of its kind"),
    (with_sensor(2, kind=Derivative("again")), "sensor again is the derivative of itself"),
    (lambda g: with_sensor(0, kind=Derivative("change"))(g), "sensor eyes is the derivative of itself"),
    (lambda g: replace(g, memories=(Memory("m0", Cell(0.5), 4),)), "the readings of its memories do not follow"),
    (lambda g: replace(g, memories=(Memory("m0", Cell(0.5), 6),)), "the readings of its memories do not follow"),
    (with_skill(1, inputs=(0, 6)), "skill Go reads what is not there"),
    (with_skill(1, inputs=(0, -1)), "skill Go reads what is not there"),
    (sends(always("skill", 0, 1.0)), "skill Top sends to what is not there"),
    (sends(always("skill", 2, 1.0)), "skill Top sends to what is not there"),
    (sends(always("actuator", 2, 1.0)), "skill Top sends to what is not there"),
    (sends(always("actuator", -1, 1.0)), "skill Top sends to what is not there"),
    (sends(always("memory", 1, 1.0)), "skill Top sends to what is not there"),
    (sends(always("sensor", 0, 1.0)), "skill Top sends to what is not there"),
    (sends(Edge("actuator", 0, 0)), "skill Top has outputs that are not its function's"),
    (with_skill(1, edges=(Edge("actuator", 0, 1), Edge("actuator", 1, 0))), "skill Go has outputs"),
    (with_skill(1, edges=(Edge("actuator", 0, 1),)), "skill Go has outputs"),
    (sends(Edge("actuator", 0, None, ())), "skill Top has an expression that cannot be computed"),
    (sends(Edge("actuator", 0, None, (("reading", 1),))), "skill Top has an expression that cannot be computed"),
    (sends(Edge("actuator", 0, None, (("measure", 0),))), "skill Top has an expression that cannot be computed"),
    (sends(Edge("actuator", 0, None, (("each", 0),))), "skill Top has an expression that cannot be computed"),
    (sends(Edge("actuator", 0, None, (("reading", 0.0),))), "skill Top has an expression that cannot be computed"),
    (with_task(ends=(1,)), "task Go names an event that is not there"),
    (with_task(counts=(1,)), "task Go names an event that is not there"),
    (with_reward(on=1), "task Go names an event that is not there"),
    (with_reward(on=-1), "task Go names an event that is not there"),
    (with_reward(amount=(("measure", 1),)), "task Go has a reward that cannot be computed"),
    (with_reward(amount=(("reading", 6),)), "task Go has a reward that cannot be computed"),
    (with_reward(amount=(("each", 0),)), "task Go has a reward that cannot be computed"),
    (with_reward(when=Condition(ONE, "<", (("each", 0),))), "task Go has a reward that cannot be computed"),
    (with_reward(when=Condition((("measure", 3),), "<", ONE)), "task Go has a reward that cannot be computed"),
    (with_reward(when=Condition(ONE, "=", ONE)), "task Go has a condition that cannot be computed"),
    (with_reward(each=(5, 2)), "task Go rewards readings that are not there"),
    (with_reward(each=(-1, 2)), "task Go rewards readings that are not there"),
    (with_reward(each=(0, 0)), "task Go rewards readings that are not there"),
    (with_lesson(skill="Nobody"), "the lesson of Nobody names what is not there"),
    (with_lesson(master="Nobody"), "the lesson of Go names what is not there"),
    (with_lesson(task="Nothing"), "the lesson of Go names what is not there"),
]


@pytest.mark.parametrize(("broken", "what"), FLAWED, ids=[f"{i}-{what}" for i, (_, what) in enumerate(FLAWED)])
def test_a_broken_one_is_told(broken: Callable[[Graph], Graph], what: str) -> None:
    said = flaw(broken(whole()))
    assert said
    assert said.startswith(what)


FINE: list[Callable[[Graph], Graph]] = [
    with_reward(each=(0, 6), amount=(("each", 0),)),
    with_reward(each=(5, 1), when=Condition((("each", 0),), ">=", ONE)),
    with_reward(on=None, when=Condition(ONE, "<", ONE)),
    with_reward(when=Condition(ONE, "<=", ONE)),
    with_reward(when=Condition(ONE, ">", ONE)),
    sends(
        always("skill", 1, 1.0), Edge("actuator", 1, None, (("reading", 0), ("negate", 0), ("number", 2.5), ("*", 0)))
    ),
]


@pytest.mark.parametrize("changed", FINE)
def test_what_may_be_is_let_be(changed: Callable[[Graph], Graph]) -> None:
    assert flaw(changed(whole())) is None


@pytest.mark.parametrize(
    ("words", "sound"),
    [
        ("number", True),
        ("number negate", True),
        ("number number +", True),
        ("number reading measure * /", True),
        ("", False),
        ("negate", False),
        ("number +", False),
        ("+", False),
        ("number number", False),
        ("number number + number", False),
        ("number + number", False),
    ],
)
def test_a_program_leaves_one_value(words: str, sound: bool) -> None:
    assert is_sound(tuple((word, 0) for word in words.split())) is sound
