"""`mindc edit rename`."""

from pathlib import Path
from typing import Annotated

from mindrun.terminal.command_line import command_line

from mindlang.compiler.compile import load
from mindlang.compiler.diagnostic import Label, a, listed
from mindlang.compiler.references import VALUE_NOUNS, Mention, introductions
from mindlang.compiler.syntax import NOUNS, Rewards, of_form
from mindlang.editing.insertion import replace_span
from mindlang.editing.project import (
    EditError,
    MindChange,
    Project,
    Renamed,
    refuse_misnamed,
    refuse_no_noun,
    suggestion,
)


def rename(
    project: Project,
    old: str,
    new: str,
    *,
    noun: Annotated[str, "What it is, where two have the name: --noun task"] = "",
) -> MindChange:
    """Rename anything, wherever it is named and in the locks.

    Other minds that use the same files follow, those beside them and in the folders above.

    Example: mindc edit rename collect.mind Avoid Dodge --noun skill
    """
    declared = _declared(project, old, noun)
    of = declared.noun
    _refuse_under_alias(declared, new, noun)
    refuse_misnamed(of, new)
    for each in (project, *project.sharing(of, old)):
        _refuse_taken(each, of, new)
    places = (mention.name.span for mention in project.everywhere(of, old))
    path = declared.name.span.source.path
    used = ((other.paths[path].source.alias, other) for other in project.neighbours if path in other.paths)
    is_local = of in ("thing", "draw")
    aliases = {alias: other for alias, other in used if alias and not is_local}  # the others' names for its file
    others = (
        replace_span(mention.name.span, f"{alias}.{new}")
        for alias, other in aliases.items()
        for mention in other.mentions(of, f"{alias}.{old}")
        if not mention.name.span.source.alias
    )
    splices = (*(replace_span(place, new) for place in places), *others)
    elsewhere = (Renamed(of, f"{alias}.{old}", f"{alias}.{new}") for alias in aliases)
    return MindChange(splices, (Renamed(of, old, new), *elsewhere))


def _refuse_under_alias(declared: Mention, new: str, noun: str) -> None:
    """EditError where a file declares it that has other names here: with the command that renames it there."""
    source = declared.name.span.source
    if not source.alias:
        return
    own, new, file = declared.name.span.text, new.removeprefix(f"{source.alias}."), source.path
    message = f"{declared.name.text} is {own} in {source.name}, which is used as {source.alias}."
    which = ("--noun", noun) if noun else ()
    command = command_line("mindc", "edit", "rename", Path(source.name), own, new, *which)
    hint = f"Rename it there, and it is followed here: {command}"
    if load(file).graph is None:
        here = declared.name.text.removesuffix(own)  # a thing has no other name here
        also = f"{here}{own} {here}{new} here"
        hint = f"{source.name} is no mind by itself, so do it by hand: call {own} {new} there, and {also}."
    raise EditError(message, hint, declared.name.span)


def _declared(project: Project, name: str, noun: str) -> Mention:
    """The declaration of a name with a noun, or with the only one that has it."""
    if noun:
        refuse_no_noun(noun, (*NOUNS, "thing", "draw", "number"))
    known = [mention for mention in introductions(project.files) if noun in ("", mention.noun)]
    found = {mention.noun: mention for mention in known if mention.name.text == name}
    if not found:
        hint = suggestion(name, list(dict.fromkeys(mention.name.text for mention in known)))
        raise EditError(f"There is no {noun} called {name}." if noun else f"Nothing is called {name}.", hint)
    first, *others = found.values()
    if others:
        labels = [Label(mention.name.span, a(mention.noun)) for mention in others]
        message = f"{name} is {listed(map(a, found), 'and')}."
        raise EditError(message, f"Say which: --noun {first.noun}", first.name.span, *labels)
    return first


def _refuse_taken(project: Project, noun: str, name: str) -> None:
    """EditError where a name would mean something else in a mind.

    A thing with the name of one in another task would be the same one for every sensor; a reading or a number with that
    of a `for each` would be taken for it in the reward.
    """
    if noun != "thing":
        project.refuse_taken(noun, name)
    for mention in introductions(project.files) if noun in ("thing", "draw") else ():
        if (mention.noun, mention.name.text) == (noun, name):
            message = f"There is already {a(noun)} called {name}."
            raise EditError(message, "Choose another name.", mention.name.span)
    tasks = (declaration for _, declaration in project.names.declarations("task"))
    for reward in (reward for task in tasks for reward in of_form(task.facts, Rewards)):
        if noun in VALUE_NOUNS and reward.each and reward.each.name.text == name:
            message = f"A reward goes through readings by the name {name}."
            raise EditError(message, "Choose another name.", reward.each.name.span)
