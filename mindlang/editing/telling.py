"""What an edit does to the trained weights, in sentences."""

from collections.abc import Iterator

from mindlang.editing.carry_out import Edited
from mindlang.editing.follow import locks_of, merged
from mindlang.lock.arrange import arrange
from mindlang.lock.status import Stale, Status, Trained, Untaught, status


def told(edited: Edited) -> list[str]:
    """A sentence for each skill whose weights do not simply stay as they are."""
    project = edited.project
    lock = merged(locks_of(file.source.path for file in project.files))
    before = status(arrange(project.graph, lock), lock)
    renamed = {rename.new: rename.old for rename in edited.change.renamed if rename.noun == "skill"}
    after = edited.statuses()
    lines = [line for skill, now in after.items() for line in _told(skill, renamed.get(skill, skill), before, now)]
    gone = before.keys() - {renamed.get(skill, skill) for skill in after}
    lines += [
        f"{skill} is gone, its weights are forgotten" for skill in sorted(gone) if isinstance(before[skill], Trained)
    ]
    kept = sum(isinstance(state, Trained) for state in after.values())
    return [*lines, f"{kept} trained skill{'s' * (kept != 1)} keep{'s' * (kept == 1)} what was learnt"]


def _told(skill: str, old: str, before: dict[str, Status], now: Status) -> Iterator[str]:
    was = before.get(old)
    match was, now:
        case Trained(), Trained():
            if skill != old:
                yield f"{skill} has the weights of {old}"
            if was.entry.weights != now.entry.weights:
                yield f"{skill} keeps its weights, with zeros for what is new"
            yield from (f"{skill} was {note}" for note in now.notes if note not in was.notes)
        case Stale(), Stale():
            pass
        case _, Stale(differences):
            yield f"{skill} is stale: {'; '.join(differences)}"
        case Untaught(), Untaught():
            pass
        case _, Untaught():
            yield f"{skill} has not been taught"
