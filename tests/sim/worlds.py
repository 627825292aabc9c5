"""Hypothesis strategies for whole worlds: any hierarchy in any body, among anything, judged in any way."""

from dataclasses import fields, replace
from itertools import permutations
from math import pi
from typing import Any, get_args

from hypothesis import strategies as st
from mindrun.graph.draws import Draw, ends_of, intervals_of
from mindrun.graph.graph import (
    Actuator,
    End,
    Failure,
    Graph,
    Lesson,
    Program,
    Reward,
    Start,
    Tally,
    Task,
    Thing,
    Variation,
)
from mindrun.graph.weights import genes
from mindrun.kinds.actuators.actuator import Gripper, Lamp, Motor, Servo, Signal, Steering, Thruster, Wheel
from mindrun.kinds.bodies.body import Box, Car, Disc, Holonomic
from mindrun.kinds.events.event import Collision, Delivery, EventKind, Exhaustion, Leave, Reach, Success, Visit, Within
from mindrun.kinds.learners import Learner
from mindrun.kinds.measures.measure import Advance, Apart, CommandChange, Forward, MeasureKind, Progress, Retreat, Time
from mindrun.kinds.registry import arguments, kinds
from mindrun.kinds.scenes.scene import Arena, Plain, SceneKind
from mindrun.kinds.things.loose import Ball, LooseBox
from mindrun.kinds.things.map import Map
from mindrun.kinds.things.obstacle import Obstacle
from mindrun.kinds.things.slope import Slope
from mindrun.kinds.things.thing import Item, Power, Zone
from mindrun.kinds.things.walker import Begin, Walker
from mindrun.kinds.things.wall import Wall
from mindrun.numbers.quantity import FARTHEST_UNITS, UNSAID, Span

from tests.hierarchies import combined, conditions, on_servos, random_graph
from tests.sim.drawn_teams import teams

