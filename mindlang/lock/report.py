"""The status of the skills of a mind, for people and for programs, and what a person accepts of that."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from mindrun.errors import system_errors_as
from mindrun.graph.graph import Graph, Lesson
from mindrun.graph.skill_sets import learners, owner_of, owners, reachable

from mindlang.compiler.diagnostic import listed
from mindlang.lock import Entry, Lock, LockError, Taught, lock_path, read_lock, read_locks, write_lock
from mindlang.lock.blobs import FOLDER, exclusive_folder, load_weights
from mindlang.lock.signature import arrange
from mindlang.lock.status import (
    NotLearning,
    Stale,
    Status,
    Trained,
    Untaught,
    elsewhere_sentences,
    is_due,
    last_lesson,
    lessons_of,
    status,
)
from mindlang.lock.world_facts import Worlds

ACCEPTED = "accepted by a person"


@dataclass(frozen=True, slots=True)
class Row:
    """A skill, how it stands, and what is wrong with the file of its weights if anything is.

    One that is not `needed` stands nowhere below the master, one that is `like` another has that one's weights. The
    lessons that are `due` teach one that is trained something else. Some functions say something of their weights.
    """

    skill: str
    status: Status
    is_frozen: bool
    is_needed: bool
    damage: str = ""
    like: str = ""
    due: tuple[Lesson, ...] = ()
    about_weights: str = ""

    @property
    def is_fine(self) -> bool:
        return isinstance(self.status, Trained | NotLearning) and not self.damage

    @property
    def word(self) -> str:
        return "damaged" if self.damage else self.status.word

    @property
    def remarks(self) -> tuple[str, ...]:
        """Why it cannot act, or what has changed since it was taught."""
        if self.damage:
            return (self.damage,)
        match self.status:
            case Stale(differences):
                return differences
            case Trained(entry, changes):
                due = (f"lesson {each.number} of {each.curriculum} is due, on {each.task}" for each in self.due)
                return (*changes, *[ACCEPTED] * entry.accepted, *due)
        return ()


def rows(graph: Graph, sources: Sequence[Path]) -> list[Row]:
    """Every skill, parents first; `sources` are the files of the mind. LockError where a lock is damaged."""
    lock = read_locks(sources)
    graph = arrange(graph, lock)
    states = status(graph, lock, sources[0].parent)
    needed = {skill.name for skill in reachable(graph, graph.master)}
    found = []
    for skill in graph.skills:
        state, damage, about = states[skill.name], "", ""
        try:
            if isinstance(state, Trained):
                weights = load_weights(state.entry, skill)
                about = skill.function.summary(weights, skill.outputs)
        except LockError as error:
            damage = str(error)
        due = _due(graph, skill.name, states)
        found.append(Row(skill.name, state, skill.frozen, skill.name in needed, damage, skill.like, due, about))
    return found


def _due(graph: Graph, skill: str, states: Mapping[str, Status]) -> tuple[Lesson, ...]:
    """The lessons that `mindc train` would teach a skill that is trained, in the first curriculum that teaches it."""
    state = states[skill]
    if not isinstance(state, Trained) or state.is_elsewhere:
        return ()
    teaching = [lesson for lesson in graph.lessons if lesson.skill == skill]
    teaching = [lesson for lesson in teaching if lesson.curriculum == teaching[0].curriculum]
    standing = {lesson: {name: states[name] for name in learners(graph, lesson)} for lesson in teaching}
    return tuple(lesson for lesson, learning in standing.items() if is_due(graph, lesson, learning))


def weights_text(row: Row) -> str:
    """The weights of a skill and how they came about, in words."""
    if not isinstance(row.status, Trained):
        return f"like {row.like}" * bool(row.like)
    entry = row.status.entry
    how = f"like {row.like}" if row.like else made_by(entry.taught)
    begun = f", begun as {entry.origin_file or entry.origin[0]}" if entry.origin and not row.like else ""
    about = f"{row.about_weights}, " * bool(row.about_weights)
    return f"{entry.weights[:4]}…  {about}{how}{begun}"


def made_by(taught: Taught) -> str:
    how = "not taught here"
    if taught.generations:
        how = f"{taught.generations} generations of {taught.population} from seed {taught.seed}"
    jointly = " with subskills" * taught.jointly
    return f"{taught.score:.1f} on {taught.task} under {taught.master}{jointly}, {how}"


def as_data(row: Row) -> dict[str, Any]:
    data: dict[str, Any] = {"skill": row.skill, "status": row.word, "frozen": row.is_frozen, "needed": row.is_needed}
    data["remarks"] = [*row.remarks]
    if row.like:
        data["like"] = row.like
    elif isinstance(row.status, Trained):
        entry = row.status.entry
        taught = {name: getattr(entry.taught, name) for name in Taught.__slots__}
        data |= {"weights": entry.weights, "taught": taught, "subskills": dict(entry.subskills)}
        data |= {"worlds": [world.name for world in entry.worlds], "accepted": entry.accepted}
        data |= {"about_weights": row.about_weights} if row.about_weights else {}
        if entry.origin:
            data["origin"] = dict([entry.origin])
    return data


def survival(found: Sequence[Row]) -> list[str]:
    """Sentences on which weights still fit: those that do in one, each of the others in its own."""
    found = [row for row in found if not row.like]  # what is said of the others' weights holds for theirs
    trained = [row.skill for row in found if isinstance(row.status, Trained) and not row.damage]
    lines = [f"weights of {listed(trained, 'and')} fit"] if trained else []
    lines += elsewhere_sentences({row.skill: row.status for row in found})
    lines += [row.damage for row in found if row.damage]
    lines += [f"{row.skill} is stale: {'; '.join(row.remarks)}" for row in found if isinstance(row.status, Stale)]
    return lines + [f"{row.skill} has not been taught" for row in found if isinstance(row.status, Untaught)]


def accept(graph: Graph, sources: Sequence[Path], skills: Sequence[str]) -> None:
    """Write into the locks of these files that the weights of these skills will do as the mind is now.

    LockError where one has no weights that fit, or none of its lessons is there any more; then nothing is written.
    """
    lock = read_locks(sources)
    skills = list(dict.fromkeys(owner_of(graph, skill) for skill in skills))
    states = status(graph, lock, sources[0].parent)
    for skill in skills:
        if not isinstance(states.get(skill), Trained):
            raise LockError(f"{skill} has no weights that fit, and none can be accepted")
    entries = {skill: _accepted(graph, lock, sources[0].parent, lock[skill]) for skill in skills}
    for path in map(lock_path, sources):
        if mine := {skill: entries.pop(skill) for skill in read_lock(path) if skill in entries}:
            with system_errors_as(LockError, f"{path} cannot be written"), exclusive_folder(path.parent / FOLDER):
                write_lock(path, read_lock(path) | mine)


def _accepted(graph: Graph, lock: Lock, folder: Path, entry: Entry) -> Entry:
    taught = entry.taught
    last = last_lesson(graph.lessons, taught)
    teaching = [lesson for lesson in graph.lessons if entry.skill in learners(graph, lesson)]
    known = [lessons_of(graph, world, entry, teaching, last) for world in entry.worlds]
    lessons = [found[0] for found in known if found]
    if not lessons:
        raise LockError(
            f"no lesson of the mind teaches {entry.skill} on {taught.task}, so its world cannot be accepted"
        )
    worlds = tuple(Worlds(graph, folder).of(lesson) for lesson in lessons)
    below = (name for name in owners(reachable(graph, entry.skill)) if name != entry.skill and name in lock)
    subskills = tuple(sorted((name, lock[name].weights) for name in below))
    origin = entry.origin
    if origin and (now := lock.get(owner_of(graph, origin[0]))):
        origin = origin[0], now.weights
    return replace(entry, worlds=worlds, subskills=subskills, origin=origin, accepted=True)
