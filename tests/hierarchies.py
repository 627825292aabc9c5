"""Hypothesis strategies for whole hierarchies, their weights and what they read."""

from collections.abc import Mapping
from dataclasses import dataclass, fields, replace
from math import pi, prod
from pathlib import Path

import numpy as np
from hypothesis import strategies as st
from mindrun.graph.graph import Actuator, Edge, Gate, Graph, Memory, Program, Promise, Sensor, Skill
from mindrun.graph.weights import genes
from mindrun.kinds.actuators.actuator import Gripper, Servo, Wheel
from mindrun.kinds.bodies.body import Disc
from mindrun.kinds.functions.function import Function, Rule
from mindrun.kinds.functions.procedure import Procedure
from mindrun.kinds.memory import Cell, Counter, MemoryKind, Place, Register
from mindrun.kinds.registry import arguments, kinds
from mindrun.kinds.sensors.battery import Battery
from mindrun.kinds.sensors.bumper import Bumper
from mindrun.kinds.sensors.compass import Compass, Direction
from mindrun.kinds.sensors.computed import Broken, Computed
from mindrun.kinds.sensors.contact import Contact, Floor, Held, Inside
from mindrun.kinds.sensors.derived import Average, Derivative, Latch, Mirrored, Reading, Turned
from mindrun.kinds.sensors.motion import Inertial, Odometer, Position, Speed, TurnRate
from mindrun.kinds.sensors.nearest import Bearing, Distance, Light
from mindrun.kinds.sensors.order import Order
from mindrun.kinds.sensors.rays import Eye, RangeFinder
from mindrun.kinds.sensors.sensor import Physical, SensorKind, directions
from mindrun.kinds.sensors.signal import Signal
from mindrun.kinds.sensors.waves import Clock, Sine
from mindrun.numbers.quantity import Span
from numpy.typing import NDArray

SHARES = st.floats(0, 1, width=32)
EYES = tuple(map(float, range(10)))
WORLDLY = [
    RangeFinder(at=EYES),
    RangeFinder(at=(-1.0, 0.5, -0.5, 1.0), range=4.0, dead_zone=0.0),
    Bearing("object"),
    Bearing("coin", range=5.0, dead_zone=0.1),
    Bearing("rock"),
    Bearing("fence", range=5.0),
    Bearing("object", on="a1"),
    Compass(),
    Compass(dead_zone=0.1),
    Direction("a0"),
    Direction("a1"),
    Contact("object"),
    Contact("coin"),
    Held("object"),
    Held("coin"),
    Inside("home"),
    Inside("plug"),
    Signal("mate"),
    Signal("scout", range=9.0),
    Inertial(),
    Inertial(2.0, dead_zone=0.05),
    Battery(),
    Battery(0.5, 0.01, 0.02),
    Distance("object"),
    Distance("home", range=9.0),
    Distance("stone"),
    Distance("maze", range=9.0),
    Light("coin"),
    Light("plug", range=4.0),
    Light("crate"),
    Light("ball"),
    Eye("object", at=EYES[:3]),
    Eye("home", at=EYES[:2], on="a2"),
    RangeFinder(at=EYES[:3], on="a1"),
    Eye("crate", at=EYES[:3]),
    Eye("ball", at=(0.0, 0.2)),
    Eye("fence", at=(-0.5, 0.0, 0.5, 3.0)),
    Eye("block", at=(0.0, 0.3)),
    Eye("stone", at=EYES, range=12.0),
    Eye("home", at=(-0.5, 0.0, 2.0, 3.5), range=9.0),
    TurnRate(),
    TurnRate(2.0, dead_zone=0.05),
    Speed(),
    Speed(2.0, dead_zone=0.05),
    Odometer("left"),
    Odometer("right", range=3.0),
    Position("x"),
    Position("y", range=8.0),
    Floor("den"),
    Floor("coin", at=(0.7, 0.0, -0.7), ahead=1.5),
    Bumper(),
    Bumper(at=EYES[:6], width_=1.2),
    Order(Span(1.0, 3.0)),
    Order(Span(1.0, 4.0), 2.0, every=0.1, lost=0.4, timeout=2.0),
    Order(Span(-1.0, 1.0), every=0.05),
    Order(Span(0.0, 1.0), 0.25, lost=0.5),
]
ROUGH = st.fixed_dictionaries(
    {},
    optional={
        "noise": st.sampled_from([0.1, 0.2]),
        "lost": st.sampled_from([0.2, 0.5]),
        "every": st.integers(2, 3),
        "delay": st.integers(1, 3),
    },
)
VIRTUAL = st.sampled_from(
    ["sine", "clock", "derivative", "computed", "latch", "average", "reading", "turned", "mirrored", "broken"]
)
ACTUATORS = [Wheel("left", 0.5), Wheel("right", 0.5, delay=2), Gripper(0.0), Servo(0.3), Servo(0.4, 0, 1.2, 0.3)]
CALLED = Procedure("")
PROCEDURES = Path(__file__).parent / "procedures"  # the folder of the modules that are called
SCALES = [0.1, 0.3, 0.3, 1.0, 10.0, 1e4, 1e20, 3e38]