SIZES = st.sampled_from([Span(1.0, 1.0), Span(2.0, 5.0), Span(4.0, 1.0, 0.75), Span(1.0, 3.0, 0.75)])
WIDE = st.sampled_from([Span(8.0, 8.0), Span(4.0, 12.0), Span(14.0, 6.0, 2.0)])
APART = [
    ("object", Item, SIZES), ("home", Zone, WIDE), ("coin", Item, SIZES), ("plug", Power, WIDE), ("den", Zone, WIDE),
    ("crate", LooseBox, SIZES), ("ball", Ball, SIZES), ("cat", Walker, SIZES), ("ramp", Slope, WIDE),
]  # fmt: skip
FACINGS, PULLS = st.sampled_from([0.0, -pi / 2, 0.7]), st.sampled_from([0.0, 40.0, 300.0])
AWAY = st.sampled_from([Span(-1.0, -1.0), Span(0.0, 3.0), Span(0.0, 6.0), Span(2.0, 12.0)])
PLACES = st.tuples(st.sampled_from([-6.0, 0.0, 4.5]), st.sampled_from([-4.0, 0.5, 3.0]))
WAYS = [((-9.0, -5.0), (-2.0, -5.0)), ((6.0, 6.0), (6.0, -3.0), (9.5, -3.0)), ((3.0, 7.0), (-3.0, 7.0))]
PATHS = [((-5.0, 0.0), (5.0, 2.0)), ((0.0, 0.0), (3.0, 0.0), (3.0, -6.0))]
DRAWS = st.sampled_from([
    Draw("side", (-4.0, 3.0)), Draw("side", (1.0, 5.0, -2.5)), Draw("far", (-6.0, 6.0), True), Draw("far", (2.0,)),
    Draw("many", (2.0, 0.0, 3.0)),
])  # fmt: skip
SPEEDS, TURNINGS = st.sampled_from([0.5, 3.0, 20.0, 300.0]), st.sampled_from([0.0, 1.5, 10.0])
FORCES = st.sampled_from([80.0, 80.0, 2.0, 3000.0])  # by which a loose thing drives itself
NOTICED = st.sampled_from([FARTHEST_UNITS, FARTHEST_UNITS, 0.5, 6.0])  # from how far away something seeks or flees
MAZES = [("#..#", "....", "##.."), ("#.#", "...", "###", "..#")]
SOON = st.sampled_from([1, 1, 3, 12])  # ticks within which an event comes after another
NEUTRAL = st.sampled_from([0.0, 0.4, 0.5, 0.9, 1.0])
OUTCOMES = st.sampled_from(["stays", "moves", "moves", "vanishes"])
DENSITY, FRICTION, DAMPING = st.sampled_from([0.1, 0.5]), st.sampled_from([0.0, 0.5, 1.0]), st.sampled_from([0.0, 5.0])
DELAY = st.sampled_from([0, 0, 1, 2, 5])
THRUST = st.sampled_from([80.0, 80.0, 200.0, 3000.0, 15.0, -60.0])
STARTS = st.sampled_from([0.0, 0.0, 0.3, 0.9])
NOISE, SLIP = st.sampled_from([0.0, 0.0, 0.1]), st.sampled_from([0.0, 0.0, 0.3])
PUSHING = {"thrust": THRUST, "delay": DELAY, "noise": NOISE, "slip": SLIP}
WHEELS = st.builds(Wheel, st.sampled_from(["left", "right"]), NEUTRAL, starts=STARTS, **PUSHING)
MOTORS = st.builds(Motor, NEUTRAL, starts=STARTS, **PUSHING)
STEERINGS = st.builds(Steering, NEUTRAL, st.sampled_from([0.5, 1.2, 0.0]), DELAY, NOISE)
THRUSTERS = st.builds(
    Thruster,
    NEUTRAL,
    st.sampled_from([(0.0, 0.0), (0.0, -1.0), (-0.5, 1.0), (1.0, 0.0)]),
    st.sampled_from([0.0, 1.0, -pi / 2, 4.0]),
    **PUSHING,
)
CLAWS = st.builds(Gripper, st.sampled_from([0.0, 0.5, 0.9, 1.0]), st.sampled_from([1.5, 4.0]), DELAY, NOISE)
SERVOS = st.builds(Servo, NEUTRAL, DELAY, st.sampled_from([pi / 2, 0.0, 3.0]), st.sampled_from([2 * pi, 0.1, 0.5]))
OTHERS = CLAWS | SERVOS | st.builds(Lamp, NEUTRAL, DELAY) | st.builds(Signal, NEUTRAL, DELAY)
RANGES = {  # of what varies
    "thrust": st.sampled_from([(60.0, 200.0), (-50.0, 15.0), (80.0, 80.0)]),
    "delay": st.sampled_from([(0.0, 3.0), (2.0, 2.0), (1.0, 6.0)]),
    "noise": st.sampled_from([(0.0, 0.1), (0.05, 0.3)]),
    "slip": st.sampled_from([(0.0, 0.5), (0.2, 0.3)]),
    "starts": st.sampled_from([(0.0, 0.6), (0.2, 0.3)]),
    "lost": st.sampled_from([(0.0, 0.5), (0.9, 1.0)]),
    "range": st.just((0.2, 1.2)),
    "density": st.sampled_from([(0.1, 3.0), (1.0, 1.5)]),
    "friction": st.sampled_from([(0.0, 1.0), (0.3, 0.3)]),
    "damping": st.just((0.0, 9.0)),
    "speed": st.sampled_from([(0.5, 6.0), (3.0, 3.0)]),
    "turning": st.just((0.0, 10.0)),
    "linear_damping": st.just((0.0, 9.0)),
    "angular_damping": st.just((1.0, 30.0)),
}
FORCED = st.sampled_from([(2.0, 200.0), (80.0, 80.0)])
DIAMETERS = st.sampled_from([2.0, 2.0, 0.7, 3.0])
RECTANGLES = st.sampled_from([2.0, (3.0, 2.0), (1.0, 2.5), (4.0, 1.0)])
MATERIAL = {
    "density": st.sampled_from([2.0, 0.5]),
    "friction": st.sampled_from([0.2, 0.2, 0.0, 1.5]),
    "linear_damping": st.sampled_from([5.0, 0.0]),
    "angular_damping": st.sampled_from([20.0, 1.0]),
}
DRIVES = {
    st.builds(Disc, DIAMETERS, **MATERIAL): WHEELS | WHEELS | THRUSTERS,
    st.builds(Box, RECTANGLES, **MATERIAL): WHEELS | WHEELS | THRUSTERS,
    st.builds(Car, RECTANGLES, st.sampled_from([0.6, 0.3]), **MATERIAL): MOTORS | STEERINGS,
    st.builds(Holonomic, DIAMETERS, **MATERIAL): THRUSTERS,
}


