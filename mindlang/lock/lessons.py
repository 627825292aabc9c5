"""Which lessons of a mind a line of a lock tells of."""

from collections.abc import Collection, Iterable, Sequence

from mindrun.graph.graph import Graph, Lesson
from mindrun.graph.skill_sets import learners, owner_of, owners, reachable

from mindlang.lock import Entry, Taught
from mindlang.lock.training_world import LessonKey, TrainingWorld


def key_of(lesson: Lesson) -> LessonKey:
    """Which lesson it is, whatever its curriculum says of how it is learnt."""
    return LessonKey(lesson.task, lesson.master, lesson.with_subskills)


def key_of_taught(taught: Taught) -> LessonKey:
    """Which lesson it was that a line of a lock tells of last."""
    return LessonKey(taught.task, taught.master, taught.jointly)


def last_lesson(lessons: Iterable[Lesson], taught: Taught) -> Lesson | None:
    """Which of these lessons a line of a lock tells of; None where it does not say, or another stands there."""
    said = taught.number, taught.curriculum, key_of_taught(taught)
    return next((each for each in lessons if (each.number, each.curriculum, key_of(each)) == said), None)


def in_question(lessons: Sequence[Lesson], last: Lesson | None) -> Sequence[Lesson]:
    """The lessons that a world of a lock may be of, out of some with its key; the one taught last, if known, is first.

    Of its curriculum it is the only one: the worlds of those before it are forgotten.
    """
    if last is None or last not in lessons:
        return lessons
    return [last, *(each for each in lessons if each.curriculum != last.curriculum)]


def lessons_of(
    graph: Graph, world: TrainingWorld, entry: Entry, teaching: Iterable[Lesson], last: Lesson | None
) -> Sequence[Lesson]:
    """Those of the lessons `teaching` a skill that a world of its line may be of; `last` is the one taught last.

    A task or a master that is gone may have another name now: then they are those that the line does not know.
    """
    key, teaching = world.lesson, [*teaching]
    if found := [lesson for lesson in teaching if key_of(lesson) == key]:
        return in_question(found, last)
    known = {each.lesson for each in entry.worlds}
    gone = {key.task} - {task.name for task in graph.tasks}, {key.master} - graph.skill_numbers.keys()
    return [each for each in teaching if key_of(each) not in known and _may_be(key_of(each), key, *gone)]


def _may_be(now: LessonKey, key: LessonKey, tasks: Collection[str], masters: Collection[str]) -> bool:
    """Whether a lesson is another, `key`, but for the names of the task and the master that are gone."""
    same_task = now.task == key.task or key.task in tasks
    return same_task and (now.master == key.master or key.master in masters) and now.jointly == key.jointly


def needed_skills(graph: Graph, lesson: Lesson) -> set[str]:
    """The skills without whose weights a lesson cannot begin: those that act in it and do not learn, and its origin."""
    return {*subskills(graph, lesson)} | ({owner_of(graph, lesson.starts_from)} if lesson.starts_from else set())


def subskills(graph: Graph, lesson: Lesson) -> tuple[str, ...]:
    """The skills whose weights act in a lesson and do not learn: all below its master but the learners."""
    taught = learners(graph, lesson)
    return tuple(name for name in owners(reachable(graph, lesson.master)) if name not in taught)
