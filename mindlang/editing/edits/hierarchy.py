"""Edits of who reads, drives and influences what, and of what stands in whose place."""

from typing import Annotated

from mindlang.compiler import syntax
from mindlang.compiler.diagnostic import Label, a, did_you_mean, listed
from mindlang.compiler.hierarchy import with_descendants
from mindlang.compiler.model import Node
from mindlang.compiler.source import Splice
from mindlang.editing import insertion
from mindlang.editing.project import EditError, MindChange, Project, Replaced, influence, kind_of, refuse_lines

VERBS = {"skill": "influences", "actuator": "drives", "memory": "drives", "sensor": "reads"}


def connect(
    project: Project,
    skill: str,
    target: str,
    *,
    at: Annotated[str, "The value of the edge, instead of an output of the function: --at 1"] = "",
    drives: Annotated[bool, "Drive a memory, instead of reading it"] = False,
) -> MindChange:
    """Let a skill read, drive or influence something.

    It reads sensors, drives actuators and influences skills. A memory is read, unless there is a value to drive
    it with.

    Example: mindc edit connect collect.mind Collect proximity
    """
    declaration = project.own_skill(skill)
    refuse_lines(at)
    is_sent = drives or bool(at)
    noun = project.find(target, *(VERBS if is_sent else reversed(VERBS))).header.noun.text
    verb = "reads" if noun == "memory" and not is_sent else VERBS[noun]
    if verb == "reads" and is_sent:
        raise EditError(f"{target} is {a(noun)}, which is read.", "Leave --at and --drives out.")
    if drives and verb == "influences":
        raise EditError(f"{target} is a skill, which is influenced.", "Leave --drives out.")
    project.refuse_existing(declaration, verb, target)
    value = f" at {at}" if at else ""
    return MindChange((insertion.below_siblings(declaration, verb, [f"{verb} {target}{value}"]),))


def disconnect(project: Project, skill: str, target: str) -> MindChange:
    """Let a skill no longer read, drive or influence something.

    Example: mindc edit disconnect collect.mind Collect Grab
    """
    declaration = project.find(skill, "skill")
    edges = [fact for fact in declaration.facts if isinstance(fact, syntax.Reads | syntax.Drives | syntax.Influences)]
    found = [fact for fact in edges if fact.name.text == target]
    if not found:
        message = f"{skill} neither reads nor drives nor influences {target}."
        hint = did_you_mean(target, [fact.name.text for fact in edges])
        raise EditError(message, hint, declaration.header.span)
    if len(found) > 1:
        labels = [Label(fact.span, "or this") for fact in found[1:]]
        hint = f"Say which: {project.main.source.edit('remove', found[0].span.text, '--from', skill)}"
        raise EditError(f"{skill} reads {target} and drives it.", hint, found[0].span, *labels)
    return MindChange((insertion.without_line(found[0]),))


def encapsulate(
    project: Project,
    skill: str,
    new: str,
    *,
    with_: Annotated[tuple[str, ...], "Another skill that the new one influences: --with GoToPower+Avoid"] = (),
    reads: Annotated[tuple[str, ...], "A sensor or memory that the new one reads: --reads battery"] = (),
    is_: Annotated[str, "Its function (default: mlp hidden 2)"] = "mlp hidden 2",
) -> MindChange:
    """Put a new skill over an old one, whose place it takes.

    No line of the old one changes. Where it was master the new one is, and skills that influenced it influence
    the new one.

    Example: mindc edit encapsulate collect.mind Collect CarefulCollect \\
      --with Avoid --reads proximity
    """
    project.find(skill, "skill")
    for other in with_:
        project.find(other, "skill")
    project.refuse_new_skill(new, is_, reads)
    kind = is_.partition(" ")[0]
    lines = [
        f"skill {new} is {is_}",
        *(f"{insertion.INDENT}reads {reading}" for reading in reads),
        *(f"{insertion.INDENT}{influence(kind, below)}" for below in (skill, *with_)),
    ]
    moved = (insertion.replace_span(place.name.span, new) for place in project.places(skill))
    return MindChange((*moved, insertion.declare(project.main, "skill", lines)), replaced=Replaced(skill, new))


def extract(
    project: Project,
    parent: str,
    new: str,
    subskills: tuple[str, ...],
    *,
    reads: Annotated[tuple[str, ...], "What the new skill reads (default: what the parent does)"] = (),
    is_: Annotated[str, "Its function (default: mlp hidden 2)"] = "mlp hidden 2",
) -> MindChange:
    """Put subskills of a skill under a new one.

    The skill influences the new one in their place.

    Example: mindc edit extract collect.mind Collect Fetch GoToObject+Avoid Grab
    """
    declaration = project.own_skill(parent)
    project.refuse_new_skill(new, is_, reads)
    edges = {fact.name.text: fact for fact in syntax.of_form(declaration.facts, syntax.Influences)}
    for subskill in subskills:
        if subskill not in edges:
            message = f"{parent} does not influence {subskill}."
            raise EditError(message, did_you_mean(subskill, edges), declaration.header.span)
    first, *others = (fact for name, fact in edges.items() if name in subskills)
    inputs = reads or [fact.name.text for fact in syntax.of_form(declaration.facts, syntax.Reads)]
    indent = insertion.indentation(declaration)
    lines = [
        f"skill {new} is {is_}",
        *(f"{indent}reads {reading}" for reading in inputs),
        *(f"{indent}{insertion.line_of(fact)}" for fact in (first, *others)),
    ]
    return MindChange((
        insertion.replace_line(first, [f"{indent}{influence(kind_of(declaration), new)}"]),
        *(insertion.without_line(fact) for fact in others),
        insertion.declare_below(declaration, lines),
    ))  # fmt: skip


