"""A world with the commands that its actuators hold, and what can be asked of it."""

import json
from collections import Counter
from collections.abc import Sequence
from time import monotonic
from typing import Any, Protocol

import numpy as np

from mindrun.graph.graph import Graph, Task
from mindrun.graph.recording_header import world_row_of
from mindrun.robot.simulated_world.protocol import ANSWER, BOXES, READ, STATUS, WORLD

SEED_COUNT = 1 << 64


class SimulatedWorld(Protocol):
    """What `mindrun.sim.commanded_world` simulates."""

    graph: Graph
    seed: int

    @property
    def tick(self) -> int: ...

    @property
    def pose(self) -> tuple[float, float, float]: ...

    @property
    def events(self) -> dict[str, int]: ...

    @property
    def by_line(self) -> dict[str, float]: ...

    @property
    def score(self) -> float: ...

    @property
    def ended(self) -> str | None: ...

    @property
    def task(self) -> Task: ...

    @property
    def boxes(self) -> Any: ...

    def columns(self) -> dict[str, Any]: ...

    def readings(self) -> Any: ...

    def step(self, commands: Sequence[float]) -> None: ...

    def begin(self, seed: int) -> None: ...


class SimulatedScene:
    """A world, the command that each actuator holds, and what clients may ask; `again`: runs follow one another."""

    def __init__(self, world: SimulatedWorld, again: bool = False) -> None:
        self.world, self.again = world, again
        self.commands = {actuator.name: float(actuator.kind.neutral) for actuator in world.graph.actuators}
        self.past: Counter[str] = Counter()  # what has ended the runs before
        self.missed = 0
        self._places = {s.name: slice(s.start, s.start + s.width) for s in world.graph.sensors}
        self._sense()

    def tick(self) -> None:
        """One tick under the commands that the actuators hold; a world that has ended stands still."""
        self.world.step(list(self.commands.values()))
        if self.again and self.world.ended:
            self.past[self.world.ended] += 1
            [seed] = np.random.SeedSequence(self.world.seed).generate_state(1, np.uint64).tolist()
            self.world.begin(seed)  # not seed + 1, which may be where another robot began
        self._sense()

    def answer(self, what: bytes, name: str, value: float) -> bytes:
        """The answer to a request."""
        if what == STATUS:
            return self._packed(json.dumps(self.status()).encode())
        if what == WORLD:
            return self._packed(self._row())
        if what == BOXES:
            return self._packed(self.world.boxes.astype("<f8").tobytes())
        if what == READ and name in self._places:
            return self._packed(self._readings[self._places[name]].tobytes())
        if what == READ:
            return self._packed(f"there is no sensor {name}".encode(), done=False)
        if name not in self.commands:
            return self._packed(f"there is no actuator {name}".encode(), done=False)
        if not 0.0 <= value <= 1.0:
            return self._packed(f"a command of {value} is not between 0 and 1".encode(), done=False)
        self.commands[name] = value
        return self._packed(b"")

    def status(self) -> dict[str, Any]:
        """How the run stands, and the runs before; `missed` are ticks for which the computer was too slow."""
        world = self.world
        return {
            "seed": world.seed, "tick": world.tick, "pose": world.pose, "events": world.events, "ended": world.ended,
            "by_line": world.by_line, "score": world.score, "commands": self.commands, "past": self.past,
            "missed": self.missed,
        }  # fmt: skip

    def _row(self) -> bytes:
        row = np.zeros(1, world_row_of(self.world.task))
        for name, value in self.world.columns().items():
            row[name][0] = value
        return row.tobytes()

    def _sense(self) -> None:
        self._readings, self._time = self.world.readings().astype("<f8"), monotonic()

    def _packed(self, held: bytes, done: bool = True) -> bytes:
        return ANSWER.pack(done, len(held), self._time) + held
