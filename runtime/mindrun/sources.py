"""The sensors from which readings come in the end."""

from collections.abc import Iterable

from mindrun.graph import Graph
from mindrun.reachability import reached_from


def sensors_behind(graph: Graph, rows: Iterable[int]) -> set[str]:
    """The sensors that fill these rows of the readings, and all that they are computed from."""
    kinds = {sensor.name: sensor.kind for sensor in graph.sensors}
    names = {sensor.start + k: sensor.name for sensor in graph.sensors for k in range(sensor.width)}

    def sources(name: str) -> Iterable[str]:
        return (source for source in kinds[name].sources if source in kinds)

    return reached_from((names[row] for row in rows if row in names), sources)
