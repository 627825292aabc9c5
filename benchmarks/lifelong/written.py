"""A sequence of tasks whose lessons are written below the text of a robot, each with its task and the skills for it.

A lesson of a hierarchy is two skills: Own1 drives, and Seek1 above it sends influence to it and to skills of earlier
lessons. In the text these are the last ones, so that all earlier ones stand below; the agent chooses others.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from mindrun.kinds.learners import Genetic

from benchmarks.lifelong.sequence import Stage, TaskSequence
from benchmarks.workloads import graph_of
from mindlang.compiler.compile import compile_source
from mindlang.compiler.source import Source

EARLIER_SKILLS = 3  # of earlier lessons, that a lesson's may influence
EVENT_POINTS = 10  # for what a task counts
DIGITS = "0123456789"


@dataclass(frozen=True, slots=True)
class WrittenLesson:
    """A lesson: the name of its task and its skill, a verb and a number, what the skills read, and the task's lines."""

    name: str
    reads: Sequence[str]
    task: Sequence[str]

    @property
    def verb(self) -> str:
        """The name without its number."""
        return self.name.rstrip(DIGITS)

    @property
    def own(self) -> str:
        """The name of the skill that drives."""
        return self.name.replace(self.verb, "Own")


def mind_text(robot: str, lessons: Sequence[WrittenLesson]) -> str:
    """The text of a robot, in a file beside this one, with skills and tasks."""
    text = [Path(__file__).with_name(robot).read_text(encoding="utf-8")]
    always = ["  influences Grab at 1"] * ("\nskill Grab" in text[0])
    for i, lesson in enumerate(lessons):
        reads = [f"  reads {sensor}" for sensor in lesson.reads]
        below = [lesson.own, *(each.name for each in lessons[max(0, i - EARLIER_SKILLS) : i])]
        text += [f"\nskill {lesson.own} is mlp hidden 2", *reads, "  drives left_wheel", "  drives right_wheel"]
        text += [f"\nskill {lesson.name} is mlp hidden 1", *reads, *(f"  influences {each}" for each in below), *always]
        text += [f"\ntask {lesson.name} {lesson.task[0]}", *lesson.task[1:]]
    return "\n".join(text)


def sequence_of(
    robot: str, lessons: Sequence[WrittenLesson], nominal_counts: Mapping[str, float], **more: Any
) -> TaskSequence:
    """The sequence of these lessons, in which a good skill counts so much in a run, by the verb."""
    return TaskSequence(
        graph_of(compile_source(Source(robot, mind_text(robot, lessons)))),
        net="Net",
        tasks=tuple(each.name for each in lessons),
        good=tuple(EVENT_POINTS * nominal_counts[each.verb] for each in lessons),
        done=(1.0,) * len(lessons),
        stages=tuple((Stage(each.name, (each.name, each.own)),) for each in lessons),
        learner=Genetic(octaves=2, short=0.3),
        earlier=EARLIER_SKILLS,
        is_shared_evenly=True,
        is_best_of_all=True,
        **more,
    )
