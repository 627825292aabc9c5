"""A run followed tick by tick: what plain Python, the engine and pymunk say of it."""

import math
from collections import Counter
from collections.abc import Mapping
from itertools import islice

import numpy as np
from mindrun.engine.engine import Engine
from mindrun.graph.draws import drawn_numbers
from mindrun.graph.graph import Graph
from mindrun.kinds.sensors.sensor import Physical
from mindrun.numbers.quantity import Region, Span
from mindrun.sim.rollout import Rollout
from mindrun.sim.trace import Moment, Trace, trace

from tests.sim.plain_sensors import ordered
from tests.sim.plain_world import OPENED, PlainWorld
from tests.sim.varied import as_drawn, of_drawn, stuck


def follow(rollout: Rollout, engine: Engine, seed: int) -> Counter[str]:
    """Hold a run against a plain world and the engine; how often each kind of event happened."""
    run = trace(rollout, seed)
    graph, task = as_drawn(rollout.graph, rollout.task, run.drawn)
    failing = stuck(rollout.task, run.drawn)
    plain = PlainWorld(graph, task, run, bool(rollout.tables.world[0]["battery"]))
    hold_draws(plain, run, seed)
    used = {int(row["start"]) for row in rollout.tables.sensors}
    counts = np.zeros(len(task.events), np.int64)
    ended = -1
    for moment in run.moments:
        assert ended < 0
        assert moment.tick == plain.t + 1
        hold_readings(plain, used, moment)
        hold_orders(graph, used, moment, seed)
        commands = plain.act(engine.tick(moment.readings))
        hold_mind(engine, used, moment)
        assert np.array_equal(commands, moment.commands)
        hold_acting(plain, moment, failing)
        plain.grip(moment.acting)
        assert plain.step(moment.acting, moment.grip) == tuple(moment.body)
        happened = plain.happened()
        assert plain.touched == moment.touching
        with np.errstate(all="ignore"):
            ended = plain.ends(happened, moment.readings)
            plain.reward(happened, moment.readings)
        assert happened == moment.events.tolist()
        assert np.array_equal(plain.lines, moment.lines, equal_nan=True)
        hold_things(plain, moment)
        counts += np.array(happened, np.int64)
    assert moment.tick == task.ticks or ended >= 0
    jobs = run.jobs
    assert (jobs.ticks[0], jobs.ended[0], jobs.faults[0]) == (moment.tick, ended, engine.faults)
    assert np.array_equal(jobs.counts[0], counts)
    total = Counter[str]()
    for happening, count in zip(task.events, counts.tolist(), strict=True):
        total[type(happening).__name__] += count
    return +total


def hold_draws(plain: PlainWorld, run: Trace, seed: int) -> None:
    """The numbers of a run follow from its seed alone; things are there, and where, as these and their kinds say."""
    task = plain.task
    drawn = run.drawn[len(run.drawn) - len(task.draws) :].tolist()
    assert drawn == [*drawn_numbers(task.draws, seed).values()]
    apart = [thing for thing in task.things if not thing.kind.is_obstacle]
    rows = iter(run.things.tolist())
    standing = {thing.name: [*islice(rows, thing.kind.copies)] for thing in apart}
    for thing in task.things:
        kind, its = thing.kind, standing.get(thing.name, [[*plain.boxes[i]] for i in plain.rows_of(thing.name)])
        is_any = not thing.when or of_drawn(thing.when, drawn) > 0
        there = [is_any and (not thing.many or copy < drawn[thing.many - 1]) for copy in range(len(its))]
        assert [math.isnan(x) or x == OPENED for x, *_ in its] == [not each for each in there]
        places = {(x, y) for (x, y, *_), is_there in zip(its, there, strict=True) if is_there}
        if thing.by and not kind.ways:
            at, jitter = [of_drawn(program, drawn) for program in thing.by], getattr(kind, "jitter", 0.0)
            assert all(math.dist(place, at) <= 2 * jitter for place in places)
        elif kind.is_obstacle or kind.ways:
            continue
        elif kind.options:
            assert places <= set(kind.options)
            assert len(places) == min(sum(there), len(set(kind.options)))
        elif kind.within:
            assert all(any(inside(*place, *zone) for zone in zones_of(kind.within, standing)) for place in places)