@dataclass(frozen=True, slots=True)
class Case:
    """A hierarchy with weights and what it reads, [ticks, graph.width]."""

    graph: Graph
    weights: dict[str, NDArray[np.float32]]
    readings: NDArray[np.float32]


@st.composite
def random_graph(draw: st.DrawFn, fewest_hidden: int = 0, alike: bool = True) -> Graph:
    """A hierarchy: shared skills, several parents, drive and influence at once, `at`, memories, virtual sensors.

    With `alike`, skills may be like others.
    """
    sensors, memories = draw(_senses())
    width = sum(sensor.width for sensor in sensors) + sum(memory.kind.kept for memory in memories)
    actuators = tuple(Actuator(f"a{i}", draw(st.sampled_from(ACTUATORS))) for i in range(draw(st.integers(1, 3))))
    sensors = draw(on_servos(sensors, actuators))
    count = draw(st.integers(1, 6))
    skills = []
    for number in range(count):
        targets = [("skill", i) for i in range(number + 1, count)]
        targets += [("actuator", i) for i in range(len(actuators))] + [("memory", i) for i in range(len(memories))]
        skills.append(draw(_skills(f"S{number}", width, targets, fewest_hidden)))
    for number in reversed(range(count - 1)):
        owners = [each for each in skills[number + 1 :] if each.function.learns and not each.like]
        if alike and owners and draw(st.integers(0, 4)) == 0:
            targets = [("skill", i) for i in range(number + 1, count)]
            targets += [("actuator", i) for i in range(len(actuators))] + [("memory", i) for i in range(len(memories))]
            skills[number] = draw(_alike(f"S{number}", draw(st.sampled_from(owners)), width, targets))
    sensors = tuple(_about(each, skills) for each in sensors)
    return Graph(1 / 60, Disc(), "S0", sensors, memories, actuators, tuple(skills), (), ())


def _about(sensor: Sensor, skills: list[Skill]) -> Sensor:
    """A sensor that is about a skill that is there, if it is about any."""
    is_there = not isinstance(sensor.kind, Broken) or sensor.kind.broken in {skill.name for skill in skills}
    return sensor if is_there else replace(sensor, kind=replace(sensor.kind, broken="S0"))


@st.composite
def on_servos(draw: st.DrawFn, sensors: tuple[Sensor, ...], actuators: tuple[Actuator, ...]) -> tuple[Sensor, ...]:
    """Sensors whose servos are among the actuators: some sit on others than they did, or on none."""
    servos = [actuator.name for actuator in actuators if actuator.kind.carries]
    found = []
    for sensor in sensors:
        kind = sensor.kind
        if isinstance(kind, Direction):
            said = {each.name: getattr(kind, each.name) for each in fields(Physical)}
            kind = replace(kind, of=draw(st.sampled_from(servos))) if servos else Compass(**said)
        elif kind.servo or (hasattr(kind, "on") and not kind.is_reckoned and draw(st.booleans())):
            kind = replace(kind, on=draw(st.sampled_from(servos or [""])))
        found.append(replace(sensor, kind=kind))
    return tuple(found)


