"""What a robot measures does not depend on what it has not wired."""

from dataclasses import replace
from typing import Any

import numpy as np
from hypothesis import event, given, settings
from hypothesis import strategies as st
from mindrun.engine.engine import Engine
from mindrun.graph.graph import Graph, Sensor
from mindrun.graph.measured import measured_on_robot, rows_of
from mindrun.graph.named_readings import physical
from mindrun.graph.policy import Policy
from mindrun.graph.weights import genes
from mindrun.graph.wiring import read_by
from mindrun.kinds.sensors.derived import Derivative

from tests.draws import cases
from tests.hierarchies import PROCEDURES, random_graph
from tests.minds import mind, rule

TICKS = 5


def test_what_is_computed_of_what_is_not_wired_is_not_measured() -> None:
    graph = mind(rule("Top"), readings=2)
    drain = Sensor("drain", Derivative("r1"), 2, 1)
    graph = replace(graph, sensors=(*graph.sensors, drain))
    assert measured_on_robot(graph, ["r0"]) == [graph.sensors[0]]
    assert measured_on_robot(graph, ["r1"]) == [graph.sensors[1], drain]


@given(random_graph(), st.data(), st.integers(0, 2**32 - 1))
@settings(max_examples=cases(50))
def test_readings_that_are_measured_come_of_what_is_wired_alone(graph: Graph, data: Any, seed: int) -> None:
    rng = np.random.default_rng(seed)
    others = sorted(physical(graph).keys() - read_by(graph, graph.master))
    wired = {*physical(graph)} - {name for name in others if data.draw(st.booleans())}
    is_measured = rows_of(graph, measured_on_robot(graph, wired))
    event(f"{not is_measured.all()} that something is not measured")
    weights = {s.name: rng.uniform(-1, 1, genes(s)).astype(np.float32) for s in graph.skills if not s.like}
    engines = [Engine(Policy(graph, weights), PROCEDURES) for _ in range(2)]
    for _ in range(TICKS):
        given = np.repeat([rng.uniform(0, 1, graph.width)], 2, axis=0)
        for name in physical(graph).keys() - wired:
            sensor = physical(graph)[name]
            given[1, sensor.start : sensor.start + sensor.width] = np.nan
        commands = [engine.tick(readings) for engine, readings in zip(engines, given, strict=True)]
        assert commands[0].tobytes() == commands[1].tobytes()
        now, then = (engine.readings[is_measured] for engine in engines)
        assert now.tobytes() == then.tobytes()
