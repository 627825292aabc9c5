"""The runtime of a compiled mind: the engine on numpy alone, and with the `sim` packages its worlds and its training.

    bundle = mindrun.read_bundle(Path("collect.bundle"))
    engine = mindrun.Engine(bundle.policy, bundle.procedures)
    commands = engine.tick(readings)                    # readings [bundle.graph.width]

Each name is imported when it is asked for: a robot has numpy alone, and its guardian not even that.
"""

from typing import TYPE_CHECKING

from mindrun.lazy_import import lazy_names

if TYPE_CHECKING:
    from mindrun.engine.engine import Engine as Engine
    from mindrun.errors import MindError as MindError
    from mindrun.graph.bundle import Bundle as Bundle
    from mindrun.graph.bundle import read_bundle as read_bundle
    from mindrun.graph.bundle import write_bundle as write_bundle
    from mindrun.graph.graph import Graph as Graph
    from mindrun.graph.policy import Policy as Policy
    from mindrun.graph.run_scores import Scores as Scores
    from mindrun.robot.order_client import say_order as say_order
    from mindrun.robot.replay import Replayed as Replayed
    from mindrun.robot.replay import replay_recording as replay_recording
    from mindrun.sim.rollout import Rollout as Rollout
    from mindrun.sim.trace import Moment as Moment
    from mindrun.sim.trace import Trace as Trace

VERSION = "0.1.0"
HOMES = {  # where the public names stand
    "mindrun.graph.bundle": ("Bundle", "read_bundle", "write_bundle"),
    "mindrun.engine.engine": ("Engine",),
    "mindrun.errors": ("MindError",),
    "mindrun.graph.graph": ("Graph",),
    "mindrun.graph.policy": ("Policy",),
    "mindrun.robot.order_client": ("say_order",),
    "mindrun.robot.replay": ("Replayed", "replay_recording"),
    "mindrun.graph.run_scores": ("Scores",),
    "mindrun.sim.rollout": ("Rollout",),
    "mindrun.sim.trace": ("Moment", "Trace"),
}
__getattr__ = lazy_names(__name__, HOMES)
__all__ = sorted(["VERSION", *(name for names in HOMES.values() for name in names)])
