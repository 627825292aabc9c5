"""Code actions where the cursor is: the edits of `mindc edit` that make sense there, and quick fixes of findings."""

import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from itertools import chain, count, islice
from pathlib import Path
from typing import Any

from mindrun.graph.skill_sets import genes

from mindlang.compiler.compile import compile_source
from mindlang.compiler.diagnostic import Diagnostic, Fix, listed
from mindlang.compiler.hierarchy import with_ancestors, with_descendants
from mindlang.compiler.source import Source, Splice
from mindlang.compiler.syntax import Declaration, Drives, Fact, Influences, Reads, of_form
from mindlang.editing.apply import refuse_in_families
from mindlang.editing.project import EditError, Project, has_outputs, kind_of
from mindlang.lint.lint import apply_safe_fixes
from mindlang.server.changing import proposed
from mindlang.server.places import on_line
from mindlang.server.workspace import MindView

MAX_TARGETS = 6  # of each sort; the command line and the editor's own dialogue know them all
_SUGGESTED_NAME = re.compile(r"Did you mean (\S+)\?")


@dataclass(frozen=True, slots=True)
class Selection:
    """The selection in a file: from offset `start` up to `end`, which is the same where the cursor just stands."""

    project: Project
    path: Path
    start: int
    end: int

    @property
    def _own(self) -> tuple[Declaration, ...]:
        file = self.project.paths.get(self.path)
        return file.declarations if file else ()

    @property
    def declarations(self) -> list[Declaration]:
        return [each for each in self._own if self.start <= each.header.span.start and each.header.span.end <= self.end]

    @property
    def declaration(self) -> Declaration | None:
        """The declaration on one of whose lines the selection begins."""
        lines = ((each, line.span) for each in self._own for line in (each.header, *each.facts))
        return next((each for each, span in lines if on_line(span, self.start)), None)

    def touches(self, fact: Fact) -> bool:
        """True if the selection begins on the line of a fact, or overlaps the fact."""
        return on_line(fact.span, self.start) or (self.start <= fact.span.end and fact.span.start < self.end)


@dataclass(frozen=True, slots=True)
class Proposal:
    """An edit with arguments; `fresh` is a name in them that the user will want to choose anew."""

    title: str
    edit: str
    arguments: dict[str, Any] = field(default_factory=dict)
    fresh: str = ""
    kind: str = "refactor.rewrite"


def proposals(selection: Selection) -> list[Proposal]:
    """The edits that are possible there; whether the mind compiles after them is known once one is chosen."""
    project, declaration = selection.project, selection.declaration
    found: list[Proposal] = []
    if declaration:
        fact = next((each for each in declaration.facts if on_line(each.span, selection.start)), None)
        if fact and selection.start == selection.end:
            found += _of_fact(declaration, fact)
        if declaration.header.noun.text == "skill":
            found += [*_of_lines(selection, declaration), *_of_skill(project, declaration)]
        if on_line(declaration.header.span, selection.start):
            found += _of_header(project, declaration)
    if selection.path == project.main.source.path:
        found += _of_file(selection)
    return [each for each in found if _is_possible(project, each)]


def _is_possible(project: Project, proposal: Proposal) -> bool:
    try:
        refuse_in_families(project, proposed(project, proposal.edit, proposal.arguments))
    except EditError:
        return False
    return True


def _of_fact(declaration: Declaration, fact: Fact) -> Iterator[Proposal]:
    name = declaration.header.name.text
    if not isinstance(fact, Reads | Drives | Influences):
        arguments = {"what": [fact.span.text.strip()], "from_": name, "noun": declaration.header.noun.text}
        yield Proposal("Remove this line", "remove", arguments)
        return
    verb, target = type(fact).__name__.lower().removesuffix("s"), fact.name.text
    yield Proposal(f"Let {name} no longer {verb} {target}", "disconnect", {"skill": name, "target": target})
    if isinstance(fact, Influences):
        title = f"Let the subskills of {target} take its place"
        yield Proposal(title, "inline", {"skill": target}, kind="refactor.inline")


