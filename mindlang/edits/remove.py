"""`mindc edit remove`."""

from typing import Annotated

from mindlang.compiler.diagnostic import did_you_mean
from mindlang.compiler.syntax import NOUNS, Declaration
from mindlang.editing.insertion import without_declarations, without_fact
from mindlang.editing.owners import owner
from mindlang.editing.project import EditError, MindChange, Project


def remove(
    project: Project,
    what: tuple[str, ...],
    *,
    from_: Annotated[str, "The declaration whose fact it is: --from Collect"] = "",
    noun: Annotated[str, "What that is, where two have the name: --noun task"] = "",
) -> MindChange:
    """Remove a declaration or, with --from, a fact.

    Nothing may name the declaration any more, which is said by its name alone, or as "sensor pulse"; the fact is said
    as it stands.

    Example: mindc edit remove "rewards 0.01 * forward per tick" --from GoToObject --noun task collect.mind
    """
    words = " ".join(what).split()
    if from_:
        return _fact(words, project.declared(from_, noun or owner(" ".join(words))))
    declaration = _declaration(project, words, noun)
    project.refuse_used(declaration.header.noun.text, declaration.header.name.text, [declaration])
    return MindChange(without_declarations([declaration]))


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


def _fact(words: list[str], declaration: Declaration) -> MindChange:
    """A declaration without the first of its facts that says these words; EditError where none does."""
    said = {" ".join(fact.span.text.split()): fact for fact in reversed(declaration.facts)}
    text = " ".join(words)
    if text not in said:
        hint = did_you_mean(text, said) or "Say the line as it stands there, without its comment."
        raise EditError(f"{declaration.header.name.text} does not say: {text}.", hint, declaration.header.span)
    return MindChange((without_fact(said[text]),))