Edge = syntax.Drives | syntax.Influences


def inline(project: Project, skill: str) -> MindChange:
    """Let the subskills of a skill take its place.

    Whoever influenced it influences them, and the skill is taken out. What these lines need after `at` is read
    there as well.

    It is the reverse of extract.

    Example: mindc edit inline collect.mind Fetch
    """
    declaration = project.own_skill(skill)
    if not syntax.of_form(declaration.facts, syntax.Influences):
        message = f"{skill} is a base skill: there is nothing below it to take its place."
        raise EditError(message, "", declaration.header.span)
    parents = [parent for parent in project.parents(skill) if not parent.header.like]
    project.refuse_used("skill", skill, [declaration, *parents])
    if not parents:
        message = f"No skill influences {skill}: nothing can take its place."
        raise EditError(message, "", declaration.header.span)
    edges = [
        fact
        for parent in parents
        for fact in syntax.of_form(parent.facts, syntax.Influences)
        if fact.name.text == skill
    ]
    lines: list[syntax.Fact] = [
        *syntax.of_form(declaration.facts, syntax.Chooses),
        *(edge for edge in edges if edge.over),
    ]
    for line in lines:
        message = f"{skill} says more of its influence than lines of others could."
        raise EditError(message, "Take this out first.", line.span)
    splices = (splice for parent in parents for splice in _taken_over(parent, declaration))
    return MindChange((*insertion.without_declarations([declaration]), *splices))


def _taken_over(parent: syntax.Declaration, child: syntax.Declaration) -> list[Splice]:
    """The lines of a child in the place of that with which its parent influences it, but for what the parent says."""
    said = {fact.name.text for fact in parent.facts if isinstance(fact, Edge)}
    edges = [fact for fact in child.facts if isinstance(fact, Edge) and fact.name.text not in said]
    place = next(
        fact for fact in syntax.of_form(parent.facts, syntax.Influences) if fact.name.text == child.header.name.text
    )
    indent = insertion.indentation(parent)
    lines = [f"{indent}{insertion.line_of(fact)}" for fact in edges]
    splices = [insertion.replace_line(place, lines) if lines else insertion.without_line(place)]
    read = {fact.name.text for fact in syntax.of_form(parent.facts, syntax.Reads)}
    terms = (term for expression in syntax.expressions_in(*edges) for term in expression.terms)
    needed = dict.fromkeys(term.kind.text for term in terms if isinstance(term, syntax.Phrase))
    if reads := [f"reads {name}" for name in needed if name not in read]:
        splices.append(insertion.below_siblings(parent, "reads", reads))
    return splices


def integrate(
    project: Project,
    skill: str,
    *,
    with_: Annotated[tuple[str, ...], "A skill that it is to influence as well: --with GoToPower+Avoid"] = (),
    reads: Annotated[tuple[str, ...], "A sensor or memory that it is to read as well: --reads battery"] = (),
) -> MindChange:
    """Let a skill influence more skills and read more sensors.

    This is the paper's other way to extend a hierarchy. The skill is stale then. With --keep-weights it goes on
    as before until it is taught again.

    Example: mindc edit integrate collect.mind Collect \\
      --with Avoid --reads proximity --reads pulse
    """
    if not with_ and not reads:
        raise EditError("Nothing is to be integrated.", "Say what: --with SKILL, --reads SENSOR.")
    declaration = project.own_skill(skill)
    for other in with_:
        project.find(other, "skill")
        project.refuse_existing(declaration, "influences", other)
    for reading in reads:
        project.find(reading, "sensor", "memory")
        project.refuse_existing(declaration, "reads", reading)
    splices = []
    if reads:
        splices.append(insertion.below_siblings(declaration, "reads", [f"reads {reading}" for reading in reads]))
    if with_:
        lines = [influence(kind_of(declaration), other) for other in with_]
        splices.append(insertion.below_siblings(declaration, "influences", lines))
    return MindChange(tuple(splices))


def replace(project: Project, skill: str, new: str) -> MindChange:
    """Let another skill, or a hierarchy, take the place of a skill.

    Both stay declared. They must drive the same actuators. Skills that influenced the old one keep their
    weights and influence the new one.

    Example: mindc edit replace power.mind GoToPower+Avoid GoToPower
    """
    project.find(skill, "skill")
    declaration = project.find(new, "skill")
    if skill == new:
        raise EditError(f"{skill} takes its own place already.", "", declaration.header.name.span)
    if differ := sorted(_drives(project, skill) ^ _drives(project, new)):
        message = f"{skill} and {new} differ in what they drive: {listed(differ, 'and')}."
        raise EditError(message, "Replace it by a skill with the same interface.", declaration.header.name.span)
    places = [place for place in project.places(skill) if place.by is not declaration]
    for place in places:
        if place.by:
            project.refuse_existing(place.by, "influences", new)
    if not places:
        message = f"{skill} has no place: it is not the master, and no skill but {new} influences it."
        raise EditError(message, "", declaration.header.name.span)
    return MindChange(
        tuple(insertion.replace_span(place.name.span, new) for place in places), replaced=Replaced(skill, new)
    )


def _drives(project: Project, skill: str) -> set[str]:
    hierarchy, reached = project.mind.hierarchy, with_descendants(project.mind.influences, [skill])
    return {node.name for name in reached for node in hierarchy[Node("skill", name)] if node.noun == "actuator"}