def _of_lines(selection: Selection, skill: Declaration) -> Iterator[Proposal]:
    """The subskills on the selected lines, under a skill of their own."""
    edges = [fact for fact in of_form(skill.facts, Influences) if selection.touches(fact)]
    if chosen := [fact.name.text for fact in edges]:
        new = _fresh_title(selection.project, "New" + "+".join(chosen))
        is_ = {"is_": "rule"} if all(fact.at for fact in edges) or not of_form(skill.facts, Reads) else {}
        arguments = {"parent": skill.header.name.text, "new": new, "subskills": chosen, **is_}
        yield Proposal(f"Put {listed(chosen, 'and')} under a new skill", "extract", arguments, new, "refactor.extract")


def _of_skill(project: Project, skill: Declaration) -> Iterator[Proposal]:
    name = skill.header.name.text
    yield Proposal(f"Let {name} be taught again", "unfreeze", {"skill": name})
    yield Proposal(f"Freeze {name}", "freeze", {"skill": name})
    yield Proposal(f"Give {name} weights of its own", "unshare", {"skill": name})
    yield Proposal(f"Let the links of {name} be learnt, too", "grow", {"skill": name})
    yield Proposal(f"Take away the neurons of {name} that nothing reads", "prune", {"skill": name})
    new = _fresh_title(project, f"New{name}")
    reads = [fact.name.text for fact in of_form(skill.facts, Reads)]  # the new one is a rule where that is nothing
    put = {"skill": name, "new": new, **({"reads": reads} if reads else {"is_": "rule"})}
    yield Proposal(f"Put a new skill over {name}", "encapsulate", put, new, "refactor.extract")
    yield Proposal(f"Let the subskills of {name} take its place", "inline", {"skill": name}, kind="refactor.inline")


def _of_header(project: Project, declaration: Declaration) -> Iterator[Proposal]:
    """The edits that connect the skill on whose header the cursor is, or put another in its place."""
    noun, name = declaration.header.noun.text, declaration.header.name.text
    if noun != "body":
        yield Proposal(f"Remove {noun} {name}", "remove", {"what": [noun, name]})
    if noun == "task":
        yield Proposal("Write out what the goals reward", "rewards", {"task": name})
    if noun != "skill":
        return
    for verb, target in _connectable(project, declaration):
        rule = {"at": "1"} if verb != "read" and not has_outputs(kind_of(declaration)) else {}
        flags = {"drives": True} if verb == "drive" and target in project.names.of("memory") else {}
        yield Proposal(f"Let {name} {verb} {target}", "connect", {"skill": name, "target": target, **rule, **flags})
    read = {known.name: known.reads for known in project.mind.skills}
    for other in _not_below(project, name)[:MAX_TARGETS]:
        reads = [reading for reading in read[other] if reading not in read[name]]
        also = f" and read {listed(reads, 'and')}" if reads else ""
        arguments = {"skill": name, "with_": [other], "reads": reads}
        yield Proposal(f"Integrate: let {name} influence {other}{also}", "integrate", arguments)
    for other in _replacements(project, name):
        yield Proposal(f"Let {other} take the place of {name}", "replace", {"skill": name, "new": other})
    if lines := _lesson(project, name):
        yield Proposal(f"Add a lesson for {name}", "add", lines)


def _of_file(selection: Selection) -> Iterator[Proposal]:
    """The selected declarations moved to a file of their own, a new skill with neutral commands, and families."""
    yield Proposal("Make families of what differs in a number", "fold")
    yield Proposal("Write out the families", "unfold")
    if chosen := selection.declarations:
        names = [f"{each.header.noun.text}:{each.header.name.text}" for each in chosen]
        title = f"Move {listed((each.header.name.text for each in chosen), 'and')} to a new file"
        free = (f"{name}.mind" for name in _numbered(f"{chosen[0].header.noun.text}s"))
        to = next(name for name in free if not selection.path.with_name(name).exists())
        yield Proposal(title, "split", {"to": to, "names": names}, to, "refactor.move")
    actuators = selection.project.mind.actuators
    if lines := [f"drives {actuator.name} at {actuator.kind.neutral:.15g}" for actuator in actuators]:
        new = _fresh_title(selection.project, "NewSkill")
        yield Proposal("Add a new skill", "add", {"lines": [f"skill {new} is rule", *lines]}, new)


