"""What was drawn for a run, said as if it were so in every run: what varies has its value."""

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from mindrun.graph.graph import Graph, Program, Task, Thing, Variation

from tests.plain import postfix


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
    given = drawn[len(drawn) - len(task.draws) :]
    return graph, replace(task, things=tuple(_gone(thing, given) for thing in task.things), varies=(), fails=())


def _gone(thing: Thing, drawn: Sequence[float]) -> Thing:
    """A thing of which the way that is drawn is the only one."""
    kind: Any = thing.kind
    if not (thing.by and getattr(kind, "along", ())):
        return thing
    numbers = [of_drawn(program, drawn) for program in thing.by]
    return replace(thing, kind=replace(kind, along=tuple(zip(numbers[::2], numbers[1::2], strict=True)), or_=()))


def of_drawn(program: Program, drawn: Sequence[float]) -> float:
    """The value of a program of what a task has drawn."""
    with np.errstate(all="ignore"):
        return float(postfix([("number", drawn[int(x)]) if word == "drawn" else (word, x) for word, x in program], ()))


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