@st.composite
def _alike(draw: st.DrawFn, name: str, owner: Skill, width: int, targets: list[tuple[str, int]]) -> Skill:
    """A skill that is like another, and reads something else, and may send to something else."""
    count = len(owner.inputs)
    inputs = tuple(draw(st.lists(st.integers(0, width - 1), unique=True, min_size=count, max_size=count)))
    instead = dict(zip(owner.inputs, inputs, strict=True))

    def other(program: Program) -> Program:
        return tuple((word, instead[value] if word == "reading" else value) for word, value in program)

    def other_gate(gate: Gate) -> Gate:
        return Gate(other(gate.when), None if gate.otherwise is None else other(gate.otherwise))

    sent = [(edge.to, edge.target) for edge in owner.edges]
    if not (owner.chooses or any(edge.over for edge in owner.edges)) and draw(st.booleans()):
        sent = draw(st.permutations(targets))[: len(sent)]
    edges = tuple(
        replace(
            edge,
            to=to,
            target=target,
            value=other(edge.value),
            gate=other_gate(edge.gate) if edge.gate else None,
            cuts=edge.cuts if to == "skill" else 0.0,
        )
        for edge, (to, target) in zip(owner.edges, sent, strict=True)
    )
    return Skill(name, owner.function, inputs, edges, like=owner.name, chooses=owner.chooses)


def doubling(levels: int, last: tuple[Edge, ...], value: float = 1.0) -> tuple[Skill, ...]:
    """Pairs of rules that both influence both of the next pair, so that influence doubles; the last pair sends `last`.

    At 129 levels and more a float32 does not hold it.
    """
    first = tuple(Edge("skill", target, None, (("number", value),)) for target in (1, 2))
    skills = [Skill("S0", Rule(), (), first)]
    for level in range(levels):
        below = tuple(Edge("skill", 2 * level + side, None, (("number", 1.0),)) for side in (3, 4))
        edges = below if level < levels - 1 else last
        skills += [Skill(f"S{2 * level + side}", Rule(), (), edges) for side in (1, 2)]
    return tuple(skills)


@st.composite
def overflowing_graph(draw: st.DrawFn) -> Graph:
    """A hierarchy in which influence overflows, or nearly does; what it sends last may be 0, where inf becomes NaN."""
    ends = [("actuator", i) for i in range(len(ACTUATORS))] + [("memory", 0)]
    chosen = draw(st.lists(st.sampled_from(ends), unique=True, min_size=1))
    last = tuple(Edge(to, i, None, (("number", draw(st.sampled_from([0.0, 0.3, 1.0]))),)) for to, i in chosen)
    top = draw(st.sampled_from([1.0, 0.3, 0.001]))
    skills = doubling(draw(st.integers(125, 140)), last, top)
    last_pair = len(skills)
    under = Skill("Under", Rule(), (), (Edge("actuator", 0, None, (("number", 0.5),)),))
    passing = (Edge("skill", last_pair, None, (("number", draw(st.sampled_from([0.0, 1.0]))),)),)
    skills = (*skills[:-1], Skill(skills[-1].name, Rule(), (), (*skills[-1].edges, *passing)), under)
    actuators = tuple(Actuator(f"a{i}", kind) for i, kind in enumerate(ACTUATORS))
    return Graph(1 / 60, Disc(), "S0", (), (Memory("m0", Cell(0.5, 0.5), 0),), actuators, skills, (), ())


