"""The status of skills: weights that fit, what is different about those that do not; which lesson is due; and a mind
with the weights that it needs to act, with which `build`, `run` and `bench` begin.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING

from mindrun.graph.graph import Graph, Lesson, Skill, Task
from mindrun.graph.skill_sets import acting, below, genes, learners, owner_of, owners, reachable

from mindlang.compiler.diagnostic import listed
from mindlang.compiler.source import Source
from mindlang.lock import Entry, Lock, Taught, lock_sources, read_locks
from mindlang.lock.blobs import load_weights
from mindlang.lock.signature import arrange, differences, reordered, signature
from mindlang.lock.training_world import LessonKey, TrainingWorld
from mindlang.lock.world_changes import changes
from mindlang.lock.world_facts import Worlds

if TYPE_CHECKING:
    from mindrun.graph.policy import Policy
    from mindrun.numbers.arrays import Weights


@dataclass(frozen=True, slots=True)
class Trained:
    """A skill whose weights fit. Where `changes` are, sentences, it was taught elsewhere: in a world that is not the
    mind's.

    `last` is the lesson that it was taught last, where that is known; `outdated` are those that have changed since.
    """

    entry: Entry
    changes: tuple[str, ...] = ()
    outdated: frozenset[Lesson] = frozenset()
    last: Lesson | None = None

    @property
    def is_elsewhere(self) -> bool:
        """The world in which it was taught is another now."""
        return bool(self.changes)

    @property
    def word(self) -> str:
        return "taught elsewhere" if self.is_elsewhere else "trained"


@dataclass(frozen=True, slots=True)
class Stale:
    """A skill that has changed since it was taught: its weights fit no longer; each difference is a sentence."""

    differences: tuple[str, ...]
    word = "stale"


@dataclass(frozen=True, slots=True)
class Untaught:
    """A skill that learns, and has no weights yet."""

    word = "untaught"


@dataclass(frozen=True, slots=True)
class NotLearning:
    """A skill that has no weights to learn."""

    word = "does not learn"


Status = Trained | Stale | Untaught | NotLearning


def mismatches(graph: Graph, skill: Skill, entry: Entry) -> tuple[str, ...]:
    """The differences between a skill and the declaration that the weights of its line in a lock fit, in sentences."""
    return differences(entry.signature, signature(graph, skill), skill.function.derived)


def status(graph: Graph, lock: Lock, folder: Path | None = None) -> dict[str, Status]:
    """The status of each skill of a mind by its lock, one that is like another as that one; reads no weights.

    Procedures count where they are found in `folder`.
    """
    standing = _Standing(graph, lock, folder)
    own = {skill.name: standing.of(index) for index, skill in enumerate(graph.skills) if not skill.like}
    return {skill.name: own[skill.owner] for skill in graph.skills}


@dataclass(frozen=True)
class _Standing:
    """A mind held against a lock."""

    graph: Graph
    lock: Lock
    folder: Path | None

    def of(self, index: int) -> Status:
        skill = self.graph.skills[index]
        if genes(skill) == 0:
            return NotLearning()
        if (entry := self.lock.get(skill.name)) is None:
            return Untaught()
        found = (*mismatches(self.graph, skill, entry), *reordered(entry, self.graph))
        return Stale(found) if found else self._trained(index, entry)

    def _trained(self, index: int, entry: Entry) -> Trained:
        alike = self._lessons[key_of_taught(entry.taught)]
        last, changed, outdated = last_lesson(alike, entry.taught), list[str](), set[Lesson]()
        for world in entry.worlds:
            lessons = lessons_of(self.graph, world, entry, self._teaching[entry.skill], last)
            if not lessons and world != entry.worlds[-1]:
                continue  # it has learnt something since, and nothing could teach it that again
            told = {lesson: self._world_changes(world, lesson) for lesson in lessons}
            if all(told.values()):  # one that is just as the world says may have another name now
                others = (each for each in self._teaching[entry.skill] if each not in told)
                alike_else = (each for each in others if each.with_subskills == world.lesson.jointly)
                same = [each for each in alike_else if not self._world_changes(world, each)]
                told = {lesson: [] for lesson in same} or told
            fewest: list[str] = min(told.values(), key=len) if told else self._world_changes(world, None)
            changed += fewest
            outdated |= {lesson for lesson, said in told.items() if said}
        if other := [*self._other_origin(entry)]:
            changed += other
            outdated |= {each for each in self.graph.lessons if each.starts_from and each.skill == entry.skill}
        subskills = [*self._subskill_changes(index, entry)]
        if subskills:
            outdated |= {*in_question(alike, last)}
        return Trained(entry, tuple(dict.fromkeys((*subskills, *changed))), frozenset(outdated), last)

    def _world_changes(self, world: TrainingWorld, lesson: Lesson | None) -> list[str]:
        """The changes of a training world; `lesson` is the mind's own that teaches in it, None where there is none."""
        key = world.lesson
        if lesson:
            return changes(world, self._worlds.of(lesson))
        if all(task.name != key.task for task in self.graph.tasks):
            return [f"its task {key.task} is gone"]
        if key.master not in self.graph.skill_numbers:
            return [f"its master {key.master} is gone"]
        return changes(world, self._worlds.of_gone(key, world.facts["lesson"]))

    def _subskill_changes(self, index: int, entry: Entry) -> Iterator[str]:
        """The differences in the learnt skills below one, except those made by a lesson in which it took part."""
        subskills = {*owners(below(self.graph, index))} - {entry.skill}
        for skill, weights in entry.subskills:
            now = self.lock.get(skill)
            if skill not in subskills:
                yield f"taught with {skill} ({weights[:4]}…), which is not below it now"
            elif now is None:
                yield f"taught with {skill} ({weights[:4]}…), which has no weights now"
            elif now.weights != weights and not self._took_part(entry.skill, now):
                yield f"taught with another {skill} ({weights[:4]}…, now {now.weights[:4]}…)"
        known = {skill for skill, _ in entry.subskills}
        yield from (f"taught without {skill}" for skill in sorted(subskills - known))

    def _other_origin(self, entry: Entry) -> Iterator[str]:
        """The difference in the weights of the skill from which one began, except by a lesson in which it took part."""
        if entry.origin is None or entry.origin_file:
            return
        name, weights = entry.origin
        now = self.lock.get(owner_of(self.graph, name))
        if now is None:
            yield f"began with {name} ({weights[:4]}…), which has no weights now"
        elif now.weights != weights and not self._took_part(entry.skill, now):
            yield f"began with another {name} ({weights[:4]}…, now {now.weights[:4]}…)"

    def _took_part(self, skill: str, taught: Entry) -> bool:
        """True if a skill acted in the lesson in which another was taught."""
        master = taught.taught.master
        if master not in self._acting:
            below_it = reachable(self.graph, master) if master in self.graph.skill_numbers else ()
            self._acting[master] = {name for each in below_it for name in (each.name, each.owner)}
        return master != taught.skill and skill in self._acting[master]

    @cached_property
    def _acting(self) -> dict[str, set[str]]:
        """The skills that a master reaches, by master, as far as they were asked for."""
        return {}

    @cached_property
    def _worlds(self) -> Worlds:
        return Worlds(self.graph, self.folder)

    @cached_property
    def _teaching(self) -> dict[str, list[Lesson]]:
        found: dict[str, list[Lesson]] = defaultdict(list)
        for lesson in self.graph.lessons:
            for skill in learners(self.graph, lesson):
                found[skill].append(lesson)
        return found

    @cached_property
    def _lessons(self) -> dict[LessonKey, list[Lesson]]:
        found: dict[LessonKey, list[Lesson]] = defaultdict(list)
        for lesson in self.graph.lessons:
            found[key_of(lesson)].append(lesson)
        return found


