"""Whether a lesson has yet to be taught, by how those who learn in it stand to the lock."""

from collections.abc import Iterable, Mapping

from mindrun.graph.graph import Graph, Lesson, Need
from mindrun.graph.skill_sets import learners

from mindlang.lock import Taught
from mindlang.lock.lessons import key_of, key_of_taught
from mindlang.lock.status import Status, Trained


def is_due(graph: Graph, lesson: Lesson, states: Mapping[str, Status]) -> bool:
    """Whether a lesson has yet to be taught, by how its learners stand.

    Skills whose weights fit are left alone, except where they came from an earlier lesson that taught them, where the
    world of the lesson is another than the one in which they were taught, and where they are not known to have what it
    needs.
    """
    before = graph.lessons[: graph.lessons.index(lesson)]
    return any(
        _is_due(lesson, [other for other in before if skill in learners(graph, other)], state)
        for skill, state in states.items()
    )


def _is_due(lesson: Lesson, earlier: Iterable[Lesson], state: Status) -> bool:
    if not isinstance(state, Trained):
        return True
    if lesson in state.outdated:
        return True
    taught = key_of_taught(state.entry.taught)
    if key_of(lesson) == taught and not all(_has(state.entry.taught, each) for each in lesson.needs):
        return True  # taught by less than it needs, or before it needed that
    if state.last and state.last.curriculum == lesson.curriculum:
        return state.last.number < lesson.number
    return key_of(lesson) != taught and any(key_of(other) == taught for other in earlier)


def _has(taught: Taught, needed: Need) -> bool:
    """Whether what was taught is known to have what a lesson needs."""
    reached = taught.score if needed.measure == "score" else taught.success
    return reached is not None and reached > needed.above
