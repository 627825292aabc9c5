"""Which lessons are due."""

from dataclasses import replace
from pathlib import Path
from shutil import copy

import numpy as np
from mindrun.graph.weights import learners, parts

from mindlang.compiler.compile import load
from mindlang.lock import Entry, Signature, Taught
from mindlang.lock.status import Trained, Untaught, is_due, last_lesson, subskills
from mindlang.training.subject import open_subject

FOLDER = Path(__file__).parents[2] / "examples" / "collect"


ON_THE_JOB = """
curriculum Twice is genetic
  teaches Avoid on Avoid for 100 generations
  teaches Avoid on Collect under Collect for 100 generations
"""
JOINT = """
curriculum Joint is genetic
  teaches Collect on Collect for 100 generations with subskills
  teaches Avoid on Collect under Collect for 100 generations
"""


def taught_on(task: str, master: str, jointly: bool = False) -> Trained:
    taught = Taught(task, master, jointly, 10, 10, 1, 1.0)
    return Trained(Entry("Avoid", Signature("mlp hidden 2 width 14", (), ()), "0" * 64, taught), ())


def test_a_later_lesson_of_a_taught_skill_is_due_until_it_has_been_given(tmp_path: Path) -> None:
    """Scenario 2: Avoid, taught alone, is due on the job; taught on the job, neither lesson is due."""
    (tmp_path / "collect.mind").write_text((FOLDER / "collect.mind").read_text() + ON_THE_JOB)
    graph = load(tmp_path / "collect.mind").graph
    assert graph
    alone, on_the_job = (lesson for lesson in graph.lessons if lesson.curriculum == "Twice")
    assert is_due(graph, alone, {"Avoid": Untaught()})
    assert not is_due(graph, alone, {"Avoid": taught_on("Avoid", "Avoid")})
    assert is_due(graph, on_the_job, {"Avoid": taught_on("Avoid", "Avoid")})
    assert not is_due(graph, alone, {"Avoid": taught_on("Collect", "Collect")})
    assert not is_due(graph, on_the_job, {"Avoid": taught_on("Collect", "Collect")})


def test_a_joint_lesson_is_due_after_the_lessons_of_its_learners_and_is_no_lesson_of_one_alone(tmp_path: Path) -> None:
    (tmp_path / "collect.mind").write_text((FOLDER / "collect.mind").read_text() + ON_THE_JOB + JOINT)
    graph = load(tmp_path / "collect.mind").graph
    assert graph
    joint, after = (lesson for lesson in graph.lessons if lesson.curriculum == "Joint")
    assert (joint.name, after.name) == ("Collect-with-subskills", "Avoid-on-Collect")
    assert is_due(graph, joint, {"Avoid": taught_on("Avoid", "Avoid")})
    assert is_due(graph, joint, {"Avoid": taught_on("Collect", "Collect")})
    assert not is_due(graph, joint, {"Avoid": taught_on("Collect", "Collect", jointly=True)})
    assert is_due(graph, after, {"Avoid": taught_on("Collect", "Collect", jointly=True)})


def test_a_lesson_of_a_file_is_due_until_the_files_own_lock_has_it(tmp_path: Path) -> None:
    """The Avoid of avoid_longer.mind is to be taught, though collect.lock has one; collect's own lessons are not."""
    for name in ("collect.mind", "collect.lock", "avoid_longer.mind"):
        copy(FOLDER / name, tmp_path)
    path = tmp_path / "avoid_longer.mind"
    book = open_subject(path, load(path))
    own = [lesson for lesson in book.graph.lessons if lesson.curriculum == "AvoidLonger"]
    used = [lesson for lesson in book.graph.lessons if lesson.curriculum == "Collect"]
    assert {book.keep_path(lesson) for lesson in own} == {tmp_path / "avoid_longer.lock"}
    assert {book.keep_path(lesson) for lesson in used} == {tmp_path / "collect.lock"}
    assert [type(state) for lesson in own for state in book.standing(lesson).values()] == [Untaught] * 4
    assert [type(state) for lesson in used for state in book.standing(lesson).values()] == [Trained] * 6


