"""The effects of an edit on sources and on trained weights, in sentences and as a diff."""

import os
import re
from collections.abc import Iterator, Mapping
from pathlib import Path

from mindrun.graph.graph import Graph

from mindlang.compiler.diagnostic import listed
from mindlang.editing.apply import Edited
from mindlang.editing.lock_update import new_names
from mindlang.editing.unified_diff import unified
from mindlang.files import files_beside, readable_text, within_read_limits
from mindlang.lock import Locks, merged
from mindlang.lock.signature import arrange
from mindlang.lock.status import Stale, Status, Trained, Untaught, status

Statuses = Mapping[str, Status]


def diff(edited: Edited) -> str:
    """The unified diff of all sources, for `patch -p1` in the working directory where they lie below that."""
    old = edited.old_texts
    base = Path.cwd().resolve()
    if not all(path.is_relative_to(base) for path in edited.texts):
        base = Path(os.path.commonpath([path.parent for path in edited.texts]))
    names = {path: path.relative_to(base).as_posix() for path in edited.texts}
    return "".join(unified(names[path], old.get(path, ""), text) for path, text in edited.texts.items())


def not_followed(edited: Edited) -> Iterator[str]:
    """A sentence for each old name, of the files that say it and that no edit follows.

    These are breakpoints and wiring beside the mind, and minds that use one of its files and do not compile just now.
    """
    beside = next(iter(edited.project.paths)).parent
    texts = [(path, readable_text(path)) for end in (".break", ".yaml") for path in files_beside(beside, end)]
    known = {*edited.old_texts, *edited.texts}
    for path in files_beside(beside):
        text = readable_text(path) if path not in known else ""
        if any(f'use "{file.name}"' in text for file in known):
            texts.append((path, text))
    for each in edited.change.renamed:
        name = re.compile(rf"(?<![\w.]){re.escape(each.old)}(?!\w)")
        if files := [path.name for path, text in within_read_limits(texts) if name.search(text)]:
            say = "says" if len(files) == 1 else "say"
            yield f"note: {listed(files, 'and')} {say} {each.old}, where no edit follows: it is {each.new} now"


def summarise(edited: Edited) -> list[str]:
    """A sentence for each skill whose weights do not simply stay as they are, and for what happens to neighbours."""
    before = _statuses(edited.project.graph, edited.locks, edited.project.taught)
    after = _statuses(edited.graph, edited.followed.locks, edited.sources)
    old_names = _old_names(edited, after)
    frozen, recast = {skill.name for skill in edited.graph.skills if skill.frozen}, edited.change.recast
    lines = [
        line for skill, now in after.items() for line in _skill_sentences(skill, old_names[skill], before, now, recast)
    ]
    lines += [
        f"{skill} is frozen: unfreeze it to teach it again"
        for skill, now in after.items()
        if skill in frozen and isinstance(now, Stale) and isinstance(before.get(old_names[skill]), Trained)
    ]
    gone = sorted(before.keys() - set(old_names.values()))
    lines += [f"{skill} is gone, its weights are forgotten" for skill in gone if isinstance(before[skill], Trained)]
    if any(isinstance(state, Trained) for state in before.values()):
        kept = sum(isinstance(state, Trained) for state in after.values())
        skills = {0: "no trained skill keeps", 1: "1 trained skill keeps"}.get(kept, f"{kept} trained skills keep")
        lines.append(f"{skills} what was learnt")
    return lines + _neighbour_sentences(edited)


def broken_sentences(edited: Edited) -> list[str]:
    """A sentence for each neighbour that would no longer compile by itself."""
    broken = {
        other.before.main.source.path.name: other.after.diagnostics[0].message
        for other in edited.beside
        if other.after.graph is None
    }
    return [f"{name} no longer compiles by itself: {why}" for name, why in broken.items()]


def _neighbour_sentences(edited: Edited) -> list[str]:
    """Sentences on skills that become stale in neighbours whose locks have other lines of them than the mind's."""
    found: dict[str, list[str]] = {}
    own = merged(edited.locks, edited.project.taught)
    for other in edited.beside:
        name = other.before.main.source.path.name
        if other.damage:
            found.setdefault(f"{other.damage}; it stays as it is", []).append("")
        if other.after.graph is None:
            continue
        theirs = merged(edited.locks, other.before.taught)
        before = _statuses(other.before.graph, edited.locks, other.before.taught)
        after = _statuses(other.after.graph, edited.followed.locks, [source.path for source in other.after.sources])
        for skill, old in _old_names(edited, after).items():
            now = after[skill]
            if isinstance(now, Stale) and isinstance(before.get(old), Trained) and own.get(old) != theirs.get(old):
                found.setdefault(f"{skill} is stale: {'; '.join(now.differences)}", []).append(name)
    return [f"{listed(sorted(names), 'and')}: {line}" if any(names) else line for line, names in found.items()]


def _old_names(edited: Edited, after: Statuses) -> dict[str, str]:
    """The name that each skill had before the edit."""
    old = {new: old for old, new in new_names(edited.change)["skill"].items()}
    return {skill: old.get(skill, skill) for skill in after}


def _statuses(graph: Graph, locks: Locks, sources: list[Path]) -> Statuses:
    lock = merged(locks, sources)
    return status(arrange(graph, lock), lock)


def _skill_sentences(skill: str, old: str, before: Statuses, now: Status, recast: str) -> Iterator[str]:
    match before.get(old), now:
        case Trained() as was, Trained():
            if skill != old:
                yield f"{skill} has the weights of {old}"
            if was.entry.weights != now.entry.weights:
                new = "as a matrix of links" if skill == recast else "with zeros for what is new"
                yield f"{skill} keeps its weights, {new}"
            if news := [change for change in now.changes if change not in was.changes]:
                yield f"{skill} was taught elsewhere: {'; '.join(news)}"
        case Stale(known), Stale(differences):
            if news := [difference for difference in differences if difference not in known]:
                yield f"{skill} is stale already, and more so: {'; '.join(news)}"
        case _, Stale(differences):
            yield f"{skill} is stale: {'; '.join(differences)}"
        case Untaught(), Untaught():
            pass
        case _, Untaught():
            yield f"{skill} has not been taught"
