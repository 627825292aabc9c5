"""Edits of whether a skill is taught, and with whose weights it acts."""

from mindlang.compiler.model import Skill
from mindlang.compiler.names import mentions_in
from mindlang.compiler.syntax import Fact, Promise, Sends, Stays, of_form
from mindlang.editing import insertion
from mindlang.editing.project import EditError, MindChange, Project, Unshared


def freeze(project: Project, skill: str) -> MindChange:
    """Let a skill stay as it is: it refuses training.

    Lessons with subskills leave it out.

    Example: mindc edit freeze collect.mind Avoid
    """
    declaration = project.own_skill(skill)
    if frozen := of_form(declaration.facts, Stays):
        raise EditError(f"{skill} is frozen already.", "", frozen[0].span)
    return MindChange((insertion.below_siblings(declaration, "stays", ["stays frozen"]),))


def unfreeze(project: Project, skill: str) -> MindChange:
    """Let a frozen skill be taught again.

    Example: mindc edit unfreeze collect.mind Avoid
    """
    declaration = project.own_skill(skill)
    frozen = of_form(declaration.facts, Stays)
    if not frozen:
        raise EditError(f"{skill} is not frozen.", "", declaration.header.span)
    return MindChange(tuple(insertion.without_line(fact) for fact in frozen))


def unshare(project: Project, skill: str) -> MindChange:
    """Let a skill that is like another have weights of its own.

    It says for itself then what the other one says, but for what that promises, and begins with a copy of the weights
    that they shared.

    Example: mindc edit unshare like.mind GoToDropZone
    """
    declaration = project.find(skill, "skill")
    skills = {known.name: known for known in project.mind.skills}
    own = skills[skill]
    if not own.like:
        raise EditError(f"{skill} is like no other skill: its weights are its own.", "", declaration.header.span)
    owner = skills[own.like]
    phrase = owner.declaration.header.phrase
    assert phrase
    targets = ([edge.target for edge in each.edges] for each in (owner, own))
    sends, reads = dict(zip(*targets, strict=True)), dict(zip(owner.reads, own.reads, strict=True))
    indent, unshared = insertion.indentation(declaration), Unshared(skill, own.like, reads, sends)
    shared = (fact for fact in owner.declaration.facts if not isinstance(fact, Promise))
    lines = [f"{indent}{_restated(project, owner, fact, unshared)}" for fact in shared]
    lines += [f"{indent}{insertion.line_of(promise)}" for promise in of_form(own.declaration.facts, Promise)]
    header = insertion.replace_span(declaration.header.span, f"skill {skill} is {phrase.span.text}")
    if not declaration.facts:
        return MindChange(
            (header, insertion.insert_below(insertion.first_line(declaration.header.span), lines)), unshared=unshared
        )
    first, *others = declaration.facts
    return MindChange(
        (header, insertion.replace_line(first, lines), *map(insertion.without_line, others)), unshared=unshared
    )


def _restated(project: Project, owner: Skill, fact: Fact, unshared: Unshared) -> str:
    """A fact of the owner with what is read and to what is sent instead."""
    text, start = fact.span.text, fact.span.start
    names = {mention.name.span.start: mention.name for mention in mentions_in(fact, project.names, owner.declaration)}
    for place in sorted(names, reverse=True):
        name = names[place]
        is_target = isinstance(fact, Sends) and name.span == fact.name.span
        own = (unshared.sends if is_target else unshared.reads).get(name.text, name.text)
        text = text[: place - start] + own + text[name.span.end - start :]
    return text
