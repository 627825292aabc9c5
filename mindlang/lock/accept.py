"""Weights that a person says will do in another world than the one in which they were taught."""

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from mindrun.graph.graph import Graph
from mindrun.graph.skill_sets import learners, owner_of, owners, reachable

from mindlang.lock import Entry, Lock, LockError, lock_path, read_lock, read_locks, write_lock
from mindlang.lock.blobs import FOLDER, exclusive_folder
from mindlang.lock.lessons import in_question, key_of, key_of_taught, last_lesson, lessons_of
from mindlang.lock.status import Trained, status
from mindlang.lock.training_world import TrainingWorld
from mindlang.lock.world_facts import Worlds


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
        mine = {skill: entry for skill, entry in entries.items() if skill in read_lock(path)}
        if mine:
            _write(path, mine)
        entries = {skill: entry for skill, entry in entries.items() if skill not in mine}


def _write(path: Path, entries: Lock) -> None:
    try:
        with exclusive_folder(path.parent / FOLDER):
            write_lock(path, read_lock(path) | dict(entries))
    except OSError as error:
        raise LockError(f"{path} cannot be written: {error.strerror}") from error


def _accepted(graph: Graph, lock: Lock, folder: Path, entry: Entry) -> Entry:
    taught = entry.taught
    last = last_lesson(graph.lessons, taught)
    teaching = [lesson for lesson in graph.lessons if entry.skill in learners(graph, lesson)]
    if entry.worlds:
        known = [lessons_of(graph, world, entry, teaching, last) for world in entry.worlds]
    else:
        known = [in_question([each for each in teaching if key_of(each) == key_of_taught(taught)], last)]
    lessons = [found[0] for found in known if found]
    if not lessons:
        raise LockError(
            f"no lesson of the mind teaches {entry.skill} on {taught.task}, so its world cannot be accepted"
        )
    worlds: tuple[TrainingWorld, ...] = tuple(Worlds(graph, folder).of(lesson) for lesson in lessons)
    below = (name for name in owners(reachable(graph, entry.skill)) if name != entry.skill and name in lock)
    subskills = tuple(sorted((name, lock[name].weights) for name in below))
    origin = entry.origin
    if origin and (now := lock.get(owner_of(graph, origin[0]))):
        origin = origin[0], now.weights
    return replace(entry, worlds=worlds, subskills=subskills, origin=origin, accepted=True)
