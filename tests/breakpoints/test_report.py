"""Where a run stopped, as data and for reading: the first tick, all lines that stop it, and their values."""

import numpy as np

from mindlang.breakpoints.breakpoint import Breakpoint, Reaches
from mindlang.breakpoints.watch import Stop
from mindlang.cli.run import stop_summary, stopped_data

BY = [
    {"file": "a.break", "line": 2, "text": "stop on collision", "values": {"times": 3.0}},
    {"file": "a.break", "line": 5, "text": "stop when eye < 1", "values": {"eye": None, "left": 1 / 3}},
]
TEXT = """\
stopped in tick 1,200, after 24.00 s
a.break:2: stop on collision
  times 3
a.break:5: stop when eye < 1
  eye nan
  left 0.333333
"""


def stop(tick: int, line: int, text: str, *values: tuple[str, float]) -> Stop:
    return Stop(tick, Breakpoint(line, text, Reaches(tick)), values)


def test_where_a_run_stopped() -> None:
    first = stop(1200, 2, "stop on collision", ("times", 3.0))
    same = stop(1200, 5, "stop when eye < 1", ("eye", np.nan), ("left", 1 / 3))
    found = stopped_data([first, same, stop(1201, 2, "stop on collision", ("times", 4.0))], "a.break", 0.02)
    assert found == {"tick": 1200, "seconds": 24.0, "by": BY}
    assert stop_summary(found).plain == TEXT
    assert stopped_data([], "a.break", 0.02) is None
    assert stop_summary(None).plain == "stopped nowhere\n"
