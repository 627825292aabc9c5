"""How the skills of a mind stand to their weights, for people and for programs."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from mindrun.graph.graph import Graph, Lesson, Skill
from mindrun.graph.skill_sets import learners, reachable

from mindlang.compiler.diagnostic import listed
from mindlang.lock import LockError, Taught, read_locks
from mindlang.lock.arrange import arrange
from mindlang.lock.blobs import load_weights
from mindlang.lock.due import is_due
from mindlang.lock.ready import elsewhere_sentences
from mindlang.lock.status import UNKNOWN, NotLearning, Stale, Status, Trained, Untaught, status

ACCEPTED = "accepted by a person"


@dataclass(frozen=True, slots=True)
class Row:
    """A skill, how it stands, and what is wrong with the file of its weights if anything is.

    One that is not `needed` stands nowhere below the master, one that is `like` another has that one's weights. The
    lessons that are `due` teach one that is trained something else.
    """

    skill: str
    status: Status
    is_frozen: bool
    is_needed: bool
    damage: str = ""
    like: str = ""
    due: tuple[Lesson, ...] = ()

    @property
    def is_fine(self) -> bool:
        """Whether it can act."""
        return isinstance(self.status, Trained | NotLearning) and not self.damage

    @property
    def word(self) -> str:
        """How it stands, in a word or two."""
        if self.damage:
            return "damaged"
        match self.status:
            case Trained():
                return "taught elsewhere" if self.status.is_elsewhere else "trained"
            case Stale():
                return "stale"
            case Untaught():
                return "untaught"
        return "does not learn"

    @property
    def remarks(self) -> tuple[str, ...]:
        """Why it cannot act, or what has changed since it was taught."""
        if self.damage:
            return (self.damage,)
        match self.status:
            case Stale(differences):
                return differences
            case Trained(entry, changes):
                if not entry.worlds:
                    return (*changes, f"taught {UNKNOWN}")
                due = (f"lesson {each.number} of {each.curriculum} is due, on {each.task}" for each in self.due)
                return (*changes, *[ACCEPTED] * entry.accepted, *due)
        return ()


def rows(graph: Graph, sources: Sequence[Path]) -> list[Row]:
    """Every skill, parents first; `sources` are the files of the mind. LockError where a lock is damaged."""
    lock = read_locks(sources)
    graph = arrange(graph, lock)
    states = status(graph, lock, sources[0].parent)
    needed = {skill.name for skill in reachable(graph, graph.master)}
    return [
        Row(skill.name, state, skill.frozen, skill.name in needed, _damage(skill, state), skill.like, due)
        for skill in graph.skills
        for state, due in [(states[skill.name], _due(graph, skill.name, states))]
    ]


def _due(graph: Graph, skill: str, states: Mapping[str, Status]) -> tuple[Lesson, ...]:
    """The lessons that `mindc train` would teach a skill that is trained, in the first curriculum that teaches it."""
    state = states[skill]
    if not isinstance(state, Trained) or state.is_elsewhere:
        return ()
    teaching = [lesson for lesson in graph.lessons if lesson.skill == skill]
    teaching = [lesson for lesson in teaching if lesson.curriculum == teaching[0].curriculum]
    standing = {lesson: {name: states[name] for name in learners(graph, lesson)} for lesson in teaching}
    return tuple(lesson for lesson, learning in standing.items() if is_due(graph, lesson, learning))


def _damage(skill: Skill, state: Status) -> str:
    """What is wrong with a trained skill's weights."""
    if isinstance(state, Trained):
        try:
            load_weights(state.entry, skill)
        except LockError as error:
            return str(error)
    return ""


def made(row: Row) -> str:
    """Which weights a skill has, and how they came about."""
    if not isinstance(row.status, Trained):
        return f"like {row.like}" * bool(row.like)
    entry = row.status.entry
    how = f"like {row.like}" if row.like else made_by(entry.taught)
    begun = f", begun as {entry.origin_file or entry.origin[0]}" if entry.origin and not row.like else ""
    return f"{entry.weights[:4]}…  {how}{begun}"


def made_by(taught: Taught) -> str:
    """How a genome came about, in words."""
    under = f" under {taught.master}"
    jointly = " with subskills" * taught.jointly
    if not taught.generations:
        return f"{taught.score:.1f} on {taught.task}{under}, not taught here"
    return (
        f"{taught.score:.1f} on {taught.task}{under}{jointly}, "
        f"{taught.generations} generations of {taught.population} from seed {taught.seed}"
    )


def as_data(row: Row) -> dict[str, Any]:
    """A row as plain data."""
    data: dict[str, Any] = {"skill": row.skill, "status": row.word, "frozen": row.is_frozen, "needed": row.is_needed}
    data["remarks"] = [*row.remarks]
    if row.like:
        data["like"] = row.like
    elif isinstance(row.status, Trained):
        entry = row.status.entry
        taught = {name: getattr(entry.taught, name) for name in Taught.__slots__}
        data |= {"weights": entry.weights, "taught": taught, "subskills": dict(entry.subskills)}
        data |= {"worlds": [world.name for world in entry.worlds], "accepted": entry.accepted}
        if entry.origin:
            data["origin"] = dict([entry.origin])
    return data


def survival(found: Sequence[Row]) -> list[str]:
    """Which weights still fit, as sentences: those that do in one, each of the others in its own."""
    found = [row for row in found if not row.like]  # what is said of the others' weights holds for theirs
    trained = [row.skill for row in found if isinstance(row.status, Trained) and not row.damage]
    lines = [f"weights of {listed(trained, 'and')} fit"] if trained else []
    lines += elsewhere_sentences({row.skill: row.status for row in found})
    lines += [row.damage for row in found if row.damage]
    lines += [f"{row.skill} is stale: {'; '.join(row.remarks)}" for row in found if isinstance(row.status, Stale)]
    return lines + [f"{row.skill} has not been taught" for row in found if isinstance(row.status, Untaught)]
