"""What holds a graph together: each promise broken by itself, and named."""

from collections.abc import Callable, Iterator
from dataclasses import replace
from itertools import product
from math import inf, nan, nextafter

import numpy as np
import pytest
from mindrun.engine.engine import virtual_sensors
from mindrun.graph.draws import Draw
from mindrun.graph.graph import Edge, End, Gate, Graph, Lesson, Memory, Program, Reward, Sensor, Task, Thing
from mindrun.graph.measured import with_sources
from mindrun.graph.validate import graph_flaw
from mindrun.kinds.events.event import Delivery, Reach, Success, Visit
from mindrun.kinds.functions.mlp import Mlp
from mindrun.kinds.learners import Genetic
from mindrun.kinds.measures.measure import Advance, Progress, Retreat
from mindrun.kinds.memory import Cell
from mindrun.kinds.scenes.scene import Arena, Plain
from mindrun.kinds.sensors.battery import Battery
from mindrun.kinds.sensors.derived import Derivative
from mindrun.kinds.sensors.rays import RangeFinder
from mindrun.kinds.sensors.waves import Sine
from mindrun.kinds.things.obstacle import Obstacle
from mindrun.kinds.things.thing import Item, ThingKind, Zone
from mindrun.numbers import arrays
from mindrun.numbers.expression import OPERATORS, evaluate, is_valid_program
from mindrun.numbers.quantity import UNSAID, Span

from tests.minds import always, mind, rule, skill

ONE = (("number", 1.0),)
HOLDS = (*ONE, *ONE, ("<=", 0))
REWARD = Reward("", (("reading", 0), ("measure", 0), ("+", 0)), 0)
BALL = Thing("ball", Item())
SIDE: Program = (("drawn", 0),)
ROCKS, CLOSE = Thing("rocks", Obstacle(grid=10.0)), Thing("close", Obstacle(grid=5e-324))
TASK = Task("Go", Plain(), (BALL,), 10, (Progress("ball"),), (Reach("ball"),), (End(0),), (REWARD,), (0,))


def many(count: int, kind: ThingKind, name: str = "one") -> Iterator[Thing]:
    """Things of one kind."""
    return (Thing(f"{name}{number}", kind) for number in range(count))


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
    assert graph_flaw(whole()) is None


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


def with_drawn(at: Program, many: int = 0, *, is_there: Program = ()) -> Callable[[Graph], Graph]:
    """A ball at a place, or as many as are drawn, of a number that is 0, 2 or 3."""
    kind = Item(count=3) if many else Item(at=((1.0, 1.0),))
    ball = Thing("ball", kind, is_there, () if many else (at, at), many)
    return with_task(things=(ball,), draws=(Draw("side", (0.0, 2.0, 3.0)), Draw("far", (0.0, 4.0), True)))


def with_reward(**changes: object) -> Callable[[Graph], Graph]:
    return with_task(rewards=(replace(REWARD, **changes),))


def with_lesson(**changes: object) -> Callable[[Graph], Graph]:
    return lambda graph: replace(graph, lessons=(replace(graph.lessons[0], **changes),))


def sends(*edges: Edge) -> Callable[[Graph], Graph]:
    return with_skill(0, edges=edges)


IN_ORDER = Edge("skill", 1, None, (("number", 1.0),), over=(("actuator", 0), ("actuator", 1)))


def twin(**changes: object) -> Callable[[Graph], Graph]:
    """A third skill, which is like Go but for the changes."""
    return lambda g: replace(g, skills=(*g.skills, replace(g.skills[1], **({"name": "Twin", "like": "Go"} | changes))))


