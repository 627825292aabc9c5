"""`mindc edit add`."""

from typing import Annotated

from mindlang.diagnostic import Diagnostic, Findings
from mindlang.editing.page import below_siblings, declare
from mindlang.editing.project import Change, EditError, Project
from mindlang.parse import parse
from mindlang.source import Source
from mindlang.splice import Splice
from mindlang.syntax import Declaration, Fact, File


def add(
    project: Project,
    lines: tuple[str, ...],
    *,
    to: Annotated[str, "The declaration to which facts are added: --to Collect"] = "",
    noun: Annotated[str, "What that is, where two have the name: --noun task"] = "",
) -> Change:
    """Add a declaration with its facts, or with --to facts to a declaration, said as in a file.

    A declaration stands below the last of its noun, a fact below the last of its verb.

    Example: mindc edit add "skill Wait is rule" "drives left_wheel at 1/2" "drives right_wheel at 1/2" collect.mind
    """
    if to:
        declaration = project.declared(to, noun)
        header = declaration.header.span.text
        return Change(_facts(declaration, _read([header, *lines]).declarations[0].facts))
    read = _read(list(lines))
    if not read.declarations or read.settings:
        raise EditError("Only declarations and facts can be added.", "Begin with a noun: skill, sensor, task, ….")
    return Change(tuple(_declaration(project, declaration) for declaration in read.declarations))


def _read(lines: list[str]) -> File:
    """The lines as a file; EditError where one cannot be read."""
    findings = Findings()
    file = parse(Source("the lines to add", "\n".join(line.strip() for line in lines)), findings)
    if findings.diagnostics:
        raise _unreadable(findings.diagnostics[0])
    return file


def _unreadable(diagnostic: Diagnostic) -> EditError:
    error = EditError(diagnostic.message, diagnostic.hint)
    error.diagnostic = diagnostic
    return error


def _declaration(project: Project, declaration: Declaration) -> Splice:
    noun, name = declaration.header.noun.text, declaration.header.name.text
    project.refuse_taken(noun, name)
    text = declaration.header.span.text.strip()
    return declare(project.main, noun, [text, *(f"  {fact.span.text.strip()}" for fact in declaration.facts)])


def _facts(declaration: Declaration, facts: tuple[Fact, ...]) -> tuple[Splice, ...]:
    forms = dict.fromkeys(type(fact) for fact in facts)
    return tuple(
        below_siblings(declaration, form, [fact.span.text.strip() for fact in facts if isinstance(fact, form)])
        for form in forms
    )
