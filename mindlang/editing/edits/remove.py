"""`mindc edit remove`."""

from typing import Annotated

from mindlang.compiler.diagnostic import did_you_mean
from mindlang.compiler.source import Splice
from mindlang.compiler.syntax import NOUNS, Declaration
from mindlang.editing.insertion import owners, without_declarations, without_line
from mindlang.editing.project import EditError, MindChange, Project, refuse_mentioned, suggestion


def remove(
    project: Project,
    what: tuple[str, ...],
    *,
    from_: Annotated[str, "The declaration whose fact it is: --from Collect"] = "",
    noun: Annotated[str, "What that is, where two have the name: --noun task"] = "",
) -> MindChange:
    """Remove a declaration or, with --from, a fact.

    Nothing may name the declaration any more, which is said by its name alone, or as "sensor pulse" ("number sight");
    the fact is said as it stands.

    Example: mindc edit remove collect.mind "rewards 0.01 * forward per tick" \\
      --from GoToObject --noun task
    """
    words = " ".join(what).split()
    if from_:
        declaration = project.declared(from_, noun, among=owners(words[0]) or NOUNS)
        said = {" ".join(fact.span.text.split()): fact for fact in reversed(declaration.facts)}  # the first of two
        text = " ".join(words)
        if text not in said:
            hint = did_you_mean(text, said) or "Say the line as it stands there, without its comment."
            raise EditError(f"{declaration.header.name.text} does not say: {text}.", hint, declaration.header.span)
        return MindChange((without_line(said[text]),))
    if name := _name_of_number(project, words, noun):
        return MindChange((_number(project, name),))
    declaration = _declaration(project, words, noun)
    project.refuse_used(declaration.header.noun.text, declaration.header.name.text, [declaration])
    return MindChange(without_declarations([declaration]))


def _name_of_number(project: Project, words: list[str], noun: str) -> str:
    """The name where a number is meant: by its noun, or as nothing else is called so."""
    match words:
        case ["number", name]:
            return name
        case [name] if noun == "number" or (not noun and name in project.names.numbers):
            return name if noun or not project.names.noun_of(name, NOUNS) else ""
    return ""


def _number(project: Project, name: str) -> Splice:
    """The line of a number taken out; EditError where there is none, or where a line says its name."""
    if name not in project.names.numbers:
        raise EditError(f"There is no number called {name}.", suggestion(name, [*project.names.numbers]))
    used = [mention for mention in project.everywhere("number", name) if not mention.is_own]
    refuse_mentioned(name, used, "Write the number itself there first.")
    return without_line(project.names.numbers[name])


def _declaration(project: Project, words: list[str], noun: str) -> Declaration:
    """The declaration of a name, or of a noun and a name; EditError where there is none."""
    match words:
        case [name]:
            return project.declared(name, noun)
        case [of, name] if of in NOUNS:
            return project.find(name, of)
    hint = did_you_mean(words[0], NOUNS) if len(words) == 2 else ""
    example = 'Write for example pulse, or "reads pulse" --from Avoid.'
    raise EditError(f"{' '.join(words)} is neither a name nor a noun and a name.", hint or example)