FLAWED: list[tuple[Callable[[Graph], Graph], str]] = [
    (lambda g: replace(g, tick=0.0), "its tick cannot be 0 s"),
    (lambda g: replace(g, tick=nextafter(1e-9, 0)), "its tick cannot be 1e-09 s"),
    (lambda g: replace(g, tick=nextafter(1e9, inf)), "its tick cannot be 1e+09 s"),
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
    (with_skill(1, edges=(Edge("skill", 1, 0),)), "skill Go sends to what is not there"),
    (with_skill(1, edges=(Edge("skill", 0, 0),)), "skill Go sends to what is not there"),
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
    (sends(Edge("actuator", 0, None, (("command", 0),))), "skill Top has an expression that cannot be computed"),
    (
        sends(Edge("actuator", 0, None, ONE, Gate((("each", 0),)))),
        "skill Top has an expression that cannot be computed",
    ),
    (sends(Edge("actuator", 0, None, ONE, Gate(HOLDS, ()))), "skill Top has an expression that cannot be computed"),
    (sends(Edge("actuator", 0, None, ONE, Gate(ONE))), "skill Top has a condition that cannot be computed"),
    (sends(Edge("actuator", 0, None, ONE, cuts=0.1)), "skill Top cuts what cannot be cut"),
    (sends(Edge("skill", 1, None, ONE, cuts=1.5)), "skill Top cuts what cannot be cut"),
    (sends(Edge("actuator", 0, None, ONE, over=(("actuator", 1),))), "skill Top has influence over what cannot be so"),
    (sends(replace(IN_ORDER, over=IN_ORDER.over[::-1])), "skill Top has influence over what cannot be so"),
    (sends(replace(IN_ORDER, over=(("actuator", 2),))), "skill Top has influence over what is not there"),
    (with_skill(0, edges=(always("actuator", 0, 1.0),), chooses=True), "skill Top has nothing to choose"),
    (twin(function=Mlp(2)), "skill Twin has not the shape of Go, which it is like"),
    (twin(inputs=(0,)), "skill Twin has not the shape of Go, which it is like"),
    (twin(edges=()), "skill Twin has not the shape of Go, which it is like"),
    (twin(frozen=True), "skill Twin has not the shape of Go, which it is like"),
    (twin(like="Top"), "skill Twin is like 'Top', which owns no weights"),
    (sends(Edge("actuator", 0, None, (("reading", 0.0),))), "skill Top has an expression that cannot be computed"),
    (with_task(name="Go there"), "there cannot be a part called 'Go there'"),
    (with_task(ticks=0), "task Go does not last"),
    (with_task(ticks=-5), "task Go does not last"),
    (with_task(things=(BALL, BALL)), "task Go contains what has no name of its own"),
    (with_task(things=(BALL, Thing("no name", Zone()))), "task Go contains what has no name of its own"),
    (with_task(things=(Thing("", Item()),)), "task Go contains what has no name of its own"),
    (with_task(things=(BALL, Thing("home", Zone(size=UNSAID)))), "task Go contains what has no size"),
    (with_drawn(SIDE, is_there=SIDE), "task Go has a thing of which nobody knows whether it is there"),
    (with_drawn((("number", 1.0), *SIDE, ("/", 0))), "task Go has a thing of which nobody knows where it is"),
    (with_drawn((("number", 1e5), *SIDE, ("*", 0))), "task Go has a thing of which nobody knows where it is"),
    (with_drawn((*SIDE, ("+", 0))), "task Go has a thing of which nobody knows where it is"),
    (with_drawn((("drawn", 2),)), "task Go has a thing of which nobody knows where it is"),
    (with_drawn((), 2), "task Go has a thing of which nobody knows how many there are"),
    (with_drawn((), 3), "task Go has a thing of which nobody knows how many there are"),
    (with_drawn((), -1), "task Go has a thing of which nobody knows how many there are"),
    (with_task(things=()), "task Go names a thing that is not there"),
    (with_task(things=(Thing("ball", Obstacle(count=1)),)), "task Go names a thing that is not there"),
    (with_task(events=(Reach("no"),)), "task Go names a thing that is not there"),
    (with_task(events=(Delivery("no"),)), "task Go names a thing that is not there"),
    (with_task(measures=(Progress("no"),)), "task Go names a thing that is not there"),
    (with_task(measures=(Advance("no"),)), "task Go names a thing that is not there"),
    (with_task(measures=(Retreat("no"),)), "task Go names a thing that is not there"),
    (with_task(things=(BALL, *many(100, Zone()))), "task Go contains more than 100 things"),
    (with_task(things=(BALL, *many(26, Obstacle(count=100)))), "task Go contains more than 2500 obstacles"),
    (with_task(things=(BALL, ROCKS), scene=Arena(520.0)), "task Go contains more than 2500 obstacles"),
    (with_task(things=(BALL, CLOSE), scene=Arena()), "task Go contains more than 2500 obstacles"),
    (with_task(events=(Visit("patch"),)), "task Go has patches without an arena"),
    (with_task(ends=(End(1),)), "task Go names an event that is not there"),
    (with_task(ends=(End(None),)), "task Go has an end that never comes"),
    (with_task(ends=(End(0, when=HOLDS),)), "task Go has an end that never comes"),
    (with_task(ends=(End(0, 0),)), "task Go has an end that never comes"),
    (with_task(ends=(End(None, when=ONE),)), "task Go has an end that cannot be computed"),
    (with_task(ends=(End(None, when=(("reading", 6), *ONE, ("<", 0))),)), "task Go has an end that cannot be computed"),
    (with_task(ends=(End(1),), events=(Reach("ball"), Success())), "task Go ends on its own success"),
    (with_task(counts=(1,)), "task Go names an event that is not there"),
    (with_reward(on=1), "task Go names an event that is not there"),
    (with_reward(on=-1), "task Go names an event that is not there"),
    (with_reward(amount=(("measure", 1),)), "task Go has a reward that cannot be computed"),
    (with_reward(amount=(("reading", 6),)), "task Go has a reward that cannot be computed"),
    (with_reward(amount=(("command", 2),)), "task Go has a reward that cannot be computed"),
    (with_reward(amount=(("each", 0),)), "task Go has a reward that cannot be computed"),
    (with_reward(when=(*ONE, ("each", 0), ("<", 0))), "task Go has a reward that cannot be computed"),
    (with_reward(when=(("measure", 3), *ONE, ("<", 0))), "task Go has a reward that cannot be computed"),
    (with_reward(when=()), "task Go has a reward that cannot be computed"),
    (with_reward(when=(*ONE, *ONE, ("+", 0))), "task Go has a condition that cannot be computed"),
    (with_reward(each=(5, 2)), "task Go rewards readings that are not there"),
    (with_reward(each=(-1, 2)), "task Go rewards readings that are not there"),
    (with_reward(each=(0, 0)), "task Go rewards readings that are not there"),
    (with_lesson(curriculum="All of it"), "a lesson cannot name 'All of it'"),
    (with_lesson(skill=""), "a lesson cannot name ''"),
    (with_lesson(task="1"), "a lesson cannot name '1'"),
    (with_lesson(master="a b"), "a lesson cannot name 'a b'"),
    (with_lesson(generations=0), "the lesson of Go has no generation"),
    (with_lesson(skill="Nobody"), "the lesson of Nobody names what is not there"),
    (with_lesson(master="Nobody"), "the lesson of Go names what is not there"),
    (with_lesson(task="Nothing"), "the lesson of Go names what is not there"),
]