@st.composite
def random_case(draw: st.DrawFn, ticks: int = 6) -> Case:
    """A hierarchy, weights that may be huge, and readings that may be anything."""
    graph = draw(overflowing_graph() if draw(st.integers(0, 15)) == 0 else random_graph())
    rng = np.random.default_rng(draw(st.integers(0, 2**32 - 1)))
    # more often above zero than below: most skills then have influence
    own = [skill for skill in graph.skills if not skill.like]
    weights = {skill.name: draw(st.sampled_from(SCALES)) * rng.uniform(-0.7, 1, genes(skill)) for skill in own}
    readings = rng.random((ticks, graph.width), np.float32)
    if draw(st.booleans()):
        readings = (readings / 8 - np.float32(1 / 16)) % 1  # about where directions begin anew
    for _ in range(draw(st.integers(0, 6))):
        place = draw(st.tuples(st.integers(0, ticks - 1), st.integers(0, max(graph.width - 1, 0))))
        readings[place] = draw(st.sampled_from([np.nan, np.inf, -np.inf, -0.0, 0.0, 1.0, 7.0, -3.0, 3e38, 1e-42]))
    return Case(graph, {name: values.astype(np.float32) for name, values in weights.items()}, readings)


@st.composite
def physical_kinds(draw: st.DrawFn) -> SensorKind:
    """A kind of sensor that measures something, perfectly or not, or that somebody says."""
    kind = draw(st.sampled_from(WORLDLY))
    return replace(kind, **draw(ROUGH)) if isinstance(kind, Physical) and draw(st.booleans()) else kind


RECKONED = st.builds(
    Bearing, st.just(""), st.sampled_from([0.0, 0.3, 9.0]), st.sampled_from([0.0, 0.1]), is_reckoned=st.just(True)
) | st.builds(Distance, st.just(""), st.sampled_from([0.3, 40.0]), is_reckoned=st.just(True))


def memory_kinds(first: int) -> st.SearchStrategy[MemoryKind]:
    """A kind of memory; a place is reckoned by the sensors of the numbers `first` to `first` + 2."""
    by = [f"s{first + k}" for k in range(3)]
    return st.one_of(
        st.builds(Cell, SHARES, SHARES),
        st.builds(Register, SHARES),
        st.builds(Counter, SHARES),
        st.builds(Place, *map(st.just, by), st.sampled_from([0.5, 100.0])),
    )


@st.composite
def _senses(draw: st.DrawFn) -> tuple[tuple[Sensor, ...], tuple[Memory, ...]]:
    """Sensors and memories; derivatives of anything, and of one another."""
    kinds = draw(st.lists(physical_kinds() | physical_kinds() | VIRTUAL, min_size=2, max_size=7))
    kept = draw(st.lists(memory_kinds(len(kinds)), max_size=2))
    if places := [f"m{i}" for i, kind in enumerate(kept) if kind.is_place]:
        kinds += [Odometer("left", range=draw(st.sampled_from([1.0, 5000.0]))), Odometer("right"), Compass()]
        kinds += [replace(each, of=draw(st.sampled_from(places))) for each in draw(st.lists(RECKONED, max_size=2))]
    widths = {f"m{i}": kind.width for i, kind in enumerate(kept)}
    sensors: list[Sensor] = []
    start = 0
    for number, kind in enumerate(kinds):
        width = prod(getattr(kind, "shape", ()))
        if isinstance(kind, str):
            width, kind = draw(virtual_kinds(kind, widths, {sensor.name: sensor.kind for sensor in sensors}))
        sensors.append(Sensor(f"s{number}", kind, start, width))
        widths[f"s{number}"] = width
        start += width
    order = draw(st.permutations(range(len(sensors))))  # a derivative may stand before its source
    begins = np.cumsum([start, *(kind.kept for kind in kept)]).tolist()
    return _placed([sensors[i] for i in order]), tuple(
        Memory(f"m{i}", kind, begin) for i, (kind, begin) in enumerate(zip(kept, begins, strict=False))
    )


