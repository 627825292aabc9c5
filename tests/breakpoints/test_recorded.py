"""The recording of a run stops where the run does, whatever world it is of, in parts of any size."""

from collections.abc import Iterator
from itertools import pairwise, product
from pathlib import Path

import numpy as np
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from mindrun.engine.engine import procedure_sources
from mindrun.graph.bundle import Bundle
from mindrun.graph.graph import Graph
from mindrun.graph.policy import Policy
from mindrun.graph.recording_header import About
from mindrun.graph.weights import reachable
from mindrun.robot.recording import read_growing

from mindlang.breakpoints.breakpoint import Breakpoint, Happens, Holds, Reaches, RobotEvent, Transmission
from mindlang.breakpoints.resolve import breakpoints_of
from mindlang.breakpoints.watch import RecordingWatcher, recording_subject, watcher
from mindlang.compiler.source import Source
from mindlang.lock.status import ReadyMind
from mindlang.run.recorded_run import record_run
from mindlang.run.recording import run_bytes
from mindlang.run.setup import RunSetup
from tests.breakpoints.subjects import subject
from tests.calling import Call
from tests.draws import cases
from tests.hierarchies import PROCEDURES, SCALES
from tests.sim.test_random_worlds import weights_for
from tests.sim.worlds import random_world

SLOW = [HealthCheck.too_slow, HealthCheck.data_too_large, HealthCheck.large_base_example]
LEVEL = (("number", 0.4), (">", 0))


def breakpoints(graph: Graph, actuators: int) -> Iterator[Breakpoint]:
    """Every event, the first readings, so many commands, and all that a skill sends, above 0.4."""
    causes: list[Holds | Happens | Reaches] = [Reaches(3)]
    causes += [Happens(event, times) for event in graph.tasks[0].events for times in (0, 2)]
    causes += [Holds((("reading", place), *LEVEL), (), ()) for place in range(min(4, graph.width))]
    causes += [Holds((("command", place), *LEVEL), (), ()) for place in range(actuators)]
    for place, draw in enumerate(graph.tasks[0].draws):
        causes.append(Holds((("drawn", place), ("number", draw.values[0]), (">=", 0)), (), ()))
    names = [skill.name for skill in graph.skills]
    for skill in reachable(graph, graph.master):
        for edge in skill.edges:
            sent = Transmission(names.index(skill.name), edge.to, edge.target)
            causes.append(Holds((("measure", 0), *LEVEL), (sent,), ()))
    for line, cause in enumerate(causes, 1):
        yield Breakpoint(line, "", cause)


@settings(max_examples=cases(20), suppress_health_check=SLOW)
@given(random_world(), st.sampled_from(SCALES), st.integers(0, 2**64 - 1), st.lists(st.floats(0, 1), max_size=4))
def test_the_recording_of_a_run_stops_where_the_run_does(
    graph: Graph, scale: float, seed: int, cuts: list[float]
) -> None:
    policy = Policy(graph, weights_for(graph, scale, np.random.default_rng(seed % 1000)))
    setup = RunSetup(graph.tasks[0], graph.master, ReadyMind(policy, (), ()), PROCEDURES)
    run = record_run(setup, setup.rollout(), seed)
    about, parts = read_growing(Path("run.rec"), iter([run_bytes(run, setup, seed)]))
    rows = np.concatenate([*parts])
    is_late = not np.array_equal(rows["commands"], run.commands)  # a run has what reaches an actuator with a delay
    asked = [*breakpoints(graph, 0 if is_late else len(graph.actuators))]
    bundle = Bundle(policy, procedure_sources(graph, PROCEDURES))
    watching, stops = RecordingWatcher(asked, about, bundle), []
    for part in np.split(rows, sorted(int(cut * len(rows)) for cut in cuts)):
        stops += watching.feed(part, part["readings"])
    found = [(stop.tick, stop.breakpoint.line) for stop in stops]
    assert found == [(stop.tick, stop.breakpoint.line) for stop in watcher(asked, setup).feed(run)]


@given(st.lists(st.tuples(*[st.integers(0, 2)] * 4), min_size=1, max_size=12), st.lists(st.integers(0, 12), max_size=3))
def test_what_happens_to_a_robot_is_found_where_it_begins(facts: list[tuple[int, ...]], cuts: list[int]) -> None:
    """Of each row whether it had to stop, and the faults of its sensors."""
    graph = subject().graph
    bundle = Bundle(Policy(graph, weights_for(graph, 1.0, np.random.default_rng(1))), {})
    about = About.of(graph, "0" * 64, "Go", ("eyes", "ball_bearing", "holding"))
    rows = np.zeros(len(facts), about.row)
    rows["stopped"], rows["faults"] = [fact[0] for fact in facts], [fact[1:] for fact in facts]
    begun = np.array(
        [[now > 0 and then == 0 for then, now in zip(*both, strict=True)] for both in pairwise([(0,) * 4, *facts])]
    )
    happened = {
        RobotEvent("stopped"): begun[:, 0],
        RobotEvent("fault"): begun[:, 1:].sum(axis=1),
        RobotEvent("fault", "holding"): begun[:, 3],
    }
    asked = [
        Breakpoint(line, "", Happens(event, times)) for line, (event, times) in enumerate(product(happened, (0, 2)))
    ]
    watching, stops = RecordingWatcher(asked, about, bundle), []
    for part in np.split(rows, sorted(cuts)):
        stops += watching.feed(part, part["readings"])
    expected = []
    for row, each in product(range(len(facts)), asked):
        assert isinstance(each.cause, Happens)
        of = happened[each.cause.event]
        then, now = of[:row].sum(), of[: row + 1].sum()
        if then < each.cause.times <= now if each.cause.times else now > then:
            expected.append((row + 1, each.line))
    assert [(stop.tick, stop.breakpoint.line) for stop in stops] == expected


def test_events_of_its_task_are_found_in_a_recording_with_a_world(mindc: Call, rules: Path, tmp_path: Path) -> None:
    from mindrun.robot.recording import read

    from mindlang.run.recording import running_bundle

    rec = tmp_path / "run.rec"
    assert mindc("run", rules, "--task", "Roam", "--seed", 3, "--record", rec).code == 0
    about, (rows,) = read(rec)
    bundle = running_bundle(rules, about)
    text = "stop on collision\nstop on stopped\nstop when Turn influences left_wheel above 16%\n"
    found = breakpoints_of(Source("a.break", text), recording_subject(about, bundle))
    assert found.diagnostics == ()
    stops = RecordingWatcher(found.breakpoints, about, bundle).feed(rows, rows["readings"])
    assert [(stop.tick, stop.breakpoint.line) for stop in stops] == [(1, 3), (len(rows), 1)]
    for wrong, code, hint in (
        ("visit of patch size 4", "unnoticed-event", "Write a condition instead; only events of which a line"),
        ("reach of bal", "unknown-thing", "Did you mean ball?"),
        ("colision", "unknown-kind", "Did you mean collision?"),
        ("stoped", "unknown-kind", "Did you mean stopped?"),
    ):
        other = breakpoints_of(Source("a.break", f"stop on {wrong}"), recording_subject(about, bundle))
        assert [(each.code, each.hint.startswith(hint)) for each in other.diagnostics] == [(code, True)]
