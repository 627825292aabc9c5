"""Where breakpoints stop what a robot has recorded: where a loop over its ticks finds that they hold."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from mindrun.engine.engine import Engine
from mindrun.graph.bundle import Bundle, digest, read_bundle, write_bundle
from mindrun.graph.policy import Policy
from mindrun.robot.recording import About, Recorder, read

from mindlang.breakpoints.breakpoint import Breakpoint
from mindlang.breakpoints.resolve import breakpoints_of
from mindlang.breakpoints.watch import RecordingWatcher, Stop, recording_subject
from mindlang.compiler.source import Source
from mindlang.view.viewed_recording import followed_recording, viewed_recording
from tests.calling import Call
from tests.view.serving import served
from tests.view.test_following import Growing, write_rows
from tests.view.test_recording import BEGUN_ANEW, MIND, TICKS, mind, whole

BREAKS = """
stop when mood > 0.5 and pulse < 0.3
stop when Roam influences Turn above 7.3%
stop on stopped
stop on 3 fault
stop on fault of sense
stop in tick 81
"""


@pytest.fixture(scope="module")
def day(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, Path, list[list[int]]]:
    """A recording, its bundle, and for each line of BREAKS the ticks that an engine beside it finds.

    The mind was begun anew once, and has a function that remembers.
    """
    folder = tmp_path_factory.mktemp("day")
    rec, bundle = folder / "day.rec", folder / "ball.bundle"
    drawn, rng = mind(MIND), np.random.default_rng(1)
    small = {name: weights / 10 for name, weights in drawn.weights.items()}  # the drawn ones send 1 whatever is read
    policy, graph = Policy(drawn.graph, small), drawn.graph
    engine = Engine(policy)
    place = {sensor.name: sensor.start for sensor in graph.sensors} | {graph.memories[0].name: graph.memories[0].start}
    turn = [skill.name for skill in graph.skills].index("Turn")
    write_bundle(bundle, Bundle(policy, {}))
    held, events = [(False, False)], []
    with Recorder(rec, About.of(graph, digest(bundle), graph.master, ("sense",))) as recorder:
        for number in range(TICKS):
            tick = number % BEGUN_ANEW
            if tick == 0:
                engine.reset()
            readings = np.full(graph.width, np.nan, np.float32)
            readings[:3] = rng.random(3)
            commands = engine.tick(readings)
            stopped, fault = number % 20 < 3, number % 15 < 2
            recorder.write(
                tick=tick, time=number / 20, stopped=stopped, armed=1, faults=[2 * fault], ages=[0.0],
                readings=engine.readings, influence=engine.influence, commands=commands, sent=commands,
            )  # fmt: skip
            mood, pulse = (engine.readings[place[name]] for name in ("mood", "pulse"))
            held.append((bool(mood > 0.5 and pulse < 0.3), bool(engine.influence[turn] > 0.073)))
            events.append((number % 20 == 0, number % 15 == 0))
    begins = [[tick for tick in range(1, TICKS + 1) if held[tick][i] and not held[tick - 1][i]] for i in (0, 1)]
    stops, faults = ([tick + 1 for tick in range(TICKS) if events[tick][i]] for i in (0, 1))
    return rec, bundle, [*begins, stops, faults[2:3], faults, [81]]


def watching(about: About, bundle: Bundle) -> RecordingWatcher:
    return RecordingWatcher(breakpoints(BREAKS, about, bundle), about, bundle)


def breakpoints(text: str, about: About, bundle: Bundle) -> Sequence[Breakpoint]:
    found = breakpoints_of(Source("day.break", text), recording_subject(about, bundle))
    assert found.diagnostics == ()
    return found.breakpoints


def test_it_stops_where_an_engine_beside_it_says(day: tuple[Path, Path, list[list[int]]]) -> None:
    rec, bundle, expected = day
    viewed = whole(viewed_recording(rec, bundle, watching))
    lines = BREAKS.split("\n")
    found = [[tick for tick, text in viewed.stops if text == f"line {n + 1}: {lines[n]}"] for n in range(1, 7)]
    assert found == expected
    assert all(ticks for ticks in expected)
    assert len(viewed.stops) == sum(map(len, expected))


def test_a_function_that_remembers_begins_anew_with_the_mind(day: tuple[Path, Path, list[list[int]]]) -> None:
    """Roam alone influences Turn, and has influence 1 itself: what it sends is the influence that was recorded."""
    about, parts = read(day[0])
    bundle, (rows,) = read_bundle(day[1]), parts
    readings = whole(viewed_recording(*day[:2])).group("readings", np.arange(1, TICKS + 1))
    levels = np.arange(1, 1000) / 1000
    text = "\n".join(f"stop when Roam influences Turn above {level}" for level in levels)
    found = RecordingWatcher(breakpoints(text, about, bundle), about, bundle).feed(rows, readings)
    sent = rows["influence"][:, about.skills.index("Turn")][:, None] > levels
    begins = sent & ~np.vstack([np.zeros_like(sent[:1]), sent[:-1]])
    assert [(stop.tick - 1, stop.breakpoint.line - 1) for stop in found] == [*map(tuple, np.argwhere(begins).tolist())]


@given(data=st.data())
def test_rows_in_parts_of_any_size_stop_where_the_whole_does(
    day: tuple[Path, Path, list[list[int]]], data: st.DataObject
) -> None:
    rec, path, _ = day
    bundle = read_bundle(path)
    about, parts = read(rec)
    rows = np.concatenate([*parts])
    rng = np.random.default_rng(data.draw(st.integers(0, 99)))
    rows["stopped"], rows["faults"] = rng.integers(0, 2, TICKS), rng.integers(0, 3, (TICKS, 1))
    rows["tick"] = np.where(rng.random(TICKS) < 0.1, 0, 1)
    readings = rng.random((TICKS, about.readings), np.float32)
    cuts = sorted(data.draw(st.lists(st.integers(0, TICKS), max_size=6)))
    part_by_part = watching(about, bundle)
    found: list[Stop] = []
    for part in np.split(np.arange(TICKS), cuts):
        found += part_by_part.feed(rows[part], readings[part])
    assert found == watching(about, bundle).feed(rows, readings)
    assert found


def test_what_grows_stops_the_page_as_it_comes(tmp_path: Path) -> None:
    day = Growing(tmp_path)
    with Recorder(day.rec, day.about) as recorder:
        write_rows(recorder, day.engine, 0, 70)
        with (
            followed_recording(str(day.rec), day.bundle, watching) as viewed,
            served(viewed) as view,
            view.viewer() as viewer,
        ):
            write_rows(recorder, day.engine, 70, 90)
            stops = []
            while [81, "line 7: stop in tick 81"] not in stops:
                stops += viewer.hear("ticks")["stops"]


def test_a_mistake_ends_it_before_anything_is_served(
    mindc: Call, day: tuple[Path, Path, list[list[int]]], tmp_path: Path
) -> None:
    breaks = tmp_path / "day.break"
    breaks.write_text("stop on stopped\nstop on collision\n")
    for more in ((), ("--follow",)):
        said = mindc("view", *day[:2], "--break", breaks, "--no-browser", *more)
        assert (said.code, said.out) == (1, "")
        assert f"{breaks}:2:9: error: A robot does not record what happens" in said.err
    said = mindc("view", *day[:2], "--break", tmp_path / "no.break", "--no-browser")
    assert (said.code, said.out) == (2, "")
