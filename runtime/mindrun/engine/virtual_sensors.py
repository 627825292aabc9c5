"""Virtual sensors: the readings that the engine computes from other readings and from the time."""

from __future__ import annotations

from typing import TYPE_CHECKING

from mindrun.graph.graph import Graph
from mindrun.graph.validate import depths
from mindrun.kinds.sensors.sensor import Scene, directions

if TYPE_CHECKING:
    from mindrun.numbers.arrays import Reader


def scene_of(graph: Graph) -> Scene:
    """What the sensors of a graph depend on beside their own arguments."""
    places = {memory.name: slice(memory.start, memory.start + 1) for memory in graph.memories}
    places |= {sensor.name: slice(sensor.start, sensor.start + sensor.width) for sensor in graph.sensors}
    return Scene(graph.tick, places, directions({sensor.name: sensor.kind for sensor in graph.sensors}))


def virtual_sensors(graph: Graph) -> tuple[tuple[slice, Reader], ...]:
    """Where the readings of each virtual sensor stand, and how they are computed; sources before what they are of."""
    scene, found_at = scene_of(graph), depths(graph)
    found = []
    for sensor in sorted(graph.sensors, key=lambda sensor: found_at[sensor.name]):
        if reader := sensor.kind.reader(scene):
            found.append((scene.places[sensor.name], reader))
    return tuple(found)
