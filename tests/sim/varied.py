"""What was drawn for a run, said as if it were so in every run: what varies has its value."""

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

from mindrun.graph.graph import Graph, Task, Variation


def as_drawn(graph: Graph, task: Task, drawn: Sequence[float]) -> tuple[Graph, Task]:
    """The graph and the task in whose every run what varies is as it was `drawn` for one."""
    for variation, value in zip(task.varies, drawn, strict=False):
        if variation.noun == "body":
            graph = replace(graph, body=_said(graph.body, variation, value))
        elif variation.noun == "thing":
            task = replace(task, things=_parts(task.things, variation, value))
        elif variation.noun == "actuator":
            graph = replace(graph, actuators=_parts(graph.actuators, variation, value))
        else:
            graph = replace(graph, sensors=_parts(graph.sensors, variation, value))
    return graph, replace(task, varies=(), fails=())


def stuck(task: Task, drawn: Sequence[float]) -> dict[str, int]:
    """The tick, counted from 0, from which on each actuator that fails is neutral."""
    return {each.actuator: int(tick) for each, tick in zip(task.fails, drawn[len(task.varies) :], strict=False)}


def _parts(parts: tuple[Any, ...], variation: Variation, value: float) -> tuple[Any, ...]:
    return tuple(
        replace(part, kind=_said(part.kind, variation, value)) if part.name == variation.of else part for part in parts
    )


def _said(kind: Any, variation: Variation, value: float) -> Any:
    assert variation.low <= value <= variation.high
    plain = type(getattr(kind, variation.argument))(value)
    assert plain == value, "what is whole is drawn whole"
    return replace(kind, **{variation.argument: plain})
