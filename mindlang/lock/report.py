"""How the skills of a mind stand to their weights, for people and for programs."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from mindrun.graph import Graph

from mindlang.diagnostic import listed
from mindlang.lock import Taught, read_locks
from mindlang.lock.arrange import arrange
from mindlang.lock.status import NotLearning, Stale, Status, Trained, Untaught, status

if TYPE_CHECKING:
    from rich.table import Table

COLOURS = {"trained": "green", "stale": "red", "untaught": "yellow", "does not learn": "dim"}


@dataclass(frozen=True, slots=True)
class Row:
    """A skill, how it stands, and where it is frozen that it is."""

    skill: str
    status: Status
    is_frozen: bool

    @property
    def is_fine(self) -> bool:
        """Whether it can act."""
        return isinstance(self.status, Trained | NotLearning)

    @property
    def word(self) -> str:
        """How it stands, in a word."""
        match self.status:
            case Trained():
                return "trained"
            case Stale():
                return "stale"
            case Untaught():
                return "untaught"
        return "does not learn"

    @property
    def remarks(self) -> tuple[str, ...]:
        """Why it is stale, or what has changed since it was taught."""
        match self.status:
            case Stale(differences):
                return differences
            case Trained(_, notes):
                return notes
        return ()


def rows(graph: Graph, sources: Iterable[Path]) -> list[Row]:
    """Every skill, parents first; LockError where a lock is damaged."""
    lock = read_locks(sources)
    frozen = {skill.name: skill.frozen for skill in graph.skills}
    return [Row(skill, found, frozen[skill]) for skill, found in status(arrange(graph, lock), lock).items()]


def report(found: Sequence[Row]) -> Table:
    """The rows as a table."""
    from rich.table import Table
    from rich.text import Text

    table = Table(box=None, pad_edge=False, padding=(0, 2, 0, 0), show_header=False)
    for row in found:
        word = f"{row.word}, frozen" if row.is_frozen else row.word
        made = (
            f"{row.status.entry.weights[:4]}…  {made_by(row.status.entry.taught)}"
            if isinstance(row.status, Trained)
            else ""
        )
        table.add_row(
            Text(row.skill), Text(word, COLOURS[row.word]), Text("\n".join(filter(None, (made, *row.remarks))))
        )
    return table


def made_by(taught: Taught) -> str:
    """How a genome came about, in words."""
    under = f" under {taught.master}"
    jointly = " with subskills" * taught.jointly
    return (
        f"{taught.score:.1f} on {taught.task}{under}{jointly}, "
        f"{taught.generations} generations of {taught.population} from seed {taught.seed}"
    )


def as_data(row: Row) -> dict[str, Any]:
    """A row as plain data."""
    data: dict[str, Any] = {"skill": row.skill, "status": row.word, "frozen": row.is_frozen, "remarks": [*row.remarks]}
    if isinstance(row.status, Trained):
        entry = row.status.entry
        taught = {name: getattr(entry.taught, name) for name in Taught.__slots__}
        data |= {"weights": entry.weights, "taught": taught, "subskills": dict(entry.subskills)}
    return data


def survival(found: Sequence[Row]) -> list[str]:
    """Which weights still fit, as sentences: those that do in one, each of the others in its own."""
    trained = [row.skill for row in found if isinstance(row.status, Trained)]
    lines = [f"weights of {listed(trained, 'and')} fit"] if trained else []
    lines += [f"{row.skill} is stale: {'; '.join(row.remarks)}" for row in found if isinstance(row.status, Stale)]
    return lines + [f"{row.skill} has not been taught" for row in found if isinstance(row.status, Untaught)]