def test_what_is_learnt_goes_where_it_counts(tmp_path: Path) -> None:
    """A curriculum of a used file teaches a skill of which the main file's lock has a line: that would hide another."""
    for name in ("collect.mind", "collect.lock"):
        copy(FOLDER / name, tmp_path)
    text = (tmp_path / "collect.mind").read_text()
    at = text.index("curriculum Collect ")
    (tmp_path / "lessons.mind").write_text(text[at:])
    (tmp_path / "collect.mind").write_text('use "lessons.mind"\n' + text[:at])
    path = tmp_path / "collect.mind"
    book = open_subject(path, load(path))
    assert {book.keep_path(lesson) for lesson in book.graph.lessons} == {tmp_path / "collect.lock"}
    (tmp_path / "collect.lock").unlink()
    book = open_subject(path, load(path))
    assert {book.keep_path(lesson) for lesson in book.graph.lessons} == {tmp_path / "lessons.lock"}


def test_with_subskills_all_below_learn_as_one_genome() -> None:
    graph = load(FOLDER / "final_task.mind").graph
    assert graph
    lesson = graph.lessons[0]
    whole = learners(graph, lesson)
    assert set(whole) == {s.name for s in graph.skills} - {"Grab", "Monolith"}
    genome = np.arange(1510, dtype=np.float32)
    assert [part[0] for part in parts(graph, whole, genome).values()][:2] == [0, 162]
    assert subskills(graph, lesson) == ()


ROUNDS = """
curriculum Rounds is genetic
  teaches Collect on Collect for 100 generations with subskills
  teaches Avoid on Collect under Collect for 100 generations
  teaches Collect on Collect for 100 generations with subskills
  teaches Collect on Collect for 9 generations with subskills using evolution_strategy
"""


def test_a_lesson_that_is_said_again_is_due_after_those_between(tmp_path: Path) -> None:
    """The lock says which lesson of its curriculum a skill has come to: what comes after is due.

    To a lesson of another curriculum its number says nothing.
    """
    (tmp_path / "collect.mind").write_text((FOLDER / "collect.mind").read_text() + JOINT + ROUNDS)
    graph = load(tmp_path / "collect.mind").graph
    assert graph
    rounds = [lesson for lesson in graph.lessons if lesson.curriculum == "Rounds"]
    after = next(lesson for lesson in graph.lessons if (lesson.curriculum, lesson.number) == ("Joint", 2))
    assert [lesson.number for lesson in rounds] == [1, 2, 3, 4]
    for last in rounds:
        entry = taught_on(last.task, last.master, last.with_subskills).entry
        numbered = replace(entry.taught, number=last.number, curriculum="Rounds")
        state = Trained(replace(entry, taught=numbered), last=last_lesson(graph.lessons, numbered))
        assert state.last == last
        assert [is_due(graph, lesson, {"Avoid": state}) for lesson in rounds] == [
            lesson.number > last.number for lesson in rounds
        ]
        assert is_due(graph, after, {"Avoid": state}) == last.with_subskills


def test_where_the_curriculum_was_changed_the_number_of_a_lesson_says_nothing(tmp_path: Path) -> None:
    (tmp_path / "collect.mind").write_text((FOLDER / "collect.mind").read_text() + ROUNDS)
    graph = load(tmp_path / "collect.mind").graph
    assert graph
    assert last_lesson(graph.lessons, Taught("Collect", "Collect", True, 1, 8, 1, 1.0, 2, "Rounds")) is None
    assert last_lesson(graph.lessons, Taught("Collect", "Collect", True, 1, 8, 1, 1.0, 7, "Rounds")) is None
    assert last_lesson(graph.lessons, Taught("Collect", "Collect", True, 1, 8, 1, 1.0)) is None
