"""What an edit does to the trained weights, in sentences."""

from collections.abc import Iterator

from mindlang.editing.carry_out import Edited
from mindlang.lock.status import Stale, Status, Trained, Untaught


def told(edited: Edited) -> list[str]:
    """A sentence for each skill whose weights do not simply stay as they are."""
    before, after = edited.statuses_before(), edited.statuses()
    renamed = {rename.new: rename.old for rename in edited.change.renamed if rename.noun == "skill"}
    old_names = {skill: renamed.get(skill, skill) for skill in after}
    lines = [line for skill, now in after.items() for line in _told(skill, old_names[skill], before, now)]
    gone = before.keys() - set(old_names.values())
    lines += [
        f"{skill} is gone, its weights are forgotten" for skill in sorted(gone) if isinstance(before[skill], Trained)
    ]
    if any(isinstance(state, Trained) for state in before.values()):
        kept = sum(isinstance(state, Trained) for state in after.values())
        lines.append(f"{kept} trained skill{'s' * (kept != 1)} keep{'s' * (kept == 1)} what was learnt")
    return lines


def _told(skill: str, old: str, before: dict[str, Status], now: Status) -> Iterator[str]:
    match before.get(old), now:
        case Trained() as was, Trained():
            if skill != old:
                yield f"{skill} has the weights of {old}"
            if was.entry.weights != now.entry.weights:
                yield f"{skill} keeps its weights, with zeros for what is new"
            yield from (f"{skill} was {note}" for note in now.notes if note not in was.notes)
        case Stale(known), Stale(differences):
            if news := [difference for difference in differences if difference not in known]:
                yield f"{skill} is stale already, and more so: {'; '.join(news)}"
        case _, Stale(differences):
            yield f"{skill} is stale: {'; '.join(differences)}"
        case Untaught(), Untaught():
            pass
        case _, Untaught():
            yield f"{skill} has not been taught"