def robot_kinds() -> st.SearchStrategy[object]:
    """Any body, or any actuator."""
    return st.one_of(OTHERS, *DRIVES, *DRIVES.values())


@st.composite
def _robots(draw: st.DrawFn, graph: Graph) -> Graph:
    """A graph with any body, and on it actuators that can move it; others now and then."""
    bodies, drives = draw(st.sampled_from([*DRIVES.items(), *[*DRIVES.items()][:1] * 2]))
    actuators = tuple(Actuator(a.name, draw(drives | drives | OTHERS)) for a in graph.actuators)
    sensors = draw(on_servos(graph.sensors, actuators))
    return replace(graph, body=draw(bodies), actuators=actuators, sensors=sensors)


@st.composite
def random_world(draw: st.DrawFn, most: int = 40, team: bool = False) -> Graph:
    """A hierarchy with one task, World, in which what may happen happens often; with `team` perhaps other robots."""
    graph = draw(random_graph())
    graph = replace(draw(_robots(graph)), tick=draw(st.sampled_from([1 / 60, 1 / 30, 0.1])))
    scene: SceneKind = draw(st.sampled_from([Plain(), Arena(20.0), Arena(33.0), Arena((26.0, 15.0))]))
    draws = tuple(draw(st.lists(DRAWS, max_size=2, unique_by=lambda drawn: drawn.name)))
    others = draw(teams([skill.name for skill in graph.skills])) if team else []
    things = draw(_things(scene, draws, others))
    graph = draw(_about_several(graph, things))
    measures, events = draw(_measures(things)), draw(_events(scene, things))
    tallies = tuple(
        draw(_tallies(graph, len(measures), events, len(draws), earlier)) for earlier in range(draw(st.integers(0, 3)))
    )
    seen = len(measures), len(draws), len(tallies)
    rewards = tuple(draw(_rewards(graph, len(events), *seen)) for _ in range(draw(st.integers(1, 4))))
    some = st.lists(st.sampled_from(range(len(events))), unique=True, max_size=3) if events else st.just([])
    ticks = draw(st.integers(1, most))
    ends = tuple(draw(st.lists(_ends(graph, events, things, *seen), max_size=3)))
    task = Task(
        "World",
        scene,
        things,
        ticks,
        measures,
        events,
        ends,
        rewards,
        tuple(draw(some)),
        draw(st.sampled_from([Start(), Start(), Start((2.0, -1.0)), Start(None, 1.0), Start((0.0, 0.5), -3.0)])),
        draws=draws,
        tallies=tallies,
    )
    task = replace(task, varies=draw(_variations(graph, task)), fails=draw(_failures(graph)))
    return replace(graph, tasks=(task,), lessons=tuple(draw(_lessons(graph))))


@st.composite
def _about_several(draw: st.DrawFn, graph: Graph, things: tuple[Thing, ...]) -> Graph:
    """A graph some of whose sensors are about several things that stand side by side, and some that are not there."""
    apart, sensors = [thing for thing in things if not thing.kind.is_obstacle], []
    absent = sorted({name for name, _, _ in APART}.difference(thing.name for thing in apart))
    for sensor in graph.sensors:
        kind: Any = sensor.kind
        fits = {thing.name: kind.is_about(type(thing.kind)) for thing in apart} | dict.fromkeys(absent, True)
        if fits.get(kind.thing) and draw(st.booleans()):
            first, most = draw(st.integers(0, len(apart))), draw(st.integers(1, 4))
            standing = [thing.name for thing in apart[first : first + most]]
            several = standing[: next((k for k, name in enumerate(standing) if not fits[name]), most)]
            several += draw(st.lists(st.sampled_from(absent), unique=True, max_size=2)) if absent else []
            kind = replace(kind, of=" or ".join(draw(st.permutations(several or [kind.thing]))))
        sensors.append(replace(sensor, kind=kind))
    return replace(graph, sensors=tuple(sensors))


