"""A mind that runs, on numpy alone: the definition that every faster executor agrees with bit for bit."""

from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mindrun.engine.think import Thought, hierarchy, think
from mindrun.errors import MindError, ReadingsError
from mindrun.graph.graph import Graph
from mindrun.graph.measured import with_sources
from mindrun.graph.named_readings import named_places
from mindrun.graph.policy import Policy
from mindrun.graph.procedure_source import source_of
from mindrun.graph.weights import reachable
from mindrun.kinds.functions.function import Stateful
from mindrun.kinds.functions.procedure import used_file
from mindrun.kinds.memory import UNDRIVEN_COMMAND
from mindrun.kinds.procedure_text import FILES, Sources, module_of
from mindrun.kinds.sensors.sensor import Scene, directions
from mindrun.numbers.arrays import Reader, Singles


def procedure_sources(graph: Graph, folder: Path, master: str | None = None) -> dict[str, str | bytes]:
    """The text of each module that the skills below `master` (default: the mind's) call, and the files that they use.

    ProcedureError where one cannot be what its skill needs (`source_of`).
    """
    found: dict[str, str | bytes] = {}
    for skill in reachable(graph, master or graph.master):
        if (calls := skill.function.calls) is not None:
            found[module_of(calls)] = source_of(skill, folder)
            found |= {f"{FILES}{name}": used_file(calls, name, folder) for name in skill.files}
    return found


def scene_of(graph: Graph) -> Scene:
    """The scene of a graph's sensors: all that they depend on beside their own arguments."""
    places = {name: slice(rows.start, rows.stop) for name, rows in named_places(graph).items()}
    sensors = {sensor.name: sensor.kind for sensor in graph.sensors}
    kinds = sensors | {memory.name: memory.kind for memory in graph.memories}
    return Scene(graph.tick, places, directions(sensors), graph.skill_numbers, kinds)


def virtual_sensors(graph: Graph) -> tuple[tuple[slice, Reader], ...]:
    """The places of each virtual sensor's readings, and its reader; sources before what is computed of them."""
    scene, every = scene_of(graph), with_sources(graph, set(range(graph.width)))
    readers = ((scene.places[sensor.name], sensor.kind.reader(scene)) for sensor in every)
    return tuple((place, reader) for place, reader in readers if reader)


class Engine:
    """One mind and its state: the tick's number, the readings and influence before, what memories keep.

    `procedures` is the folder of the procedures' modules or their texts by
    dotted name, `master` another skill than the mind's own to be in charge. Raises MindError where one does not fit.
    """

    def __init__(self, policy: Policy, procedures: Path | Sources | None = None, master: str | None = None) -> None:
        graph = policy.graph
        master = master or graph.master
        if master not in {skill.name for skill in graph.skills}:
            raise MindError(f"there is no skill {master}")
        if isinstance(procedures, Path):
            procedures = procedure_sources(graph, procedures, master)
        self.graph = graph
        self._hierarchy = hierarchy(policy, procedures or {}, master)
        self._neutral = np.array([actuator.kind.neutral for actuator in graph.actuators], np.float32)
        self._sensed = sum(sensor.width for sensor in graph.sensors)  # behind these stands what memories keep
        scene = scene_of(graph)
        self._keepers = tuple((memory.place, memory.kind.keeper(scene)) for memory in graph.memories)
        self.reset()

    def reset(self) -> None:
        """Go back to the state before the first tick."""
        for skill in self._hierarchy.skills:
            if isinstance(skill.compute, Stateful):
                skill.compute.reset()
        self._virtual = virtual_sensors(self.graph)
        self._tick = 0
        self._before: Singles | None = None
        self._kept = np.array([m.kind.start for m in self.graph.memories for _ in range(m.kind.kept)], np.float32)
        self.readings = np.zeros(self.graph.width, np.float32)
        self.influence = self._hierarchy.calm[0].copy()
        self.faults = 0

    def tick(self, readings: ArrayLike) -> NDArray[np.float32]:
        """Commands [actuators] for readings [graph.width]; those of virtual sensors and memories are filled in here."""
        with np.errstate(all="ignore"):
            self.readings = self._filled(np.array(readings, np.float32))
            thought = self._thought()
            actuators = len(self._neutral)
            commands = np.where(thought.driven, thought.command, np.float32(UNDRIVEN_COMMAND))[actuators:]
            for (place, keep), command in zip(self._keepers, commands, strict=True):
                self._kept[place.start - self._sensed : place.stop - self._sensed] = keep(
                    self.readings[place], command, self.readings
                )
        self.influence = thought.influence
        self._tick, self._before = self._tick + 1, np.concatenate([self.readings, self.influence])
        self.faults += thought.faults
        return np.where(thought.driven[:actuators], thought.command[:actuators], self._neutral)

    def _filled(self, now: Singles) -> Singles:
        if now.shape != (self.graph.width,):
            raise ReadingsError(f"this mind has {self.graph.width} readings, not {now.shape}")
        now[self._sensed :] = self._kept
        for place, read in self._virtual:
            now[place] = read(self._tick, now, self._before)
        return now

    def _thought(self) -> Thought:
        return think(self._hierarchy, self.readings)
