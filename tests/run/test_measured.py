"""What was not measured is not 0: each number of a run is the one of a mind that reads everything, or there is none."""

import csv
from dataclasses import replace
from io import StringIO
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
from hypothesis import HealthCheck, event, given, settings
from hypothesis import strategies as st
from mindrun.engine.engine import Engine, procedure_sources
from mindrun.graph.bundle import Bundle, pack
from mindrun.graph.graph import Edge, Graph, Skill
from mindrun.graph.measured import measured_in_world, rows_of, used_sensors
from mindrun.graph.policy import Policy
from mindrun.graph.skill_sets import reachable
from mindrun.kinds.functions.function import Rule
from mindrun.kinds.sensors.sensor import Physical
from mindrun.robot.recording import read

from mindlang.lock.status import ReadyMind
from mindlang.run.recorded_run import RecordedRun, record_run
from mindlang.run.recording import run_bytes
from mindlang.run.setup import RunSetup
from mindlang.run.tables import trace_bytes, trace_table
from mindlang.view.viewed_recording import viewed_recording
from tests.draws import cases
from tests.hierarchies import PROCEDURES, SCALES
from tests.sim.test_random_worlds import Weights, weights_for
from tests.sim.worlds import random_world

SLOW = [HealthCheck.too_slow, HealthCheck.data_too_large, HealthCheck.large_base_example]
NOTHING = (("number", 0.0),)


@st.composite
def partly_read(draw: st.DrawFn) -> Graph:
    """A world in which some skill is in charge, so that others are switched off, and sensors are read by nobody.

    What only rewards read has no noise: it would come from a generator of its own, and not where a skill reads it too.
    """
    graph = draw(random_world(most=12))
    graph = replace(graph, master=draw(st.sampled_from([skill.name for skill in graph.skills])))
    task = replace(graph.tasks[0], varies=tuple(v for v in graph.tasks[0].varies if v.noun != "sensor"))
    _, aside = used_sensors(graph, reachable(graph, graph.master), task)
    return calm(replace(graph, tasks=(task,)), {each.name for each in aside})


def reading_all(graph: Graph) -> Graph:
    """The mind with a skill more below its master, which reads every sensor and has no influence."""
    everything = Skill("Reader", Rule(), tuple(range(graph.width)), ())
    watched = Edge("skill", len(graph.skills), None, NOTHING)
    skills = [replace(s, edges=(*s.edges, watched)) if s.name == graph.master else s for s in graph.skills]
    return replace(graph, skills=(*skills, everything))


def calm(graph: Graph, names: set[str]) -> Graph:
    """The mind of whose sensors these draw no random numbers."""
    sensors = tuple(
        replace(each, kind=replace(each.kind, noise=0.0, lost=0.0))
        if each.name in names and isinstance(each.kind, Physical)
        else each
        for each in graph.sensors
    )
    return replace(graph, sensors=sensors)


def recorded(graph: Graph, weights: Weights, seed: int) -> tuple[RecordedRun, RunSetup]:
    setup = RunSetup(graph.tasks[0], graph.master, ReadyMind(Policy(graph, weights), (), ()), PROCEDURES)
    return record_run(setup, setup.rollout(), seed), setup


@settings(max_examples=cases(25), suppress_health_check=SLOW)
@given(partly_read(), st.sampled_from(SCALES), st.integers(0, 2**32 - 1))
def test_every_number_is_that_of_a_mind_that_reads_all_or_there_is_none(graph: Graph, scale: float, seed: int) -> None:
    weights = weights_for(graph, scale, np.random.default_rng(seed))
    run, setup = recorded(graph, weights, seed)
    measured = measured_in_world(graph, graph.master, setup.task)
    is_read = rows_of(graph, measured)
    unread = {each.name for each in graph.sensors} - {each.name for each in measured}
    twin, _ = recorded(reading_all(calm(graph, unread)), weights, seed)
    reached = {skill.name for skill in reachable(graph, graph.master)}
    event(f"{np.count_nonzero(~is_read) > 0} that something is unread, {len(reached) < len(graph.skills)} switched off")
    assert np.array_equal(run.readings[:, is_read], twin.readings[:, is_read], equal_nan=True)
    assert np.isnan(run.readings[:, ~is_read]).all()
    for number, skill in enumerate(graph.skills):
        if skill.name in reached:
            assert np.array_equal(run.influence[:, number], twin.influence[:, number], equal_nan=True)
        else:
            assert np.isnan(run.influence[:, number]).all()
    assert np.array_equal(run.commands, twin.commands)
    assert np.array_equal(run.lines, twin.lines, equal_nan=True)
    assert np.array_equal(run.body, twin.body, equal_nan=True)
    assert np.array_equal(run.battery, twin.battery) or np.isnan(run.battery).all()


@settings(max_examples=6, suppress_health_check=SLOW)
@given(partly_read(), st.sampled_from(SCALES), st.integers(0, 2**32 - 1))
def test_tables_recordings_and_pages_show_what_the_run_has(graph: Graph, scale: float, seed: int) -> None:
    """And a recording is computed again by the engine, which reads none of it."""
    weights = weights_for(graph, scale, np.random.default_rng(seed))
    run, setup = recorded(graph, {skill: genome for skill, genome in weights.items() if len(genome)}, seed)
    rows = [*csv.DictReader(StringIO(trace_bytes(run, ".csv").decode()))]
    for name, column in trace_table(run).items():
        texts = [row[name] for row in rows]
        assert column.dtype.kind == "U" or [not text for text in texts] == [*~np.isfinite(column)], name
    with TemporaryDirectory() as folder:
        path, bundle = Path(folder) / "run.rec", Path(folder) / "run.bundle"
        path.write_bytes(run_bytes(run, setup, seed))
        policy = setup.ready.policy
        bundle.write_bytes(pack(Bundle(policy, procedure_sources(graph, PROCEDURES))))
        _, parts = read(path)
        engine = Engine(policy, PROCEDURES, graph.master)
        for row, influence in zip(np.concatenate([*parts])["readings"], run.influence, strict=True):
            engine.tick(row)
            assert np.array_equal(engine.influence, influence, equal_nan=True)
        seen = viewed_recording(path, bundle)
        while not seen.over:
            seen.grow()
        assert seen.failed is None
        ticks = np.arange(1, seen.known + 1)
        assert np.array_equal(seen.group("readings", ticks), run.readings[:, : graph.width], equal_nan=True)
        assert np.array_equal(seen.group("battery", ticks)[:, 0], run.battery, equal_nan=True)
        assert np.isnan(seen.group("readings", np.zeros(1, np.int64))).all()  # nobody has measured yet