@st.composite
def _variations(draw: st.DrawFn, graph: Graph, task: Task) -> tuple[Variation, ...]:
    """Up to four arguments of anything, each in a range; most often none."""
    kinds = [("body", "", graph.body), *(("actuator", each.name, each.kind) for each in graph.actuators)]
    kinds += [("sensor", each.name, each.kind) for each in graph.sensors]
    kinds += [("thing", each.name, each.kind) for each in task.things]
    known = [(noun, name, argument) for noun, name, kind in kinds for argument in kind.varying]
    some = draw(st.lists(st.sampled_from(known), unique=True, max_size=4)) if draw(st.booleans()) else []
    ranges = [FORCED if noun == "thing" and key == "thrust" else RANGES[key] for noun, _, key in some]
    return tuple(Variation(*about, *draw(of)) for about, of in zip(some, ranges, strict=True))


@st.composite
def _failures(draw: st.DrawFn, graph: Graph) -> tuple[Failure, ...]:
    """Actuators that fail soon; most often none."""
    names = [actuator.name for actuator in graph.actuators]
    some = draw(st.lists(st.sampled_from(names), unique=True, max_size=2)) if names and draw(st.booleans()) else []
    return tuple(Failure(name, draw(st.sampled_from([0.02, 0.2, 1.0, 0.0]))) for name in some)


def _lessons(graph: Graph) -> st.SearchStrategy[list[Lesson]]:
    """Lessons of skills that learn."""
    names = [skill.name for skill in graph.skills if genes(skill) and not skill.like]
    lesson = st.builds(
        Lesson, st.just("School"), st.sampled_from(names), st.just("World"), st.just(graph.master), st.integers(1, 9),
        st.booleans(), st.booleans(), learner_kinds(), st.integers(1, 9),
    )  # fmt: skip
    return st.lists(lesson, max_size=2) if names else st.just([])


@st.composite
def learner_kinds(draw: st.DrawFn) -> Learner:
    """A learner some of whose arguments are a little more than by default, or less where that is the most."""
    of = draw(st.sampled_from([*kinds("curriculum").values()]))
    steps = {each.field: 1 if isinstance(each.default, int) else 0.01 for each in arguments(of)}
    more = {
        each.field: each.default + steps[each.field] * (-1 if each.default == each.type.high else 1)
        for each in arguments(of)
    }
    return of(**{field: more[field] for field in draw(st.sets(st.sampled_from([*more])))})


@st.composite
def _goings(draw: st.DrawFn, placed: dict[str, Any], names: list[str]) -> dict[str, Any]:
    """How a walker goes: along ways, after one of these names or away from it, or anywhere from where it is placed."""
    match draw(st.sampled_from(["along", "ways", "seeks", "flees", ""])):
        case "along":
            return {"along": draw(st.sampled_from(PATHS)), "count": draw(st.sampled_from([1, 2]))}
        case "ways":
            ways = ((PATHS[0],), (), (WAYS[1], PATHS[1]))
            begins = {"or_": draw(st.sampled_from(ways)), "from_": draw(st.sampled_from(get_args(Begin)))}
            return {"along": draw(st.sampled_from(PATHS)), "count": draw(st.sampled_from([1, 2])), **begins}
        case "":
            return placed
        case aim:
            return {**placed, aim: draw(st.sampled_from(names)), "range": draw(NOTICED)}


@st.composite
def _drives(draw: st.DrawFn, names: list[str]) -> dict[str, Any]:
    """How a loose thing drives itself."""
    aim = draw(st.sampled_from(["seeks", "flees"]))
    return {aim: draw(st.sampled_from(names)), "speed": draw(SPEEDS), "thrust": draw(FORCES), "range": draw(NOTICED)}