def trained_weights(
    graph: Graph, lock: Lock, skills: Collection[str], fresh: Mapping[Path, Weights] | None = None
) -> tuple[dict[str, Weights], list[str]]:
    """The weights of those of `skills` that learn, and a message for each that has none or stale ones.

    They stand under the names of the skills that own them. The graph must be `arrange`d. LockError where a file of
    weights is damaged; those that are `fresh` have not been written yet.
    """
    weights: dict[str, Weights] = {}
    refusals = []
    states = status(graph, lock)
    wanted = {skill.owner for skill in graph.skills if skill.name in skills}
    for skill in graph.skills:
        if skill.name not in wanted:
            continue
        frozen = " (and is frozen: unfreeze it first)" * skill.frozen
        match states[skill.name]:
            case Trained(entry):
                weights[skill.name] = load_weights(entry, skill, fresh or {})
            case Stale(found):
                refusals.append(f"the weights of {skill.name} are stale: {'; '.join(found)}{frozen}")
            case Untaught():
                refusals.append(f"{skill.name} has not been taught{frozen}")
    return weights, refusals


def key_of(lesson: Lesson) -> LessonKey:
    """The key of a lesson: which one it is, whatever its curriculum says of how it is learnt."""
    return LessonKey(lesson.task, lesson.master, lesson.with_subskills)


