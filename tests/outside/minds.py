"""Minds in the environments of the tests."""

from pathlib import Path
from typing import Any

import numpy as np
from mindrun.graph.graph import Graph
from mindrun.graph.policy import Policy
from mindrun.kinds.actuators.actuator import Action, Choice
from mindrun.kinds.events.event import ItsEnd
from mindrun.kinds.measures.measure import ItsReward
from mindrun.kinds.scenes.scene import Gymnasium
from mindrun.sim.outside.rollout import EnvironmentRollout

from mindlang.compiler.compile import Compiled, compile_source
from mindlang.compiler.source import Source
from tests.outside.worlds import Line, name, register

KINDS = (Action, Choice, Gymnasium, ItsEnd, ItsReward)  # which these minds have
PLACE = "sensor place is observation 0 range -2 to 2\nsensor speed is observation 1 range -1 to 1"
PUSH = "actuator push is action 0 neutral 0.5"
LINES = "rewards its reward\n  ends on its end"


def text(
    sensors: str = PLACE, actuators: str = PUSH, scene: str = name(Line), lines: str = LINES, more: str = ""
) -> str:
    """A mind whose one skill reads every sensor and drives every actuator."""
    parts = "".join(f"  reads {line.split()[1]}\n" for line in f"{sensors}\n{more}".split("\n") if line[:6] in READ)
    parts += "".join(f"  drives {line.split()[1]}\n" for line in actuators.split("\n"))
    return (
        f"tick 1/50 s\nmaster Go\n{sensors}\n{actuators}\n{more}\nskill Go is mlp hidden 1\n{parts}"
        f"task Go in gymnasium {scene}\n  lasts 40 ticks\n  {lines}\n"
    )


READ = ("sensor", "memory")


def compiled(source: str) -> Compiled:
    """That mind, compiled."""
    register()
    return compile_source(Source("text.mind", source, Path(__file__).parent))


def graph_of(source: str) -> Graph:
    """Its graph; AssertionError where anything is wrong with it."""
    found = compiled(source)
    assert found.graph is not None, [diagnostic.message for diagnostic in found.diagnostics]
    return found.graph


def rollout_of(source: str, lanes: int = 8, interrupt: bool = True, **options: Any) -> EnvironmentRollout:
    """What scores genomes of its skill."""
    graph = graph_of(source)
    return EnvironmentRollout(Policy(graph, {}), "Go", "Go", ["Go"], lanes=lanes, interrupt=interrupt, **options)


def genomes(
    rollout: EnvironmentRollout, count: int, seed: int = 1
) -> "np.ndarray[tuple[int, ...], np.dtype[np.float32]]":
    """Some weights [count, genome_length]."""
    return np.random.default_rng(seed).normal(0, 3, (count, rollout.genome_length)).astype(np.float32)