@st.composite
def _things(draw: st.DrawFn, scene: SceneKind, draws: tuple[Draw, ...], team: list[Thing]) -> tuple[Thing, ...]:
    """Items, zones and powers, some of them not there; obstacles on a grid or loose; and others."""
    things: list[Thing] = []
    for name, kind, size in APART:
        if draw(st.integers(0, 2)):
            outcomes = {field.name: draw(OUTCOMES) for field in fields(kind) if field.name in ("reached", "delivered")}
            own = {"density": DENSITY, "friction": FRICTION, "damping": DAMPING} if kind.is_loose else {}
            own = {"speed": SPEEDS, "turning": TURNINGS} if kind is Walker else own
            own = {"facing": FACINGS, "slides": SPEEDS, "pull": PULLS} if kind is Slope else own
            drawn = {name: draw(of) for name, of in own.items()}
            at = draw(st.none() | st.none() | PLACES)
            at = (at,) if at else ()
            count = 1 if at else draw(st.sampled_from([1, 1, 2, 3]))
            placed = {"away": UNSAID if at else draw(AWAY), "at": at, "count": count}
            if draw(st.integers(0, 3)) == 0:
                zones = [each.name for each in things if each.kind.is_area and not each.kind.within]
                regions = st.sampled_from([*zones, ((-5.0, -4.0), (4.0, 4.0)), ((-6.0, 2.0), (6.0, 2.0))])
                placed = {"within": draw(regions), "away": draw(AWAY), "count": count}
            elif at and draw(st.booleans()):
                others = draw(st.lists(PLACES, min_size=1, max_size=3))
                placed |= {"or_": tuple((place,) for place in others), "count": draw(st.sampled_from([1, 2]))}
            if kind.is_loose and draw(st.booleans()):
                placed |= draw(_drives(["robot", name, *(thing.name for thing in things)]))
            if kind is Walker:
                placed = draw(_goings(placed, ["robot", "cat", *(thing.name for thing in things)]))
                if "from_" in placed and outcomes["reached"] == "moves":
                    outcomes["reached"] = "stays"  # which way it is on, nobody else knows when it has moved
            made = kind(size=draw(size), **placed, **outcomes, **drawn)
            has_room = not made.within or made.mistake(scene) is None
            things.append(Thing(name, made if has_room else replace(made, within=""), draw(_presence(draws))))
    things += [replace(each, when=draw(_presence(draws))) for each in draw(_obstacles(scene))]
    things += team
    return tuple(draw(_drawn_places(draw(_counted(each, draws)), draws)) for each in draw(st.permutations(things)))


@st.composite
def _obstacles(draw: st.DrawFn, scene: SceneKind) -> list[Thing]:
    """What stands in the way: obstacles on a grid, loose or in places, a maze and a fence, each now and then."""
    things: list[Thing] = []
    grid = isinstance(scene, Arena) and draw(st.booleans())
    sizes = draw(st.sampled_from([Span(1.0, 1.0), Span(1.0, 3.0)]))
    if grid:
        things.append(
            Thing("rock", Obstacle(sizes, draw(st.sampled_from([7.0, 11.0])), draw(st.sampled_from([0.0, 1.5]))))
        )
    if draw(st.booleans()):
        things.append(Thing("stone", Obstacle(sizes, count=draw(st.integers(0, 5)), away=draw(AWAY))))
    if draw(st.booleans()):
        others = tuple((place,) for place in draw(st.lists(PLACES, max_size=2)))
        jitter = draw(st.sampled_from([0.0, 1.5]))
        things.append(Thing("block", Obstacle(sizes, at=(draw(PLACES),), or_=others, jitter=jitter)))
    if draw(st.integers(0, 3)) == 0:
        things.append(Thing("maze", Map(draw(st.sampled_from(MAZES)), draw(st.sampled_from([2.0, 3.5])))))
    if draw(st.booleans()):
        things.append(Thing("fence", Wall(draw(st.sampled_from(WAYS)), draw(st.sampled_from([1.0, 0.5, 2.5, 0.05])))))
    return things


