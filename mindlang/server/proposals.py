"""Code actions where the cursor is: the edits of `mindc edit` that make sense there, and quick fixes of findings."""

import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from itertools import chain, count, islice
from pathlib import Path
from typing import Any

from mindrun.graph.skill_sets import genes

from mindlang.compiler.compile import compile_source
from mindlang.compiler.diagnostic import Diagnostic, listed
from mindlang.compiler.hierarchy import above, below
from mindlang.compiler.source import Source
from mindlang.compiler.splice import Splice
from mindlang.compiler.syntax import Declaration, Drives, Fact, Influences, Reads, Stays
from mindlang.editing.project import EditError, Project, facts, has_outputs, kind_of
from mindlang.lint.lint import fixed
from mindlang.server.changing import proposed
from mindlang.server.workspace import MindView, fact_at, on_line

MAX_TARGETS = 6  # of each sort; the command line and the editor's own dialogue know them all
_SUGGESTED_NAME = re.compile(r"Did you mean (\S+)\?")


@dataclass(frozen=True, slots=True)
class Selection:
    """What is selected of a file: from offset `start` up to `end`, which is the same where the cursor just stands."""

    project: Project
    path: Path
    start: int
    end: int

    @property
    def declarations(self) -> list[Declaration]:
        """The declarations of the file whose headers are selected."""
        return [each for each in self._own if self.start <= each.header.span.start and each.header.span.end <= self.end]

    @property
    def declaration(self) -> Declaration | None:
        """The declaration on one of whose lines the selection begins."""
        lines = ((each, span) for each in self._own for span in [each.header.span, *(f.span for f in each.facts)])
        return next((each for each, span in lines if on_line(span, self.start)), None)

    @property
    def _own(self) -> tuple[Declaration, ...]:
        file = self.project.paths.get(self.path)
        return file.declarations if file else ()

    def touches(self, fact: Fact) -> bool:
        """Whether the line of a fact is selected, or some of it."""
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
    return [each for offer in OFFERS for each in offer(selection) if _is_possible(selection.project, each)]


def _is_possible(project: Project, proposal: Proposal) -> bool:
    try:
        proposed(project, proposal.edit, proposal.arguments)
    except EditError:
        return False
    return True


def _of_skill(selection: Selection) -> Iterator[Proposal]:
    """The edits of the skill whose line this is."""
    declaration = selection.declaration
    if declaration is None or declaration.header.noun.text != "skill":
        return
    name = declaration.header.name.text
    frozen = any(isinstance(fact, Stays) for fact in declaration.facts)
    if frozen:
        yield Proposal(f"Let {name} be taught again", "unfreeze", {"skill": name})
    else:
        yield Proposal(f"Freeze {name}", "freeze", {"skill": name})
    if declaration.header.like:
        yield Proposal(f"Give {name} weights of its own", "unshare", {"skill": name})
    new = fresh_title(selection.project, f"New{name}")
    put = {"skill": name, "new": new, **_function(declaration)}
    yield Proposal(f"Put a new skill over {name}", "encapsulate", put, new, "refactor.extract")
    yield Proposal(f"Let the subskills of {name} take its place", "inline", {"skill": name}, kind="refactor.inline")


def _of_header(selection: Selection) -> Iterator[Proposal]:
    """The edits that connect the skill on whose header the cursor is, or put another in its place."""
    declaration = selection.declaration
    if declaration is None or not on_line(declaration.header.span, selection.start):
        return
    noun, name = declaration.header.noun.text, declaration.header.name.text
    if noun != "body":
        yield Proposal(f"Remove {noun} {name}", "remove", {"what": [noun, name]})
    if noun != "skill":
        return
    project = selection.project
    for verb, target in connectable(project, declaration):
        rule = {"at": "1"} if verb != "read" and not has_outputs(kind_of(declaration)) else {}
        flags = {"drives": True} if verb == "drive" and target in project.names.of("memory") else {}
        yield Proposal(f"Let {name} {verb} {target}", "connect", {"skill": name, "target": target, **rule, **flags})
    for other, reads in not_yet_below(project, name):
        also = f" and read {listed(reads, 'and')}" if reads else ""
        arguments = {"skill": name, "with_": [other], "reads": reads}
        yield Proposal(f"Integrate: let {name} influence {other}{also}", "integrate", arguments)
    for other in replacements(project, name):
        yield Proposal(f"Let {other} take the place of {name}", "replace", {"skill": name, "new": other})
    if lines := lesson(project, name):
        yield Proposal(f"Add a lesson for {name}", "add", lines)