def has_mirror(of: str, widths: Mapping[str, int], known: Mapping[str, SensorKind]) -> bool:
    """True if a sensor may be mirrored."""
    return not (Mirrored(of).flaw(widths, directions(known)) or Mirrored(of).misfit(known))


@st.composite
def virtual_kinds(
    draw: st.DrawFn, kind: str, widths: dict[str, int], known: Mapping[str, SensorKind]
) -> tuple[int, SensorKind]:
    """A sensor that is computed, and how many readings it has; of a source, where there is one.

    It is often of a direction.
    """
    around = directions(known)
    if kind == "clock":
        return 1, Clock(draw(st.sampled_from([0.05, 0.3, 2.0])))
    if kind == "sine" or not widths:
        return 1, Sine(draw(st.sampled_from([0.05, 0.3, 2.0])))
    of = draw(st.sampled_from([*sorted(widths), *3 * sorted(around)]))
    match kind:
        case "derivative":
            return widths[of], Derivative(of, draw(st.sampled_from([0.5, 1.0, 30.0])), draw(_dead_zones))
        case "latch":
            return widths[of], Latch(of, *sorted(draw(st.tuples(SHARES, SHARES))))
        case "average":
            return widths[of], Average(of, draw(st.integers(1, 5)))
        case "turned" if around:
            return 1, Turned(draw(st.sampled_from(sorted(around))), draw(st.sampled_from([pi, -1.0, 7.5])))
        case "mirrored" if alike := [of for of in sorted(widths) if has_mirror(of, widths, known)]:
            of = draw(st.sampled_from(alike))
            return widths[of], Mirrored(of)
        case "reading":
            of = draw(st.sampled_from([name for name, width in sorted(widths.items()) if width > 1] or [of]))
            return 1, Reading(draw(st.integers(1, widths[of])), of)
    single = [name for name, width in widths.items() if width == 1]
    if (turning := sorted({*single} & {*around})) and draw(st.booleans()):
        name, more = draw(st.sampled_from(turning)), draw(st.sampled_from([-1.25, -0.5, 0.0, 0.1, 2.0]))
        terms = (("reading", name), ("number", more))
        return 1, Computed((*(terms[::-1] if more > 0 else terms), ("-" if more == 0.1 else "+", 0)))
    sides = programs(tuple(range(len(single))))
    if kind == "broken":
        program = draw(conditions(sides))
        formula = tuple((word, single[int(x)] if word == "reading" else x) for word, x in program)
        return 1, Broken(draw(st.sampled_from(["S0", "S1"])), formula)
    numbered = draw(sides)
    if draw(st.integers(0, 2)) == 0:
        numbered = (*numbered, *draw(conditions(sides)), ("when", 0), *draw(sides), ("otherwise", 0))
    return 1, Computed(tuple((word, single[int(x)] if word == "reading" else x) for word, x in numbered))


_dead_zones = st.sampled_from([0.0, 0.0, 0.01, 0.4])


def _placed(sensors: list[Sensor]) -> tuple[Sensor, ...]:
    starts = np.cumsum([0, *(sensor.width for sensor in sensors)]).tolist()
    return tuple(Sensor(s.name, s.kind, start, s.width) for s, start in zip(sensors, starts, strict=False))


def networks(fewest: int) -> st.SearchStrategy[Function]:
    """A function of any kind that learns, with so many hidden layers at least where it can have several."""
    said = {
        "hidden": st.integers(fewest, 3),
        "width": st.sampled_from([0, 0, 1, 5, 17]),
        "bias": st.integers(0, 1),
        "centred": st.integers(0, 1),
        "most": st.integers(0, 6),
        "links": st.sampled_from(["any", "forward"]),
    }
    learning = [cls for cls in kinds("skill").values() if cls.learns]
    return st.one_of(st.builds(cls, **{each.field: said[each.field] for each in arguments(cls)}) for cls in learning)


