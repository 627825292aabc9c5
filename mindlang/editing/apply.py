"""An edit carried out in memory, and written: sources, locks and weights together or not at all.

The texts as they become are held against the compiler, and the locks follow. Nothing is written over what somebody
else has written meanwhile.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path

from mindrun.files.npy import to_npy
from mindrun.files.regular_files import read_regular
from mindrun.graph.graph import Graph
from mindrun.terminal.command_line import command_line

from mindlang.compiler.compile import Compiled, compile_source, load
from mindlang.compiler.diagnostic import errors
from mindlang.compiler.source import MAX_SOURCE_BYTES, Span, decode_source, encode_source, spliced
from mindlang.compiler.syntax import NOUNS, VERBS
from mindlang.editing import transaction
from mindlang.editing.insertion import first_line
from mindlang.editing.lock_update import UpdatedLocks, new_names, update_locks
from mindlang.editing.project import EditError, MindChange, Project
from mindlang.editing.world_names import Renaming, renamed
from mindlang.lock import LockError, Locks, lock_text, locks_of

NOTHING_UNSAVED: Mapping[Path, str] = {}


@dataclass(frozen=True, slots=True)
class EditedNeighbour:
    """A neighbour before and after an edit; one whose lock is damaged keeps it as it is, and why is in `damage`."""

    before: Project
    after: Compiled
    damage: str


@dataclass(frozen=True, slots=True)
class Edited:
    """The result of an edit: the new texts by path, the graph of these, the locks as they are and as they follow."""

    project: Project
    change: MindChange
    texts: Mapping[Path, str]
    graph: Graph
    beside: tuple[EditedNeighbour, ...]
    locks: Locks
    followed: UpdatedLocks

    @property
    def old_texts(self) -> dict[Path, str]:
        """The texts of all files, those of the neighbours too."""
        return {path: text for mind in reversed(self.project.minds) for path, text in mind.texts.items()}

    @property
    def sources(self) -> list[Path]:
        """The files of the mind afterwards, main one first."""
        return [*self.project.taught, *self.change.created]

    @property
    def changed_locks(self) -> list[Path]:
        return [path for path, lock in self.followed.locks.items() if lock != self.locks[path]]


def apply_edit(
    project: Project, change: MindChange, keep_weights: bool, unsaved: Mapping[Path, str] = NOTHING_UNSAVED
) -> Edited:
    """The edit made in memory; EditError where its result would not compile, nothing is written.

    Files that are open in an editor have texts that are `unsaved`.
    """
    _refuse_under_alias(change)
    refuse_in_families(project, change)
    touched = {id(splice.source): splice.source for splice in change.splices}
    changed = {source.path: spliced(source, change.splices) for source in touched.values()}
    texts = {**unsaved, **changed, **change.created}
    graph = _compiled(project, texts)
    _refuse_captured(project, change, graph)
    locks = locks_of([*project.taught, *change.created])
    beside = []
    sharing = [id(other) for rename in change.renamed for other in project.sharing(rename.noun, rename.old)]
    for other in project.neighbours:
        if change.renamed and id(other) not in sharing:
            continue  # to it the new names are none
        main, damage = other.main.source.path, ""
        try:
            locks = locks_of(other.taught) | locks
        except LockError as error:
            damage = str(error)
        beside.append(EditedNeighbour(other, load(main, texts), damage))
    neighbours = [each.before.graph for each in beside]
    followed = update_locks(locks, project.graph, graph, change, keep_weights, neighbours)
    return Edited(project, change, texts, graph, tuple(beside), locks, followed)


def _refuse_under_alias(change: MindChange) -> None:
    """EditError where the edit changes a file that is used under a name: its declarations have other names there."""
    for splice in change.splices:
        if alias := splice.source.alias:
            name = splice.source.name
            message = f"{name} is used as {alias}, and has other names for what it declares."
            hint = f"Edit it by itself: mindc edit … {command_line(Path(name))}"
            if load(splice.source.path).graph is None:
                hint = f"It is no mind by itself, which mindc edit could change: change {name} by hand."
            raise EditError(message, hint, Span(splice.source, splice.start, splice.end))


def refuse_in_families(project: Project, change: MindChange) -> None:
    """EditError where an edit changes a line that stands for several and does not know it: all would be others."""
    for family in () if change.of_families else (family for file in project.files for family in file.families):
        first, *_ = family.text.split()
        for splice in (each for each in change.splices if each.source is family.source):
            begins = splice.start == splice.end == family.end and (splice.text.split() or [""])[0] in VERBS
            if (splice.start < family.end and splice.end > family.start) or (begins and first in NOUNS):
                message = "This line stands for several, and the edit is about one of them."
                hint = f"Write them out first: {family.source.edit('unfold')}"
                raise EditError(message, hint, replace(family, end=first_line(family).end))


def _refuse_captured(project: Project, change: MindChange, graph: Graph) -> None:
    """EditError where a rename makes a line mean something else: the new name is that of something else there."""
    now_called = Renaming(new_names(change), ()).name
    if change.renamed and renamed(project.graph, now_called) != renamed(graph, lambda text, *nouns: text):
        old, new = change.renamed[0].old, change.renamed[0].new
        raise EditError(f"If {old} is called {new}, a line means something else.", "Choose another name.")


def _compiled(project: Project, texts: dict[Path, str]) -> Graph:
    """The graph of a project with these texts; EditError where they do not compile.

    What was wrong with a procedure before may stay so.
    """
    now = project.texts | texts
    main = project.main.source
    compiled = compile_source(replace(main, text=now[main.path]), main.path, now)
    if wrong := errors(compiled.diagnostics):
        known = {each.message for each in compile_source(main, main.path, project.texts).diagnostics}
        for worst in (each for each in wrong if each.message not in known):
            error = EditError(f"After this edit the mind would not compile. {worst.message}", worst.hint)
            labels = tuple(replace(label, span=_as_edited(label.span)) for label in worst.labels)
            span = worst.span and _as_edited(worst.span)
            error.diagnostic = replace(worst, message=str(error), span=span, labels=labels)
            raise error
    assert compiled.graph
    return compiled.graph


def _as_edited(span: Span) -> Span:
    """A place in a text that nobody has seen, and is said to be one."""
    return replace(span, source=replace(span.source, name=f"{span.source.name} as edited"))


def write(edited: Edited) -> None:
    """Write what an edit changes; MindError where that fails."""
    locks = {path: edited.followed.locks[path] for path in edited.changed_locks}
    files: dict[Path, bytes | None] = {path: to_npy(weights) for path, weights in edited.followed.weights.items()}
    files |= {path: lock_text(lock).encode() for path, lock in locks.items()}
    files |= {path: encode_source(path, text) for path, text in edited.texts.items()}
    with transaction.no_training(files):
        folder = transaction.common_folder(files)
        transaction.change(folder, files, lambda: _refuse_changed(edited), keeps=True)


def _refuse_changed(edited: Edited) -> None:
    """EditError where something is not as it was read: another edit, a training or an editor has written it since."""
    old = edited.old_texts
    for path in old.keys() & edited.texts.keys():
        if path.is_symlink() or not path.is_file():
            raise EditError(f"There is no file {path} that could be written.", "Edit the file to which a link leads.")
    changed = [path for path in (*old, *edited.texts) if _read(path) != old.get(path)]
    changed += [path for path, lock in edited.locks.items() if locks_of([path])[path] != lock]
    for path in changed:
        raise EditError(f"{path.name} has been changed meanwhile.", "Try again: nothing has been written.")


def _read(path: Path) -> str | None:
    try:
        return decode_source(read_regular(path, MAX_SOURCE_BYTES + 1))
    except (FileNotFoundError, ValueError):
        return None