def _function(declaration: Declaration) -> dict[str, Any]:
    """What a new skill beside another is: it reads the same, and is a rule where that is nothing."""
    reads = [fact.name.text for fact in facts(declaration, Reads)]
    return {"reads": reads} if reads else {"is_": "rule"}


def _of_line(selection: Selection) -> Iterator[Proposal]:
    """The edits of the fact on whose line the cursor is."""
    declaration = selection.declaration
    fact = fact_at(declaration, selection.start) if declaration else None
    if declaration is None or fact is None or selection.start != selection.end:
        return
    name = declaration.header.name.text
    if isinstance(fact, Reads | Drives | Influences):
        verb = type(fact).__name__.lower().removesuffix("s")
        target = fact.name.text
        yield Proposal(f"Let {name} no longer {verb} {target}", "disconnect", {"skill": name, "target": target})
        if isinstance(fact, Influences):
            yield Proposal(
                f"Let the subskills of {target} take its place", "inline", {"skill": target}, kind="refactor.inline"
            )
    else:
        arguments = {"what": [fact.span.text.strip()], "from_": name, "noun": declaration.header.noun.text}
        yield Proposal("Remove this line", "remove", arguments)


def _of_lines(selection: Selection) -> Iterator[Proposal]:
    """The subskills on the selected lines, under a skill of their own."""
    declaration = selection.declaration
    if declaration is None or declaration.header.noun.text != "skill":
        return
    edges = [fact for fact in facts(declaration, Influences) if selection.touches(fact)]
    if chosen := [fact.name.text for fact in edges]:
        new = fresh_title(selection.project, "New" + "+".join(chosen))
        is_rule = all(fact.at for fact in edges) or "is_" in _function(declaration)
        is_ = {"is_": "rule"} if is_rule else {}
        arguments = {"parent": declaration.header.name.text, "new": new, "subskills": chosen, **is_}
        yield Proposal(f"Put {listed(chosen, 'and')} under a new skill", "extract", arguments, new, "refactor.extract")


def _of_file(selection: Selection) -> Iterator[Proposal]:
    """The selected declarations moved to a file of their own, and a new skill."""
    if selection.path != selection.project.main.source.path:
        return
    if chosen := selection.declarations:
        names = [f"{each.header.noun.text}:{each.header.name.text}" for each in chosen]
        title = f"Move {listed((each.header.name.text for each in chosen), 'and')} to a new file"
        to = fresh_file(selection.path, chosen[0].header.noun.text)
        yield Proposal(title, "split", {"to": to, "names": names}, to, "refactor.move")
    if made := new_skill(selection.project):
        name, lines = made
        yield Proposal("Add a new skill", "add", {"lines": lines}, name)


OFFERS: tuple[Callable[[Selection], Iterator[Proposal]], ...] = (_of_line, _of_lines, _of_skill, _of_header, _of_file)


def fresh_title(project: Project, wish: str) -> str:
    """A name for a skill, as wished for or with a number that is free."""
    taken = project.names.of("skill")
    return next(name for name in _numbered(wish) if name not in taken)


def fresh_file(beside: Path, noun: str) -> str:
    """The name of a file beside another that is not there yet."""
    return next(f"{name}.mind" for name in _numbered(f"{noun}s") if not (beside.parent / f"{name}.mind").exists())


