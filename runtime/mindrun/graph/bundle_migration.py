"""Graphs of older bundles, brought along: what has got words of its own since is said in them."""

from dataclasses import fields
from typing import Any

from mindrun.kinds.registry import kinds
from mindrun.kinds.things.thing import MOVES, STAYS


def migrate_graph(graph: Any) -> Any:
    """The data of a graph from before things said what becomes of them: one moved where a line of its task named it.

    Data that is no graph stays as it is: who decodes it says what is wrong.
    """
    try:
        return graph | {"tasks": [_task(task) for task in graph["tasks"]]}
    except (TypeError, LookupError):
        return graph


def with_programs(graph: Any) -> Any:
    """The data of a graph from before conditions were programs: each was a comparison, and ends had none."""
    try:
        return graph | {"tasks": [_with_conditions(task) for task in graph["tasks"]]}
    except (TypeError, LookupError):
        return graph


def _with_conditions(task: Any) -> Any:
    ends = [{"event": event} for event in task["ends"]]  # the rest is as where nothing is said
    return task | {"rewards": [_reward(reward) for reward in task["rewards"]], "ends": ends}


def _reward(reward: Any) -> Any:
    when = reward["when"]
    return reward | {"when": [*when["left"], *when["right"], [when["compare"], 0]]} if when else reward


def with_whole_lessons(graph: Any) -> Any:
    """The data of a graph whose lessons say all there is to say: what they do not is as where nothing is said.

    No lesson acts in a bundle, so a new argument makes no new format.
    """
    try:
        return graph | {"lessons": [_lesson(lesson) for lesson in graph["lessons"]]}
    except (TypeError, LookupError):
        return graph


def _lesson(lesson: Any) -> Any:
    """A lesson from before it had a number, needs, or another skill to start from, and its learner all arguments."""
    learner = lesson["learner"]
    usual = {field.name: field.default for field in fields(kinds("curriculum")[learner["is"]])}
    return {"number": 0, "starts_from": "", "needs": []} | lesson | {"learner": usual | learner}


def _task(task: Any) -> Any:
    named = {(event["is"], event["of"]) for event in task["events"] if event["is"] in ("reach", "delivery")}
    return task | {"things": [thing | {"kind": thing["kind"] | _outcomes(thing, named)} for thing in task["things"]]}


def _outcomes(thing: Any, named: set[Any]) -> dict[str, str]:
    """What became of a thing."""
    name, kind = thing["name"], thing["kind"]["is"]
    outcomes: dict[str, str] = {}
    if kind in ("item", "zone", "power"):
        outcomes["reached"] = MOVES if ("reach", name) in named else STAYS
    if kind == "item":
        outcomes["delivered"] = MOVES if ("delivery", name) in named else STAYS
    return outcomes
