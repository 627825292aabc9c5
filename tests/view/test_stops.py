"""Where breakpoints of a file stop a run that is seen, as `mindc run --break` finds them in the whole of it."""

from pathlib import Path

from mindlang.breakpoints.resolve import breakpoints_of
from mindlang.breakpoints.subject import BreakpointSubject
from mindlang.breakpoints.watch import noticing, watcher
from mindlang.compiler.compile import load
from mindlang.compiler.source import Source
from mindlang.run.recorded_run import record_run
from mindlang.run.setup import set_up
from mindlang.view.viewed_run import ViewedRun
from tests.view.serving import served

BREAKS = """
stop on reach of ball
stop in tick 812
stop when ball_bearing > 0.6
stop when Turn influences left_wheel above 10%
"""


def test_stops_are_those_of_the_whole_run(path: Path) -> None:
    compiled = load(path)
    setup = set_up(str(path), compiled, "Chase", None)
    assert compiled.mind is not None
    subject = BreakpointSubject.of_run(compiled.mind.names, setup)
    found = breakpoints_of(Source("chase.break", BREAKS), subject)
    assert found.diagnostics == ()
    setup = noticing(setup, found.breakpoints)
    rollout = setup.rollout(True)
    expected = [
        [stop.tick, f"line {stop.breakpoint.line}: {stop.breakpoint.text}"]
        for stop in watcher(found.breakpoints, setup).feed(record_run(setup, rollout, 3))
    ]
    viewed = ViewedRun(setup, rollout, 3, {}, found.breakpoints).begun()
    viewed.grow()
    heard = []
    with served(viewed) as view, view.viewer() as viewer:
        viewer.say(say="run", to=1200)
        while not (told := viewer.hear("ticks"))["over"]:
            heard += told["stops"]
        heard += told["stops"]
        column = viewed.about["nodes"][0]["columns"][0]
        viewer.say(say="change", tick=5, what="reading", value=0.9, lasts=1, column=column)
        beside = viewer.hear("fork")["fork"]
        while (told := viewer.hear("ticks"))["fork"] != beside or not told["over"]:
            assert not told["stops"]
        assert not told["stops"]
    assert heard == expected
    assert {text.split(":")[0] for _, text in heard} == {"line 2", "line 3", "line 4", "line 5"}
