"""`mindc edit rename`."""

from typing import Annotated

from mindrun.registry import kinds

from mindlang.diagnostic import Label, a, listed
from mindlang.editing.page import instead
from mindlang.editing.project import Change, EditError, Project, Renamed, facts, refuse_misnamed
from mindlang.syntax import Rewards

NOUNS = ("skill", "task", "sensor", "actuator", "memory", "thing", "curriculum", "body")


def rename(
    project: Project, old: str, new: str, *, noun: Annotated[str, "What it is, where two have the name"] = ""
) -> Change:
    """Rename a skill, sensor, actuator, memory, task, thing, curriculum or body: wherever it is named, and in the locks.

    Example: mindc edit rename Avoid Dodge --noun skill collect.mind
    """
    of = noun or _noun(project, old)
    found = [mention for mention in project.mentions(of, old)]
    if not found:
        raise EditError(f"There is no {of} called {old}.", "mindc show lists what there is.")
    refuse_misnamed(of, new)
    if of == "thing":
        _refuse_taken_thing(project, new)
    else:
        project.refuse_taken(of, new)
    if of in ("sensor", "memory"):
        _refuse_captured(project, new)
    return Change(tuple(instead(mention.name.span, new) for mention in found), (Renamed(of, old, new),))


def _noun(project: Project, name: str) -> str:
    """What a name is, if it is one thing only."""
    found = [noun for noun in NOUNS if any(project.mentions(noun, name))]
    if len(found) == 1:
        return found[0]
    if not found:
        raise EditError(
            f"Nothing is called {name}.", "mindc show lists the skills; names of tasks and parts stand in the source."
        )
    labels = [
        Label(mention.name.span, a(noun))
        for noun in found
        for mention in project.mentions(noun, name)
        if mention.declares
    ]
    raise EditError(
        f"{name} is {listed([a(noun) for noun in found], 'and')}.",
        f"Say which: --noun {found[0]}",
        labels[0].span,
        *labels[1:],
    )


def _refuse_taken_thing(project: Project, name: str) -> None:
    """A thing may have the name of one in another task: then they are one for every sensor."""
    if taken := next((mention for mention in project.mentions("thing", name) if mention.declares), None):
        raise EditError(f"There is already a thing called {name}.", "Choose another name.", taken.name.span)


def _refuse_captured(project: Project, name: str) -> None:
    """A reading with the name of a measure, or of a `for each`, would be taken for that in rewards."""
    if name in kinds("measure"):
        raise EditError(
            f"{name} is a measure: rewards that say it would mean the reading then.", "Choose another name."
        )
    for declaration in project.names.table.get("task", {}).values():
        for reward in facts(declaration, Rewards):
            if reward.each and reward.each.name.text == name:
                raise EditError(
                    f"A reward goes through readings by the name {name}.", "Choose another name.", reward.each.name.span
                )