def _presence(draws: tuple[Draw, ...]) -> st.SearchStrategy[Program]:
    """A condition of what is drawn under which a thing is there; most often none."""
    leaves = [st.sampled_from([0.0, 3.0]).map(lambda x: (("number", x),))]
    leaves += [st.integers(0, len(draws) - 1).map(lambda i: (("drawn", i),))]
    return st.just(()) | st.just(()) | conditions(combined(st.one_of(leaves), 2)) if draws else st.just(())


@st.composite
def _drawn_places(draw: st.DrawFn, thing: Thing, draws: tuple[Draw, ...]) -> Thing:
    """A thing, now and then one that stands at a single place at what is drawn."""
    kind: Any = thing.kind
    along = getattr(kind, "along", ())
    if not draws or not (along or len(kind.at) == 1) or kind.or_ or draw(st.booleans()):
        return thing
    drawn = st.integers(0, len(draws) - 1).map(lambda i: (("drawn", i),))
    number = st.sampled_from([0.5, -2.0, 3.0]).map(lambda x: (("number", x),))

    def coordinates(at: float) -> st.SearchStrategy[Program]:
        """Some that are in the arena whatever is drawn."""
        near = combined(drawn | number, 3).filter(
            lambda program: all(abs(end) <= 7 for _, ends in intervals_of(program, draws) for end in ends)
        )
        return st.just((("number", at),)) | drawn | near

    by = tuple(draw(coordinates(x)) for at in along or kind.at for x in at)
    ends = (tuple(zip(end[::2], end[1::2], strict=True)) for end in ends_of(by, draws))
    first, *others = ends
    made = replace(kind, **{"along" if along else "at": first}, or_=tuple(others))
    return replace(thing, kind=made, by=by) if made.mistake(None) is None else thing


@st.composite
def _counted(draw: st.DrawFn, thing: Thing, draws: tuple[Draw, ...]) -> Thing:
    """A thing, now and then one of which there are as many as are drawn."""
    kind: Any = thing.kind
    counts = [number for number, each in enumerate(draws, 1) if each.is_count]
    is_countable = getattr(kind, "count", 0) > 1 and not (kind.spots or kind.is_robot)
    if not (counts and is_countable and draw(st.booleans())):
        return thing
    many = draw(st.sampled_from(counts))
    return replace(thing, kind=replace(kind, count=int(draws[many - 1].interval[1])), many=many)


@st.composite
def _measures(draw: st.DrawFn, things: tuple[Thing, ...]) -> tuple[MeasureKind, ...]:
    named = [thing.name for thing in things if not thing.kind.is_obstacle]
    measures: list[MeasureKind] = [Forward(), CommandChange("thrust", 0.2, 4), CommandChange("thrust", 0.0, 1), Time()]
    for name in named:
        measures += [Progress(name), Advance(name), Retreat(name), Apart(name)]
    between = [kind(to, of) for kind in (Progress, Advance, Retreat, Apart) for to, of in permutations(named, 2)]
    some = draw(st.lists(st.sampled_from(measures), unique=True, min_size=1, max_size=3))
    return (*some, *(draw(st.lists(st.sampled_from(between), unique=True, max_size=2)) if between else ()))