@st.composite
def _skills(draw: st.DrawFn, name: str, width: int, targets: list[tuple[str, int]], fewest: int) -> Skill:
    """A skill over some of the readings that sends to some of the targets."""
    function: Function = draw(networks(fewest) | networks(fewest) | st.sampled_from([Rule(), CALLED]))
    inputs = tuple(draw(st.lists(st.integers(0, width - 1), unique=True, max_size=16)))
    chosen = draw(st.lists(st.sampled_from(targets), unique=True, min_size=1, max_size=5))
    edges: list[Edge] = []
    outputs = 0
    for to, target in chosen:
        if isinstance(function, Rule) or draw(st.integers(0, 3)) == 0:
            edge = Edge(to, target, None, draw(programs(inputs)))
        else:
            edge = Edge(to, target, outputs)
            outputs += 1
        gate = draw(_gates(inputs)) if draw(st.integers(0, 3)) == 0 else None
        cuts = draw(st.sampled_from([0.0, 0.05, 0.5])) if to == "skill" else 0.0
        sinks = [target for target in targets if target[0] != "skill"]
        over = (
            draw(st.sets(st.sampled_from(sinks), max_size=2)) if to == "skill" and draw(st.integers(0, 4)) == 0 else ()
        )
        edges.append(replace(edge, gate=gate, cuts=cuts, over=tuple(sorted(over))))
    called = Procedure(f"own.send{outputs}") if function is CALLED else function
    chooses = any(edge.to == "skill" for edge in edges) and draw(st.integers(0, 3)) == 0
    promises = tuple(draw(st.lists(_promises(range(width)), max_size=2)) if draw(st.integers(0, 7)) == 0 else ())
    frozen = draw(st.booleans())
    return Skill(name, called, inputs, tuple(edges), frozen, chooses=chooses, promises=promises)


@st.composite
def _promises(draw: st.DrawFn, readings: range) -> Promise:
    """Something that a skill promises of any readings."""
    word = draw(st.sampled_from(["requires", "maintains", "achieves"]))
    compare = draw(st.sampled_from(["<", ">="]))
    return Promise(word, f"{word} it", (("reading", draw(st.sampled_from(readings))), ("number", 0.4), (compare, 0)))


@st.composite
def _gates(draw: st.DrawFn, inputs: tuple[int, ...]) -> Gate:
    """A gate over a skill's inputs; often its condition holds."""
    return Gate(draw(conditions(programs(inputs))), draw(st.none() | programs(inputs)))


@st.composite
def conditions(draw: st.DrawFn, sides: st.SearchStrategy[Program]) -> Program:
    """Comparisons joined with `and` and `or`."""
    found: Program = ()
    for number in range(draw(st.integers(1, 3))):
        comparison = draw(st.sampled_from(["<", "<=", ">", ">="]))
        found = (*found, *draw(sides), *draw(sides), (comparison, 0))
        found = (*found, (draw(st.sampled_from(["and", "or"])), 0)) if number else found
    return found


def programs(inputs: tuple[int, ...]) -> st.SearchStrategy[Program]:
    """An expression over a skill's inputs, in postfix order."""
    number = st.sampled_from([0.0, 0.1, 0.25, 1.0, 2.0, 3.5]).map(lambda x: (("number", x),))
    return combined(number | st.sampled_from(inputs).map(lambda i: (("reading", i),)) if inputs else number, 5)


def combined(leaves: st.SearchStrategy[Program], most: int) -> st.SearchStrategy[Program]:
    """Expressions of so many leaves."""
    operators = st.sampled_from(["+", "-", "*", "/", "least", "greatest"])
    return st.recursive(
        leaves,
        lambda part: st.one_of(
            st.tuples(part, part, operators).map(lambda p: (*p[0], *p[1], (p[2], 0))),
            part.map(lambda p: (*p, ("negate", 0))),
        ),
        max_leaves=most,
    )