def zones_of(within: Region, standing: Mapping[str, list[list[float]]]) -> list[tuple[float, ...]]:
    """The sides of what something is within, left, low, right and high; all the world where no zone is left."""
    if not isinstance(within, str):
        return [(*within[0], *within[1])]
    squares = [(x - size / 2, y - size / 2, x + size / 2, y + size / 2) for x, y, size in standing[within]]
    return [square for square in squares if not math.isnan(square[0])] or [(-math.inf, -math.inf, math.inf, math.inf)]


def inside(x: float, y: float, left: float, low: float, right: float, high: float) -> bool:
    """Whether a place is in a rectangle, but for rounding."""
    return left - 1e-9 <= x <= right + 1e-9 and low - 1e-9 <= y <= high + 1e-9


def hold_readings(plain: PlainWorld, used: set[int], moment: Moment) -> None:
    """Every physical sensor that somebody reads says what may be."""
    for sensor in plain.graph.sensors:
        if isinstance(sensor.kind, Physical) and sensor.kind.is_given and sensor.start in used:
            for k, spans in enumerate(plain.seen(sensor)):
                value = moment.readings[sensor.start + k]
                assert 0 <= value <= 1
                assert any(low - 3e-6 <= value <= high + 3e-6 for low, high in spans), (sensor, k, value, spans)


def hold_orders(graph: Graph, used: set[int], moment: Moment, seed: int) -> None:
    """Every order that somebody reads is that of its turn."""
    for number, sensor in enumerate(sensor for sensor in graph.sensors if sensor.kind.is_order):
        if sensor.start in used:
            found = moment.readings[sensor.start : sensor.start + sensor.width].tolist()
            assert found == ordered(sensor.kind, graph.tick, seed, number, moment.tick - 1)


def hold_mind(engine: Engine, used: set[int], moment: Moment) -> None:
    """The engine sees the same, also where it computes it itself, and thinks the same."""
    rows = [s.start + k for s in engine.graph.sensors if s.start in used for k in range(s.width)]
    rows += [row for memory in engine.graph.memories for row in range(memory.place.start, memory.place.stop)]
    assert np.array_equal(engine.readings[rows], moment.readings[rows], equal_nan=True)
    assert engine.influence.tobytes() == moment.influence.tobytes()


def hold_acting(plain: PlainWorld, moment: Moment, failing: Mapping[str, int]) -> None:
    """What is rough acts with its noise and slips as it says, and neutrally when it has failed.

    What stands still does not start below its share. All else does what it is told.
    """
    for i, actuator in enumerate(plain.graph.actuators):
        if (starts := getattr(actuator.kind, "starts", 0.0)) > 0:
            is_stuck = abs(plain.rolling(actuator.kind)) < 1e-3 and abs(2 * float(moment.acting[i]) - 1) < starts
            assert (moment.grip[i] == 0) == is_stuck
            if is_stuck:
                continue
        if moment.tick > failing.get(actuator.name, moment.tick):
            assert moment.acting[i] == np.float32(actuator.kind.neutral)
            continue
        noise, slip = getattr(actuator.kind, "noise", 0.0), getattr(actuator.kind, "slip", 0.0)
        assert abs(float(moment.acting[i]) - float(moment.commands[i])) <= noise * (1 + 1e-6)
        assert 0.0 <= moment.acting[i] <= 1.0
        assert 1.0 - slip <= moment.grip[i] <= 1.0


def hold_things(plain: PlainWorld, moment: Moment) -> None:
    """What was reached or delivered moves or vanishes where it says so, and nothing else does."""
    for i, thing in enumerate(plain.things):
        if i not in plain.changed:
            assert np.array_equal(plain.places[i], moment.things[i], equal_nan=True)
        elif "moves" not in {thing.kind.reached, getattr(thing.kind, "delivered", "")}:
            assert np.isnan(moment.things[i][:2]).all(), "it has vanished"
        elif not np.isnan(moment.things[i][0]):
            hold_size(thing.kind.size, plain.places[i][2], moment.things[i][2])
    assert moment.held == (-1 if plain.held in plain.changed else plain.held)
    plain.places, plain.held = moment.things.copy(), moment.held
    plain.body.loose.replace(plain.places, plain.changed)
    plain.walkers.turn(moment.turned)
    assert plain.charge == moment.battery if plain.runs_down else np.isnan(moment.battery)


def hold_size(span: Span, before: float, now: float) -> None:
    """What moves takes the next step of its schedule, or is of any size in its span."""
    if span.by is None:
        assert span.first <= now <= span.last
    elif span.first > span.last:
        assert now == max(span.last, before - span.by)
    else:
        assert now == min(span.last, before + span.by)
