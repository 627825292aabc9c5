"""Whether what a task puts at a place can be there, beside what else it puts somewhere."""

from collections.abc import Sequence
from typing import Any

from mindrun.quantity import Place
from mindrun.scenes import SceneKind

from mindlang.compiler.diagnostic import Findings, Label
from mindlang.compiler.model import Part


def check_places(things: Sequence[Part[Any]], scene: SceneKind | None, findings: Findings) -> None:
    """Report what stands where an obstacle stands in every run."""
    for thing in things:
        if thing.kind and thing.kind.at and not thing.kind.is_obstacle:
            _check_places(thing, thing.kind.at, things, scene, findings)


def _check_places(
    thing: Part[Any], at: Sequence[Place], things: Sequence[Part[Any]], scene: SceneKind | None, findings: Findings
) -> None:
    for other in things:
        if other.kind and any(box.holds(place) for box in other.kind.standing(scene) for place in at):
            hint = f"Write another place for {thing.name} or {other.name}."
            there = Label(other.span, "this one")
            findings.error("inside-obstacle", thing.span, "An obstacle stands there.", hint, there)
            return