def key_of_taught(taught: Taught) -> LessonKey:
    """The key of the lesson that a line of a lock tells of last."""
    return LessonKey(taught.task, taught.master, taught.jointly)


def last_lesson(lessons: Iterable[Lesson], taught: Taught) -> Lesson | None:
    """The one of these lessons that a line of a lock tells of; None where it does not say, or tells of another."""
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
    """The lessons, of those `teaching` a skill, that a world of its line may be of; `last` is the one taught last.

    A task or a master that is gone may have another name now: then they are those that the line does not know.
    """
    key, teaching = world.lesson, [*teaching]
    if found := [lesson for lesson in teaching if key_of(lesson) == key]:
        return in_question(found, last)
    known = {each.lesson for each in entry.worlds}
    is_task_gone = key.task not in {task.name for task in graph.tasks}
    is_master_gone = key.master not in graph.skill_numbers
    return [
        each
        for each in teaching
        if key_of(each) not in known
        and (each.task == key.task or is_task_gone)
        and (each.master == key.master or is_master_gone)
        and each.with_subskills == key.jointly
    ]


def needed_skills(graph: Graph, lesson: Lesson) -> set[str]:
    """The skills without whose weights a lesson cannot begin: those that act in it and do not learn, and its origin."""
    return {*subskills(graph, lesson)} | ({owner_of(graph, lesson.starts_from)} if lesson.starts_from else set())


def subskills(graph: Graph, lesson: Lesson) -> tuple[str, ...]:
    """The skills whose weights act in a lesson and do not learn: all below its master but the learners."""
    taught = learners(graph, lesson)
    task = next(task for task in graph.tasks if task.name == lesson.task)
    return tuple(name for name in owners(acting(graph, task, lesson.master)) if name not in taught)


def is_due(graph: Graph, lesson: Lesson, states: Mapping[str, Status]) -> bool:
    """True if a lesson has yet to be taught, by how its learners stand.

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
    had = ((need, state.entry.taught.reached(need)) for need in lesson.needs)
    if key_of(lesson) == taught and not all(value is not None and need.is_met(value) for need, value in had):
        return True  # taught by less than it needs, or before it needed that
    if state.last and state.last.curriculum == lesson.curriculum:
        return state.last.number < lesson.number
    return key_of(lesson) != taught and any(key_of(other) == taught for other in earlier)


@dataclass(frozen=True, slots=True)
class ReadyMind:
    """A policy, with its master and the weights of all skills below it; `refusals` say what is missing.

    `notes` say which of these skills were taught in a world that is not the mind's.
    """

    policy: Policy
    refusals: tuple[str, ...]
    notes: tuple[str, ...]


def make_ready(
    graph: Graph, sources: Iterable[Source], master: str | None = None, task: Task | None = None
) -> ReadyMind:
    """The graph of these sources with the weights of their locks; LockError where a lock or weights are damaged.

    Of a task these are the weights of all who act in it.
    """
    from mindrun.graph.policy import Policy  # which needs numpy

    sources = tuple(sources)
    lock = read_locks(lock_sources(sources))
    graph = replace(arrange(graph, lock), master=master or graph.master)
    acts = acting(graph, task, graph.master) if task else reachable(graph, graph.master)
    needed = [skill.name for skill in acts]
    weights, refusals = trained_weights(graph, lock, frozenset(needed))
    states = status(graph, lock, sources[0].folder)
    notes = elsewhere_sentences({name: states[name] for name in needed})
    return ReadyMind(Policy(graph, weights), tuple(refusals), tuple(notes))


def elsewhere_sentences(states: Mapping[str, Status]) -> Iterator[str]:
    """A sentence for all skills that were taught elsewhere in the same way."""
    ways: dict[tuple[str, ...], list[str]] = {}
    for name, state in states.items():
        if isinstance(state, Trained) and state.is_elsewhere:
            ways.setdefault(state.changes, []).append(name)
    for said, skills in ways.items():
        yield f"{listed(skills, 'and')} {'was' if len(skills) == 1 else 'were'} taught elsewhere: {'; '.join(said)}"
