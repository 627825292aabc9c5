"""`mindc edit remove`."""

from typing import Annotated

from mindlang.diagnostic import Label, a, did_you_mean
from mindlang.editing.page import without_declaration, without_line
from mindlang.editing.project import Change, EditError, Project
from mindlang.syntax import NOUNS, Declaration


def remove(
    project: Project,
    what: tuple[str, ...],
    *,
    from_: Annotated[str, "The declaration whose fact it is: --from Collect"] = "",
    noun: Annotated[str, "What that is, where two have the name: --noun task"] = "",
) -> Change:
    """Remove a declaration that nothing names any more, or with --from a fact, said as it stands.

    Example: mindc edit remove sensor pulse collect.mind
    """
    text = " ".join(what)
    if from_:
        return _fact(project, text, project.declared(from_, noun))
    head, _, name = text.partition(" ")
    if head not in NOUNS or not name:
        hint = did_you_mean(head, NOUNS) or 'Write for example sensor pulse, or "reads pulse" --from Avoid.'
        raise EditError(f"{text} is not a noun and a name.", hint)
    declaration = project.find(name, head)
    refuse_used(project, head, name, declaration)
    return Change((without_declaration(declaration),))


def refuse_used(project: Project, noun: str, name: str, declaration: Declaration) -> None:
    """EditError where a name stands anywhere but in its own declaration."""
    used = [mention.name.span for mention in project.mentions(noun, name) if mention.by is not declaration]
    if used:
        labels = [Label(span, "and here") for span in used[1:]]
        raise EditError(f"{name} is still used.", "Take these lines out first.", used[0], *labels)


def _fact(project: Project, text: str, declaration: Declaration) -> Change:
    found = [fact for fact in declaration.facts if fact.span.text.split() == text.split()]
    if not found:
        name, noun = declaration.header.name.text, declaration.header.noun.text
        said = [" ".join(fact.span.text.split()) for fact in declaration.facts]
        hint = did_you_mean(text, said) or "Say the line as it stands there, without its comment."
        raise EditError(f"{a(noun).capitalize()} {name} does not say: {text}.", hint, declaration.header.span)
    return Change((without_line(found[0].span),))