@st.composite
def _events(draw: st.DrawFn, scene: SceneKind, things: tuple[Thing, ...]) -> tuple[EventKind, ...]:
    events: list[EventKind] = [Collision(), Exhaustion(), Success()]
    crossing: list[EventKind] = []
    for thing in things:
        if not thing.kind.is_obstacle:
            events.append(Reach(thing.name))
            movers = [each.name for each in things if Reach.accepts("by", each.kind) and each is not thing]
            crossing += [Reach(thing.name, by) for by in movers]
            crossing += [Leave(thing.name, by) for by in ("", *movers) if thing.kind.is_area]
        if thing.kind.is_robot:
            events.append(Collision(thing.name))
        if isinstance(thing.kind, Item | LooseBox | Ball):
            events.append(Delivery(thing.name))
            events += [Delivery(thing.name, zone.name) for zone in things if isinstance(zone.kind, Zone)]
    if isinstance(scene, Arena):
        events += [Visit("patch", 2.0), Visit("patch", 7.0)]
    some = draw(st.lists(st.sampled_from(events), unique=True, max_size=4))
    some += draw(st.lists(st.sampled_from(crossing), unique=True, max_size=2)) if crossing else []
    pairs = [(event, other) for event, other in permutations(some, 2) if not other.is_of_success]
    soon = draw(st.lists(st.tuples(st.sampled_from(pairs), SOON), max_size=2)) if pairs else []
    return tuple(dict.fromkeys([*some, *(replace(each, within=Within(n, other)) for (each, other), n in soon)]))


@st.composite
def _ends(
    draw: st.DrawFn,
    graph: Graph,
    events: tuple[EventKind, ...],
    things: tuple[Thing, ...],
    measures: int,
    draws: int,
    tallies: int,
) -> End:
    """An event, the first time or later, or a condition; a success or not, or what opens something."""
    happening = [number for number, event in enumerate(events) if not event.is_of_success]
    opens = draw(st.sampled_from(["", *2 * [each.name for each in things if each.kind.is_obstacle]]))
    succeeds = not opens and draw(st.booleans())
    if happening and draw(st.booleans()):
        return End(draw(st.sampled_from(happening)), draw(st.integers(1, 3)), None, succeeds, opens=opens)
    programs = _programs(graph.width, measures, len(graph.actuators), False, draws, tallies)
    return End(None, 1, draw(conditions(programs)), succeeds, "it is so", opens)


@st.composite
def _tallies(
    draw: st.DrawFn, graph: Graph, measures: int, events: tuple[EventKind, ...], draws: int, earlier: int
) -> Tally:
    """How often an event has happened, or a condition held, or for how long, perhaps while a tally before it is so."""
    happening = [number for number, event in enumerate(events) if not event.is_of_success]
    programs = _programs(graph.width, measures, len(graph.actuators), False, draws, earlier)
    event = draw(st.sampled_from(happening)) if happening and draw(st.booleans()) else None
    when = draw(conditions(programs)) if event is None or draw(st.booleans()) else None
    value = draw(programs) if event is None and draw(st.booleans()) else None
    return Tally(event, when, event is None and value is None and draw(st.booleans()), value)


@st.composite
def _rewards(draw: st.DrawFn, graph: Graph, events: int, measures: int, draws: int, tallies: int) -> Reward:
    """An amount per tick or on an event, for each reading of a sensor or once, always or when a condition holds."""
    each = None
    if graph.sensors and draw(st.integers(0, 3)) == 0:
        sensor = draw(st.sampled_from(graph.sensors))
        each = sensor.start, sensor.width
    programs = _programs(graph.width, measures, len(graph.actuators), each is not None, draws, tallies)
    on = draw(st.integers(0, events - 1)) if events and draw(st.booleans()) else None
    when = draw(conditions(programs)) if draw(st.booleans()) else None
    return Reward("", draw(programs), on, each, when, each is None and draw(st.booleans()))


def _programs(
    readings: int, measures: int, commands: int, in_loop: bool, draws: int, tallies: int
) -> st.SearchStrategy[Program]:
    leaves = [st.sampled_from([0.0, 0.5, 1.0, -2.0]).map(lambda x: (("number", x),))]
    leaves.append(st.integers(0, measures - 1).map(lambda i: (("measure", i),)))
    leaves.append(st.integers(0, commands - 1).map(lambda i: (("command", i),)))
    if readings:
        leaves.append(st.integers(0, readings - 1).map(lambda i: (("reading", i),)))
    if draws:
        leaves.append(st.integers(0, draws - 1).map(lambda i: (("drawn", i),)))
    if tallies:
        leaves.append(st.integers(0, tallies - 1).map(lambda i: (("tally", i),)))
    if in_loop:
        leaves.append(st.just((("each", 0),)))
    return combined(st.one_of(leaves), 4)