@pytest.mark.parametrize(("broken", "what"), FLAWED, ids=[f"{i}-{what}" for i, (_, what) in enumerate(FLAWED)])
def test_a_broken_one_is_told(broken: Callable[[Graph], Graph], what: str) -> None:
    said = graph_flaw(broken(whole()))
    assert said
    assert said.startswith(what)


FINE: list[Callable[[Graph], Graph]] = [
    lambda g: replace(g, tick=1e-9),
    lambda g: replace(g, tick=1e9),
    twin(inputs=(3, 0)),
    with_task(ticks=1),
    with_task(things=(BALL, *many(99, Zone()), *many(25, Obstacle(count=100), "stone"))),
    with_task(things=(BALL, ROCKS), scene=Arena(510.0)),
    with_task(things=(BALL, CLOSE)),  # which is nowhere without walls
    with_task(things=(Thing("ball", Item(size=Span(0.0, 0.0))),)),
    with_task(events=(Visit("patch"),), scene=Arena()),
    with_task(ends=(End(0, 3, succeeds=True), End(None, when=HOLDS)), events=(Reach("ball"), Success())),
    with_lesson(generations=1, curriculum="Größe_2+Go.on"),
    with_reward(amount=(("command", 1),)),
    sends(Edge("actuator", 0, None, ONE, Gate(HOLDS))),
    sends(Edge("skill", 1, None, ONE, Gate(HOLDS, ONE), 1.0)),
    with_reward(each=(0, 6), amount=(("each", 0),)),
    with_reward(each=(5, 1), when=(("each", 0), *ONE, (">=", 0))),
    with_reward(on=None, when=(*ONE, *ONE, ("<", 0))),
    with_reward(when=(*ONE, *ONE, ("<=", 0))),
    with_reward(when=(*ONE, *ONE, (">", 0))),
    sends(
        always("skill", 1, 1.0), Edge("actuator", 1, None, (("reading", 0), ("negate", 0), ("number", 2.5), ("*", 0)))
    ),
]


@pytest.mark.parametrize("changed", FINE)
def test_what_may_be_is_let_be(changed: Callable[[Graph], Graph]) -> None:
    assert graph_flaw(changed(whole())) is None


def test_sources_are_computed_before_what_derives_from_them() -> None:
    of = {"a": "b", "b": "beat", "c": "a"}
    kinds = {name: Derivative(source) for name, source in of.items()} | {"beat": Sine(1.0)}
    sensors = tuple(Sensor(name, kind, start, 1) for start, (name, kind) in enumerate(kinds.items()))
    graph = replace(whole(), sensors=sensors, memories=())
    assert [sensor.name for sensor in with_sources(graph, {0, 1, 2, 3})] == ["beat", "b", "a", "c"]
    assert [place.start for place, _ in virtual_sensors(graph)] == [3, 1, 0, 2]


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
    assert is_valid_program(tuple((word, 0) for word in words.split())) is sound


@pytest.mark.parametrize("operator", sorted(OPERATORS))
def test_a_program_has_the_value_that_it_has_on_arrays(operator: str) -> None:
    for left, right in product((-inf, -2.0, -0.0, 0.0, 3.0, inf, nan), repeat=2):
        with np.errstate(all="ignore"):
            expected = arrays.OPERATORS[operator](np.float64(left), np.float64(right))
        said = evaluate((("number", left), ("number", right), (operator, 0)))
        assert repr(float(said)) == repr(float(expected)), (left, right)
