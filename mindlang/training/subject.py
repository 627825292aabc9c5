"""The subject of a lesson, a mind with its lock, and the run that a lesson of it becomes."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from datetime import datetime
from hashlib import sha256
from pathlib import Path

from mindrun.graph.graph import Graph, Lesson, Skill
from mindrun.graph.policy import Policy
from mindrun.graph.weights import Weights, learners
from mindrun.terminal.command_line import command_line
from mindrun.train import RunError
from mindrun.train.manifest import Manifest, fingerprint, hashes, processor, versions
from mindrun.train.run_folder import RunFolder, create, unfinished

from mindlang.compiler.compile import Compiled
from mindlang.compiler.diagnostic import listed
from mindlang.compiler.resolve.curricula import counterparts
from mindlang.limits import SEED_BOUNDS, bounded_int
from mindlang.lock import Lock, lock_path, lock_sources, read_lock, read_locks
from mindlang.lock.signature import arrange, places, signature, width
from mindlang.lock.status import Status, Trained, is_due, needed_skills, status, subskills, trained_weights


@dataclass(frozen=True, slots=True)
class Subject:
    """A mind in the order of its weights; `sources` has the text of its files, by path from the folder of `source`.

    `lock` has what its file's lock and those of the files that it uses say, which are `taught`; `homes` is where each
    curriculum stands.
    """

    source: Path
    sources: Mapping[str, str]
    graph: Graph
    lock: Lock
    homes: Mapping[str, Path]
    taught: Sequence[Path]

    @property
    def folder(self) -> Path:
        return self.source.parent

    @property
    def shown(self) -> Path:
        """The file as it is called here: from the working directory, where it lies there or below."""
        here = Path.cwd().resolve()
        return self.source.relative_to(here) if self.source.is_relative_to(here) else self.source

    @property
    def policy(self) -> Policy:
        """The hierarchy with the weights of all skills that were taught, and fit."""
        return Policy(self.graph, trained_weights(self.graph, self.lock, [*self.graph.skill_numbers])[0])

    def keep_path(self, lesson: Lesson) -> Path:
        """The lock to which goes what a lesson teaches: that of the file in which the lesson stands.

        Where a lock that counts before it has a line of a learner it is that one, or nothing would come of the lesson.
        """
        home = self.homes.get(lesson.curriculum, self.source)
        paths = [lock_path(path) for path in self.taught]
        known = (path for path in paths if not read_lock(path).keys().isdisjoint(learners(self.graph, lesson)))
        return min([lock_path(home), *known], key=paths.index)

    @property
    def trained(self) -> frozenset[str]:
        return frozenset(name for name, each in status(self.graph, self.lock).items() if isinstance(each, Trained))

    def standing(self, lesson: Lesson) -> dict[str, Status]:
        """The status of each learner of a lesson in the lock of `keep_path`, by the skill."""
        found = status(self.graph, read_lock(self.keep_path(lesson)), self.folder)
        return {skill: found[skill] for skill in learners(self.graph, lesson)}

    def is_due(self, lesson: Lesson) -> bool:
        return is_due(self.graph, lesson, self.standing(lesson))


def open_subject(path: Path, compiled: Compiled) -> Subject:
    """The subject of a file that compiled; LockError where its lock is damaged."""
    mind, graph = compiled.whole
    source, taught = path.resolve(), lock_sources(compiled.sources)
    lock = read_locks(taught)
    sources = {file.path.relative_to(source.parent).as_posix(): file.text for file in compiled.sources}
    places = {lesson.curriculum: lesson.fact.span.source.path for lesson in mind.lessons}
    homes = {curriculum: path for curriculum, path in places.items() if path in taught}
    return Subject(source, sources, arrange(graph, lock), lock, homes, taught)


def begin_run(
    subject: Subject, lesson: Lesson, seed: int, runs: Path, now: datetime, command: Sequence[str]
) -> RunFolder:
    """A run of a lesson, new unless the very same was stopped; it would come to the same end, bit for bit.

    It notes the time, and the `command` that asked for it. RunError where it cannot begin, and what to train first
    where that is why.
    """
    needed = subskills(subject.graph, lesson)
    weights, refusals = trained_weights(subject.graph, subject.lock, needed)
    if refusals:
        first = [skill for skill in reversed(needed) if skill not in weights]
        hint = f"first: {command_line('mindc', 'train', subject.shown, *first)}"
        own = [each for each in subject.graph.lessons if each.curriculum == lesson.curriculum]
        later = {each.skill for each in own if each.number > lesson.number}
        if waiting := sorted(later.intersection(first)):
            hint = (
                f"it and {listed(waiting, 'and')} wait for each other: add a lesson that teaches one of them "
                "without the other"
            )
        raise RunError(f"{lesson.skill} cannot be taught yet: {listed(refusals, 'and')}", hint)
    if not lesson.from_scratch:
        weights = weights | trained_weights(subject.graph, subject.lock, learners(subject.graph, lesson))[0]
    weights = weights | origin_weights(subject.graph, subject.lock, lesson, subject.shown)
    manifest = Manifest(
        lesson=lesson,
        learners=learners(subject.graph, lesson),
        seed=bounded_int("seed", SEED_BOUNDS, seed),
        mind=fingerprint(subject.graph, lesson, subject.folder),
        weights=hashes(weights),
        source=str(subject.source),
        sources={path: sha256(text.encode()).hexdigest() for path, text in subject.sources.items()},
        command=tuple(command),
        started=now.strftime("%Y-%m-%dT%H:%M:%SZ"),
        versions=versions(),
        processor=processor(),
    )
    return unfinished(runs, manifest) or create(runs, manifest, subject.sources, weights)


def refuse_failed_below(subject: Subject, lesson: Lesson) -> None:
    """RunError where a skill that acts in a lesson has yet to be taught what an earlier one of the curriculum needs."""
    below = needed_skills(subject.graph, lesson)
    for other in subject.graph.lessons:
        taught = below.intersection(learners(subject.graph, other))
        is_earlier = other.curriculum == lesson.curriculum and other.number < lesson.number
        if taught and is_earlier and other.needs and subject.is_due(other):
            needed, who = listed(map(str, other.needs), "and"), listed(sorted(taught), "and")
            raise RunError(
                f"{lesson.skill} would be taught on top of {who}, without what its lesson needs: {needed}",
                f"teach {who} first: {command_line('mindc', 'train', subject.shown, *sorted(taught))}; or say --force",
            )


def refuse_frozen(subject: Subject, chosen: Iterable[Lesson]) -> None:
    """RunError where a lesson has nobody to teach."""
    for lesson in chosen:
        if not learners(subject.graph, lesson):
            hint = command_line("mindc", "edit", "unfreeze", subject.shown, lesson.skill, "--write")
            raise RunError(f"{lesson.skill} is frozen", hint)


def refuse_changed(subject: Subject, run: RunFolder) -> None:
    """RunError where the run was begun with a mind that differs in something the lesson depends on."""
    if not is_mind_of(subject, run):
        skill = run.manifest.lesson.skill
        raise RunError(
            f"{subject.shown} has changed since this run of {skill} began, so it cannot go on",
            f"undo the change ({run.folder / 'source'} has it as it was), or begin anew: "
            + command_line("mindc", "train", subject.shown, skill),
        )


def is_mind_of(subject: Subject, run: RunFolder) -> bool:
    """True if a mind has all that the lesson of a run depends on, as it was when the run was begun."""
    lesson, graph = run.manifest.lesson, subject.graph
    return (
        {lesson.skill, lesson.master} <= graph.skill_numbers.keys()
        and any(task.name == lesson.task for task in graph.tasks)
        and learners(graph, lesson) == run.manifest.learners  # one may have been frozen
        and fingerprint(graph, lesson, subject.folder) == run.manifest.mind
    )


def origin_weights(graph: Graph, lock: Lock, lesson: Lesson, shown: Path) -> dict[str, Weights]:
    """The weights with which a lesson's skill begins; none where it starts from no other. The graph is `arrange`d.

    RunError where the other skill, or one that learns with the learner, has none that fit, and how to teach it in the
    file that is `shown`.
    """
    skills = {skill.name: skill for skill in graph.skills}
    together = learners(graph, lesson)
    if not lesson.starts_from or lesson.skill not in together:
        return {}
    origin = skills[lesson.starts_from]
    known: dict[str, Weights] = {}
    for needed in (origin.name, *(name for name in together if name != lesson.skill)):
        weights, refusals = trained_weights(graph, lock, [needed])
        if refusals:
            message = f"{lesson.skill} cannot begin with the weights of {origin.name}: {refusals[0]}"
            raise RunError(message, f"first: {command_line('mindc', 'train', shown, skills[needed].owner)}")
        known |= weights
    return {lesson.skill: _brought(graph, lesson, origin, known[origin.owner])}


def _brought(graph: Graph, lesson: Lesson, origin: Skill, weights: Weights) -> Weights:
    """Weights of one skill in the order in which another reads and sends what stands for the same; 0 for the new."""
    learner = next(skill for skill in graph.skills if skill.name == lesson.skill)
    own, its = signature(graph, learner), signature(graph, origin)
    begun = (each for each in graph.lessons if each.curriculum == lesson.curriculum and each.starts_from)
    heirs = {each.skill: each.starts_from for each in begun}
    kinds = {sensor.name: type(sensor.kind).__name__ for sensor in graph.sensors}
    inputs, outputs = (_places(*names, heirs, kinds) for names in ((own.reads, its.reads), (own.sends, its.sends)))
    before = sum(map(width, its.reads)), len(its.sends)
    wide = origin.function.widened(weights, before, learner.function, (len(inputs), len(outputs)))
    return learner.function.reordered(weights if wide is None else wide, inputs, outputs)


def _places(
    of: tuple[str, ...], among: tuple[str, ...], heirs: Mapping[str, str], kinds: Mapping[str, str]
) -> list[int]:
    """For each value of these names its place among those of the other names, behind which new ones are."""
    found = counterparts(of, among, heirs, kinds)
    if found is None:
        raise RunError("these weights do not fit", "run mindc check")
    return places(of, (*among, *(name for name in of if name not in found)), found)
