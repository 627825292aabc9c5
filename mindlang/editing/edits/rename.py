"""`mindc edit rename`."""

import re
from pathlib import Path
from typing import Annotated

from mindrun.terminal.command_line import command_line

from mindlang.compiler.compile import load
from mindlang.compiler.diagnostic import Label, a, listed
from mindlang.compiler.families import is_of_family, letter_in, numbered
from mindlang.compiler.names import VALUE_NOUNS, Mention, introductions
from mindlang.compiler.source import Span, Splice
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

    A family is renamed by the name in its line, GoN to SeekN.

    Other minds that use the same files follow, those beside them and in the folders above.

    Example: mindc edit rename collect.mind Avoid Dodge --noun skill
    """
    declared = _declared(project, old, noun)
    of = declared.noun
    _refuse_under_alias(declared, new, noun)
    refuse_misnamed(of, new)
    splices, renamed = dict[Span, Splice](), list[Renamed]()
    for name, now in _called(project, declared, old, new).items():
        for each in (project, *project.sharing(of, name)):
            _refuse_taken(each, of, now)
        path = declared.name.span.source.path
        used = ((other.paths[path].source.alias, other) for other in project.neighbours if path in other.paths)
        is_local = of in ("thing", "draw")
        aliases = {alias: other for alias, other in used if alias and not is_local}  # the others' names for its file
        mentions = [("", mention) for mention in project.everywhere(of, name)]
        mentions += [
            (f"{alias}.", mention)
            for alias, other in aliases.items()
            for mention in other.mentions(of, f"{alias}.{name}")
            if not mention.name.span.source.alias
        ]
        for prefix, mention in mentions:
            splices[mention.name.span] = replace_span(mention.name.span, prefix + _written(mention, old, new, now))
        renamed += [Renamed(of, prefix + name, prefix + now) for prefix in ("", *(f"{alias}." for alias in aliases))]
    return MindChange(tuple(splices.values()), tuple(renamed), of_families=True)


def _called(project: Project, declared: Mention, old: str, new: str) -> dict[str, str]:
    """The new name of each name: of all members of a family, or of the one that is declared."""
    if not is_of_family(declared.name):
        return {old: new}
    letter, line = letter_in(old), declared.name.span
    if letter == "" or line.text != old:
        hint = f"Rename the family, {line.text}, or write it out first: {project.main.source.edit('unfold')}"
        raise EditError(f"{old} is one of a family.", hint, line)
    if letter_in(new) != letter:
        raise EditError(f"The name of this family ends in {letter}.", f"Write for example {new}{letter}.", line)
    families = [m.name for m in introductions(project.files) if m.noun == declared.noun and m.name.span.text == old]
    parts = re.compile(numbered(re.escape(old), letter, r"(\\d+)"))
    found = {name.text: parts.fullmatch(name.text) for name in families if is_of_family(name)}
    return {name: numbered(new, letter, its[1]) for name, its in found.items() if its}


def _written(mention: Mention, old: str, new: str, now: str) -> str:
    """What stands for a new name in a place; in the line of a family, perhaps with another letter."""
    if not is_of_family(mention.name):
        return now
    if now == new:
        hint = f"Write that line out first: {mention.name.span.source.edit('unfold')}"
        raise EditError(f"{old} stands in a line of a family.", hint, mention.name.span)
    return numbered(new, letter_in(old), letter_in(mention.name.span.text))


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
    found = {
        mention.noun: mention
        for mention in known
        if mention.name.text == name or (is_of_family(mention.name) and mention.name.span.text == name)
    }
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