def _fresh_title(project: Project, wish: str) -> str:
    """A name for a skill, as wished for or with a number that is free."""
    taken = project.names.of("skill")
    return next(name for name in _numbered(wish) if name not in taken)


def _numbered(wish: str) -> Iterator[str]:
    return chain([wish], (f"{wish}{number}" for number in count(2)))


def _connectable(project: Project, skill: Declaration) -> Iterator[tuple[str, str]]:
    """Each name that a skill could read, drive or influence besides, behind the verb."""
    said = {fact.name.text for fact in skill.facts if isinstance(fact, Reads | Drives | Influences)}
    targets = {
        "read": project.names.of("sensor", "memory"),
        "drive": project.names.of("actuator", "memory"),
        "influence": _not_below(project, skill.header.name.text),
    }
    for verb, names in targets.items():
        yield from ((verb, name) for name in [name for name in names if name not in said][:MAX_TARGETS])


def _not_below(project: Project, skill: str) -> list[str]:
    """The skills that a skill could influence without a circle, and does not."""
    influences = project.mind.influences
    alike = [known.name for known in project.mind.skills if known.like == skill]  # they would influence it, too
    taken = {*influences[skill], *with_ancestors(influences, [skill, *alike])}
    return [name for name in influences if name not in taken]


def _replacements(project: Project, skill: str) -> Iterator[str]:
    """Skills that are not above it; those that drive other actuators are refused by the edit itself."""
    influences = project.mind.influences
    parents = set(influences.pred[skill])
    higher = with_ancestors(influences, parents) - {
        name for name in parents if parents.isdisjoint(with_descendants(influences, [name]) - {name})
    }
    return islice((name for name in influences if name not in {skill, *higher}), 8 * MAX_TARGETS)


def _lesson(project: Project, skill: str) -> dict[str, Any]:
    """The arguments with which `add` gives a skill that learns its first lesson; none where it has one, or cannot."""
    learns = any(known.name == skill and genes(known) and not known.like for known in project.graph.skills)
    taught = any(known.skill == skill for known in project.mind.lessons)
    curricula, tasks = project.names.of("curriculum"), project.names.of("task")
    if not learns or taught or not curricula or not tasks:
        return {}
    task = skill if skill in tasks else tasks[-1]
    return {"lines": [f"teaches {skill} on {task} for 100 generations"], "to": curricula[0], "noun": "curriculum"}


def mendings(view: MindView, path: Path, start: int, end: int) -> Iterator[tuple[Diagnostic, Fix]]:
    """What is found between two offsets of a file, with a quick fix of it."""
    for found in view.findings:
        span = found.span
        if span is None or span.source.path != path or span.start > end or span.end < start:
            continue
        if found.fix:
            yield found, found.fix
        if nearly := _SUGGESTED_NAME.search(found.hint):
            yield found, Fix(f"Write {nearly[1]}", (Splice(span.source, span.start, span.end, nearly[1]),))


def all_mended(view: MindView, path: Path, texts: dict[Path, str]) -> str | None:
    """The text of a main file with all safe fixes made, or None where there is none to make."""
    if path != view.main or view.compiled.graph is None:
        return None
    source = view.compiled.sources[0]

    def findings_of(now: Source) -> tuple[Diagnostic, ...]:
        if now is source:
            return view.findings
        compiled = compile_source(now, path, {**texts, path: now.text})
        return MindView(path, compiled, (), view.names).findings

    mended, made = apply_safe_fixes(source, findings_of)
    return mended.text if made else None
