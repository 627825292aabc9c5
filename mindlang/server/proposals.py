"""The edits of `mindc edit` that make sense where the cursor is, with their arguments."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from typing import Any

from mindlang.compiler.diagnostic import listed
from mindlang.compiler.syntax import Declaration, Drives, Influences, Reads, Stays
from mindlang.editing.project import EditError, Project, facts, kind_of
from mindlang.server.changing import proposed
from mindlang.server.fresh import fresh_file, fresh_title, new_skill
from mindlang.server.selection import Selection
from mindlang.server.targets import connectable, lesson, not_yet_below, replacements
from mindlang.server.view import fact_at, on_line


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
        rule = {"at": "1"} if verb != "read" and kind_of(declaration) == "rule" else {}
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
