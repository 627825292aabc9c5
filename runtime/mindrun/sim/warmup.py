"""Machine code of the simulator, made ahead of its use: `python -m mindrun.sim.warmup [behind]`."""

import fcntl
import os
import subprocess
import sys
from collections.abc import Iterable, Sequence
from typing import Any

from mindrun.graph.graph import Actuator, Graph, Reward, Skill, Task
from mindrun.graph.policy import Policy
from mindrun.kinds.actuators.actuator import Wheel
from mindrun.kinds.bodies.body import Disc
from mindrun.kinds.functions.function import Rule
from mindrun.kinds.scenes.scene import Plain
from mindrun.processors import give_way
from mindrun.sim import cache
from mindrun.sim.lanes.advance import advance
from mindrun.sim.lanes.runs import fill
from mindrun.sim.lanes.stages import act, after, before, begin_again, conclude, run_skills, send, wake
from mindrun.sim.numba_internals import code_of
from mindrun.sim.rollout import Rollout

IN_BACKGROUND = "behind"
LOWEST_NICENESS = 19  # how little a process matters that works while others wait for nothing


def is_there(entries: Iterable[Any]) -> bool:
    """True if there is machine code that numba would take of all of these functions."""
    return all(code_of(entry).is_there() for entry in entries)


def is_native(entries: Iterable[Any] = (advance,)) -> bool:
    """True if all of these functions are compiled for this very processor."""
    return all(code_of(entry).is_native() for entry in entries)


def start(*words: str) -> "subprocess.Popen[bytes]":
    """A process that compiles it for this very processor, whatever was shipped, and goes on when this one ends."""
    environment = os.environ | {"NUMBA_CPU_NAME": cache.processor()}
    command, nowhere = [sys.executable, "-m", "mindrun.sim.warmup", *words], subprocess.DEVNULL
    return subprocess.Popen(
        command, env=environment, stdin=nowhere, stdout=nowhere, stderr=nowhere, start_new_session=True
    )


def warm_up() -> None:
    """Compile every way in that is not kept yet."""
    rollout = Rollout(Policy(_smallest(), {}), "Nothing", "Rest")
    rollout.compile(fill, advance, before, run_skills, after, wake, send, begin_again, act, conclude)


def main(words: Sequence[str]) -> None:
    """Compile, after any other process that does; with `behind`, at low priority, and not at all beside another one."""
    behind = IN_BACKGROUND in words
    with (cache.folder() / "warming").open("w") as file:
        try:
            fcntl.flock(file, fcntl.LOCK_EX | (fcntl.LOCK_NB if behind else 0))
        except OSError:
            return
        if behind:
            give_way(LOWEST_NICENESS)
        warm_up()


def _smallest() -> Graph:
    """A mind that does nothing."""
    wheel = Actuator("wheel", Wheel("left", 0.5))
    task = Task("Nothing", Plain(), (), 1, (), (), (), (Reward("", (("number", 0.0),), None),), ())
    return Graph(1 / 60, Disc(), "Rest", (), (), (wheel,), (Skill("Rest", Rule(), (), ()),), (task,), ())


if __name__ == "__main__":
    main(sys.argv[1:])
