"""Worlds of locks from before things said what becomes of them, brought along as far as they know it."""

from collections.abc import Mapping
from typing import Any

from mindrun.kinds.things.thing import MOVES

ONE_ANYWHERE = {"at": [], "count": 1}  # what every thing was before there was a word for it
EVENTS = {"reached": "reach", "delivered": "delivery"}


def migrate_facts(facts: Mapping[str, Any]) -> dict[str, Any]:
    """The facts of a world; a thing moved where a reward or an end of its task named it.

    What was only counted is not known, so nothing is said of that.
    """
    named = {*facts.get("task", {}).get("ends", ())}
    named |= {reason.removeprefix("on ").partition(" when ")[0] for _, reason in facts["rewards"]}
    return {subject: _with_outcomes(subject, fact, named) for subject, fact in facts.items()}


def _with_outcomes(subject: str, fact: Any, named: set[str]) -> Any:
    noun, _, name = subject.partition(" ")
    if noun != "thing":
        return fact
    outcomes = {field: MOVES for field, event in EVENTS.items() if f"{event} of {name}" in named}
    return ONE_ANYWHERE | outcomes | fact  # what it says itself counts
