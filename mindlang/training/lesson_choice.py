"""The lessons to teach: those of a curriculum, those asked for, and what must be taught before them."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from mindrun.errors import MindError
from mindrun.graph.graph import Graph, Lesson
from mindrun.train import NotFoundError, RunError

from mindlang import limits
from mindlang.compiler.compile import Compiled
from mindlang.compiler.diagnostic import did_you_mean, listed
from mindlang.training.subject import Subject, open_subject, refuse_failed_below, refuse_frozen

BOUNDS = {
    "generations": limits.GENERATION_BOUNDS,
    "population": limits.POPULATION_BOUNDS,
    "attempts": limits.ATTEMPT_BOUNDS,
    "rungs": limits.RUNG_BOUNDS,
}
MAX_SCALE = 1000


@dataclass(frozen=True, slots=True)
class TrainOptions:
    """Numbers that the command line or a program says instead of the source; None leaves one as it stands there.

    `scale` multiplies the generations of a lesson.

    >>> mindlang.TrainOptions(scale=0.1, attempts=3)
    TrainOptions(generations=None, scale=0.1, population=None, attempts=3, rungs=None, from_scratch=False)
    """

    generations: int | None = None
    scale: float = 1.0
    population: int | None = None
    attempts: int | None = None
    rungs: int | None = None
    from_scratch: bool = False

    def __post_init__(self) -> None:
        """MindError where a number is none that `mindc train` would take."""
        for what in BOUNDS:
            if (value := getattr(self, what)) is not None:
                number = limits.bounded_int(what, BOUNDS[what], value)  # one of numpy becomes an int
                object.__setattr__(self, what, number)
        if not 0 < self.scale <= MAX_SCALE:
            raise MindError(f"scale cannot be {self.scale!r}", f"scale is a number above 0, and at most {MAX_SCALE}")

    def applied(self, lesson: Lesson) -> Lesson:
        """The lesson with these numbers; one with fewer generations than in the source `needs` nothing."""
        learner = replace(
            lesson.learner,
            population=self.population or lesson.learner.population,
            attempts=self.attempts or lesson.learner.attempts,
            rungs=lesson.learner.rungs if self.rungs is None else self.rungs,
        )
        generations = max(1, round(self.scale * (self.generations or lesson.generations)))
        return replace(
            lesson,
            generations=generations,
            needs=lesson.needs if generations >= lesson.generations else (),
            from_scratch=self.from_scratch or lesson.from_scratch,
            starts_from="" if self.from_scratch else lesson.starts_from,
            learner=learner,
        )


def lessons_to_teach(
    path: Path,
    compiled: Compiled,
    curriculum: str | None,
    skills: Sequence[str],
    options: TrainOptions,
    force: bool = False,
    note: Callable[[str], object] = lambda line: None,
) -> Iterator[tuple[Subject, Lesson]]:
    """The lessons of a file that are due, or those asked for, each with the options and the lock as it is by then.

    With `force` also what is not due. `note` is told what is not taught, or taught otherwise than the source says.
    """
    subject = open_subject(path, compiled)
    chosen = chosen_lessons(subject.graph, curriculum, skills)
    if skills or force:
        refuse_frozen(subject, chosen)
    taught = frozen = 0
    for lesson in chosen:
        subject = open_subject(path, compiled)  # the lesson before has changed the lock
        if not subject.standing(lesson):
            frozen += 1
            note(f"{lesson.skill} is frozen, and is not taught")
            continue
        if skills and not force:
            refuse_failed_below(subject, lesson)
        if force or skills or subject.is_due(lesson):
            wished = options.applied(lesson)
            if lesson.needs and not wished.needs:
                note(f"{lesson.skill} has fewer generations than its lesson says: nothing is needed of it")
            taught += 1
            yield subject, wished
    if not taught and len(chosen) == 1 and not frozen:
        note("nothing to do: its lesson has been taught (--force teaches it again)")
    elif not taught:
        which = "all other lessons" if frozen else f"all {len(chosen)} lessons"
        note(f"nothing to do: {which} have been taught (--force teaches them again)")


def chosen_lessons(graph: Graph, curriculum: str | None, skills: Sequence[str]) -> tuple[Lesson, ...]:
    """The lessons of a curriculum (the first where None), only those of `skills` where there are any, in their order.

    A skill that the first curriculum does not teach is looked for in the others. NotFoundError for an unknown name.
    """
    if not graph.lessons:
        raise RunError(
            "there is nothing to teach", "add a curriculum that says: teaches SKILL on TASK for N generations"
        )
    names = list(dict.fromkeys(lesson.curriculum for lesson in graph.lessons))
    if curriculum is not None and curriculum not in names:
        raise NotFoundError(f"there is no curriculum called {curriculum}", _suggestion(curriculum, names))
    if not skills:
        return _of(graph, curriculum or names[0])
    searched = [curriculum] if curriculum else names
    asked = [lesson for skill in skills for lesson in _teaching(graph, searched, skill)]
    return tuple(lesson for lesson in graph.lessons if lesson in asked)


def _of(graph: Graph, curriculum: str) -> tuple[Lesson, ...]:
    return tuple(lesson for lesson in graph.lessons if lesson.curriculum == curriculum)


def _teaching(graph: Graph, curricula: Sequence[str], skill: str) -> tuple[Lesson, ...]:
    for curriculum in curricula:
        if found := tuple(lesson for lesson in _of(graph, curriculum) if lesson.skill == skill):
            return found
    if owner := next((each.like for each in graph.skills if each.name == skill), ""):
        raise NotFoundError(f"{skill} is like {owner}: it has no weights of its own to be taught", f"teach {owner}")
    taught = [lesson.skill for curriculum in curricula for lesson in _of(graph, curriculum)]
    raise NotFoundError(f"no lesson teaches {skill}", _suggestion(skill, taught))


def _suggestion(name: str, known: Sequence[str]) -> str:
    return did_you_mean(name, known) or f"There is {listed(dict.fromkeys(known), 'and')}"
