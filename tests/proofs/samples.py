"""Minds put together so that a proof of each says something else."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace

import numpy as np
from mindrun.graph.graph import Edge, Graph, Sensor, Skill
from mindrun.graph.weights import Weights
from mindrun.kinds.functions.mlp import Mlp
from mindrun.kinds.functions.procedure import Procedure
from mindrun.kinds.memory import Cell
from mindrun.kinds.sensors.rays import RangeFinder

from mindlang.proofs.recorded import Recorded, Undriven
from tests.hierarchies import doubling
from tests.minds import CLAW, WHEELS, always, mind, rule, skill

LEFT, RIGHT, CLAWED = 0, 1, 2
R0 = (("reading", 0),)
ONE_LESS_R0 = (("number", 1.0), ("reading", 0), ("-", 0))


@dataclass(frozen=True, slots=True)
class Sample:
    """A mind, its weights, and a run of it where there is one."""

    graph: Graph
    weights: Mapping[str, Weights] = field(default_factory=dict)
    run: Recorded | None = None
    delta: float = 0.01

    @property
    def hashes(self) -> dict[str, str]:
        """Stand-ins for the SHA-256 of the weights."""
        return {name: f"{place:04x}" + 60 * "0" for place, name in enumerate(self.weights, 0xA001)}


def single(*values: float) -> Weights:
    """Weights."""
    return np.array(values, np.float32)


def drives(name: str, value: float, actuator: int = LEFT) -> Skill:
    """A rule that drives one wheel at a constant."""
    return rule(name, always("actuator", actuator, value))


def sends(to: str, target: int, program: tuple[tuple[str, float | int], ...]) -> Edge:
    """An edge with an expression."""
    return Edge(to, target, None, program)


def chain(name: str, begin: int, count: int, actuator: int) -> Iterator[Skill]:
    """Learnt skills from place `begin` on, each of which influences the next; the last drives."""
    for i in range(count - 1):
        yield skill(f"{name}{i}", Mlp(), (0,), ("skill", begin + i + 1))
    yield skill(f"{name}{count - 1}", Mlp(), (0,), ("actuator", actuator))


def dead() -> Sample:
    """Learnt lines that never send, and always send all; skills that lie about outside."""
    graph = mind(
        skill("Top", Mlp(hidden=1, width=1), (0,), *(("skill", i) for i in (1, 2, 3, 6))),
        rule("Dead", always("skill", 4, 1.0), always("actuator", LEFT, 0.25)),
        rule("Full", always("actuator", LEFT, 0.75), always("skill", 5, 0.0)),
        skill("Middle", Mlp(hidden=0), (0,), ("actuator", LEFT), ("skill", 7)),
        drives("Below", 1.0, RIGHT),
        drives("Off", 0.5),
        rule("Shared", always("skill", 7, 1.0)),
        drives("Shut", 0.5),
        *(drives(f"Lost{i}", 0.5) for i in range(5)),
        actuators=(*WHEELS, CLAW),
    )
    return Sample(graph, {"Top": single(1, -2, 3, 1, -1), "Middle": single(0.5, -0.5)})


def still() -> Sample:
    """Wheels that nothing may influence: where one skill keeps still, where two do; an influence next to none."""
    graph = mind(
        rule("Top", sends("skill", 1, R0), sends("skill", 2, ONE_LESS_R0), always("skill", 3, 1.0), reads=(0,)),
        rule("A", sends("actuator", CLAWED, R0), reads=(0,)),
        rule("B", sends("skill", 4, R0), reads=(0,)),
        rule("C", sends("skill", 5, R0), sends("skill", 6, (*R0, ("number", 1e-31), ("+", 0))), reads=(0,)),
        skill("D", Mlp(hidden=0), (0,), ("actuator", LEFT)),
        skill("E", Mlp(hidden=0), (3, 4), ("actuator", LEFT)),
        drives("F", 0.2, RIGHT),
        actuators=(*WHEELS, CLAW),
        cells=(Cell(0.5, 0.5),),
    )
    eye = Sensor("eye", RangeFinder(at=(0.0, 30.0, 330.0)), 1, 3)
    graph = replace(graph, sensors=(*graph.sensors, eye), memories=(replace(graph.memories[0], start=4),))
    return Sample(graph, {"D": single(0.5), "E": single(0.25, 0.5)})


def together() -> Sample:
    """Branches of which one is always on; more skills that learn than are named."""
    graph = mind(
        rule("Top", sends("skill", 1, R0), sends("skill", 2, ONE_LESS_R0), reads=(0,)),
        skill("A", Mlp(hidden=0), (0,), ("actuator", LEFT), ("skill", 3)),
        skill("B", Mlp(hidden=0), (0,), ("actuator", LEFT), ("skill", 4)),
        skill("C", Mlp(hidden=0), (0,), ("actuator", LEFT)),
        skill("D", Mlp(hidden=0), (0,), ("actuator", RIGHT)),
    )
    run = Recorded("Roam", 7, 2000, 0, (Undriven(0, None, (0.25, 0.5)), Undriven(1200, 801, (0.5, 0.5))))
    weights = {"A": single(0.25, 0.5), "B": single(0.5, -0.25), "C": single(1), "D": single(1)}
    return Sample(graph, weights, run)


def unknown() -> Sample:
    """Python code, and skills without weights: one, several, and more than are named."""
    graph = mind(
        skill("Top", Procedure("turning.turn"), (0,), ("skill", 1), ("skill", 2)),
        skill("Under", Mlp(), (0,), *(("skill", i) for i in range(3, 7))),
        skill("Other", Mlp(hidden=0), (0,), ("actuator", LEFT), ("skill", 7)),
        *(skill(f"Go{i}", Mlp(), (0,), ("actuator", LEFT)) for i in range(4)),
        drives("Still", 0.5, RIGHT),
    )
    return Sample(graph, {"Other": single(0.5, 0.25)})


def untaught() -> Sample:
    """Two skills with Python code, and one that has no weights."""
    graph = mind(
        skill("Top", Procedure("turning.turn"), (0,), ("skill", 1), ("skill", 2)),
        skill("Under", Procedure("turning.turn"), (0,), ("actuator", LEFT)),
        skill("Other", Mlp(), (0,), ("actuator", RIGHT)),
    )
    return Sample(graph)


def long() -> Sample:
    """Paths of six skills, of seven, and of one; leaks into four skills, and into five."""
    graph = mind(
        skill("Top", Mlp(), (0,), *(("skill", i) for i in (1, 2, 3, 4, 10))),
        *(skill(f"L{i}", Mlp(), (0,), ("skill", 5)) for i in range(3)),
        skill("More", Mlp(), (0,), ("skill", 5), *(("skill", i) for i in (16, 17, 18, 19))),
        *chain("Six", 5, 4, LEFT),
        drives("Aside", 0.5),
        *chain("Seven", 10, 6, RIGHT),
        *(skill(f"R{i}", Mlp(), (0,), ("skill", 20), ("actuator", LEFT)) for i in range(4)),
        drives("End", 0.5, RIGHT),
    )
    return Sample(graph, delta=0.05)


def wide() -> Sample:
    """Leaks into four skills, all of which are named, and into five, which are not."""
    graph = mind(
        skill("Top", Mlp(), (0,), *(("skill", i) for i in range(1, 12))),
        *(drives(f"L{i}", 0.5) for i in range(5)),
        *(drives(f"R{i}", 0.5, RIGHT) for i in range(6)),
    )
    return Sample(graph)


def countless() -> Sample:
    """More ways than are counted, and more influence than a number holds."""
    return Sample(mind(*doubling(130, (always("actuator", LEFT, 0.25),)), actuators=WHEELS[:1]))


SAMPLES = {each.__name__: each() for each in (dead, still, together, unknown, untaught, long, wide, countless)}
