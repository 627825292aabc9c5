"""Virtual sensors: the readings that the engine computes from other readings and from the time."""

from mindrun.graph import Graph
from mindrun.sensors.sensor import Reader
from mindrun.validate import depths

NOWHERE = slice(0, 0)


def virtual_sensors(graph: Graph) -> tuple[tuple[slice, Reader], ...]:
    """Where the readings of each virtual sensor stand, and how they are computed; sources before what they are of."""
    places = {memory.name: slice(memory.start, memory.start + 1) for memory in graph.memories}
    places |= {sensor.name: slice(sensor.start, sensor.start + sensor.width) for sensor in graph.sensors}
    circular = {sensor.name for sensor in graph.sensors if sensor.kind.circular}
    found_at = depths(graph)
    found = []
    for sensor in sorted(graph.sensors, key=lambda sensor: found_at[sensor.name]):
        source = sensor.kind.source
        reader = sensor.kind.reader(graph.tick, places.get(source, NOWHERE), source in circular)
        if reader:
            found.append((places[sensor.name], reader))
    return tuple(found)
