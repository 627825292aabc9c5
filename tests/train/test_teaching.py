"""Which lessons are due."""

from pathlib import Path

from mindrun.graph import Lesson

from mindlang.compile import load
from mindlang.lock import Entry, Signature, Taught
from mindlang.lock.status import Trained, Untaught
from mindlang.school.teaching import is_due

COLLECT = Path(__file__).parents[2] / "examples" / "collect" / "collect.mind"


def taught_on(task: str, master: str) -> Trained:
    entry = Entry("Avoid", Signature("mlp hidden 2 width 14", (), ()), "0" * 64, Taught(task, master, 10, 10, 1, 1.0))
    return Trained(entry, ())


def test_a_later_lesson_of_a_taught_skill_is_due_until_it_has_been_given() -> None:
    """Scenario 2: Avoid, taught alone, is due on the job; taught on the job, neither lesson is due."""
    graph = load(COLLECT).graph
    assert graph

    def before(lesson: Lesson) -> tuple[Lesson, ...]:
        return graph.lessons[: graph.lessons.index(lesson)]

    alone, on_the_job = (lesson for lesson in graph.lessons if lesson.skill == "Avoid")
    assert is_due(alone, before(alone), Untaught())
    assert not is_due(alone, before(alone), taught_on("Avoid", "Avoid"))
    assert is_due(on_the_job, before(on_the_job), taught_on("Avoid", "Avoid"))
    assert not is_due(alone, before(alone), taught_on("Collect", "Collect"))
    assert not is_due(on_the_job, before(on_the_job), taught_on("Collect", "Collect"))