def new_skill(project: Project) -> tuple[str, list[str]] | None:
    """A skill that leaves every actuator at its neutral value: its name and its lines; None where there is none."""
    lines = [f"drives {actuator.name} at {actuator.kind.neutral:.15g}" for actuator in project.mind.actuators]
    name = fresh_title(project, "NewSkill")
    return (name, [f"skill {name} is rule", *lines]) if lines else None


def _numbered(wish: str) -> Iterator[str]:
    return chain([wish], (f"{wish}{number}" for number in count(2)))


def connectable(project: Project, declaration: Declaration) -> Iterator[tuple[str, str]]:
    """What a skill could read, drive or influence besides, with the verb."""
    said = {fact.name.text for fact in declaration.facts if isinstance(fact, Reads | Drives | Influences)}
    names = project.names
    free = [name for name in names.of("sensor", "memory") if name not in said][:MAX_TARGETS]
    yield from (("read", name) for name in free)
    free = [name for name in names.of("actuator", "memory") if name not in said][:MAX_TARGETS]
    yield from (("drive", name) for name in free)
    yield from (("influence", name) for name in _below(project, declaration.header.name.text)[:MAX_TARGETS])


def not_yet_below(project: Project, skill: str) -> Iterator[tuple[str, list[str]]]:
    """Skills that another could influence besides, with what they read and it does not."""
    reads = {known.name: known.reads for known in project.mind.skills}
    for other in _below(project, skill)[:MAX_TARGETS]:
        yield other, [reading for reading in reads[other] if reading not in reads[skill]]


def replacements(project: Project, skill: str) -> list[str]:
    """Skills that are not above it; those that drive other actuators are refused by the edit itself."""
    influences = project.mind.influences
    parents = set(influences.pred[skill])
    higher = above(influences, parents)
    others = (
        name
        for name in influences
        if name != skill
        and (name not in higher or (name in parents and not (parents - {name}) & below(influences, [name])))
    )
    return [*islice(others, 8 * MAX_TARGETS)]


def lesson(project: Project, skill: str) -> dict[str, Any]:
    """The arguments with which `add` gives a skill that learns its first lesson; none where it has one, or cannot."""
    learns = any(known.name == skill and genes(known) and not known.like for known in project.graph.skills)
    taught = any(known.skill == skill for known in project.mind.lessons)
    curricula, tasks = project.names.of("curriculum"), project.names.of("task")
    if not learns or taught or not curricula or not tasks:
        return {}
    task = skill if skill in tasks else tasks[-1]
    return {"lines": [f"teaches {skill} on {task} for 100 generations"], "to": curricula[0], "noun": "curriculum"}


def _below(project: Project, skill: str) -> list[str]:
    """The skills that a skill could influence without a circle, and does not."""
    influences = project.mind.influences
    alike = [known.name for known in project.mind.skills if known.like == skill]  # they would influence it, too
    not_below = {*influences[skill], *above(influences, [skill, *alike])}
    return [name for name in influences if name not in not_below]


@dataclass(frozen=True, slots=True)
class Mending:
    """A quick fix: its title, what it mends, what it splices, and whether it is safe to choose without thinking."""

    title: str
    of: Diagnostic
    splices: tuple[Splice, ...]
    is_safe: bool


def mendings(view: MindView, path: Path, start: int, end: int) -> Iterator[Mending]:
    """The quick fixes of what is found between two offsets of a file."""
    for found in view.findings:
        span = found.span
        if span is None or span.source.path != path or span.start > end or span.end < start:
            continue
        if found.fix:
            yield Mending(found.fix.title, found, found.fix.splices, found.fix.is_safe)
        if nearly := _SUGGESTED_NAME.search(found.hint):
            splice = Splice(span.source, span.start, span.end, nearly[1])
            yield Mending(f"Write {nearly[1]}", found, (splice,), True)


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

    mended, made = fixed(source, findings_of)
    return mended.text if made else None
