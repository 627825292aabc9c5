"""`mindc edit add`."""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import Annotated

from mindlang.compiler.diagnostic import Findings
from mindlang.compiler.parse import parse
from mindlang.compiler.source import Source, Span, Splice
from mindlang.compiler.syntax import Declaration, Fact, File, Number, verb_of
from mindlang.editing import insertion
from mindlang.editing.project import EditError, MindChange, Project


def add(
    project: Project,
    lines: tuple[str, ...],
    *,
    to: Annotated[str, "The declaration to which facts are added: --to Collect"] = "",
    noun: Annotated[str, "What that is, where two have the name: --noun task"] = "",
) -> MindChange:
    """Add declarations or, with --to, facts to a declaration.

    They are said as in a file, a line each. A declaration stands below the last of its noun, a fact below the
    last of its verb.

    Example: mindc edit add collect.mind "skill Wait is rule" \\
      "drives left_wheel at 1/2" "drives right_wheel at 1/2"
    """
    said = [line.strip() for text in lines for line in text.splitlines()]
    if to:
        declaration = project.declared(to, noun, among=next(filter(None, map(insertion.owners, said)), insertion.NOUNS))
        read = _read(said, declaration.header.span.text)
        of, *others = read.declarations
        if read.settings or others or not of.facts:
            raise EditError("With --to only facts can be added.", "Begin with a verb: reads, rewards, teaches, ….")
        return MindChange(tuple(_facts(declaration, of.facts)))
    return MindChange(tuple(_declarations(project, _read(said))))


def _declarations(project: Project, read: File) -> Iterator[Splice]:
    """The numbers, and each noun's declarations, below those that there are."""
    numbers = [setting for setting in read.settings if isinstance(setting, Number)]
    if not (read.declarations or numbers) or len(numbers) < len(read.settings):
        raise EditError(
            "Only declarations, numbers and facts can be added.", "Begin with a noun: skill, sensor, task, …."
        )
    for number in numbers:
        project.refuse_taken("number", number.name.text)
    if numbers:
        settings = project.main.settings
        last = [*settings, *(setting for setting in settings if isinstance(setting, Number))][-1]
        yield insertion.insert_below(insertion.first_line(last.span), [number.span.text for number in numbers])
    for declaration in read.declarations:
        project.refuse_taken(declaration.header.noun.text, declaration.header.name.text)
    for noun in insertion.NOUNS:
        if texts := [_indented(known) for known in read.declarations if known.header.noun.text == noun]:
            yield insertion.declare(project.main, noun, *texts)


def _indented(declaration: Declaration) -> list[str]:
    """The lines of a declaration, those below its header indented; comments stay where they are."""
    lines = insertion.text_of([declaration]).splitlines()
    above = next(index for index, line in enumerate(lines, 1) if not line.startswith("#"))
    return [*lines[:above], *(f"{insertion.INDENT}{line}" for line in lines[above:])]


def _facts(declaration: Declaration, said: Sequence[Fact]) -> Iterator[Splice]:
    """Each verb's facts below those that there are."""
    for verb in insertion.FACTS:
        if texts := [text for fact in said if verb_of(fact) == verb for text in insertion.commented(fact)]:
            yield insertion.below_siblings(declaration, verb, texts)


def _read(lines: list[str], header: str = "") -> File:
    """The lines as a file, below a header that is not theirs; EditError where one cannot be read."""
    above = f"{header}\n" if header else ""
    source = Source("the lines to add", "\n".join(lines))
    findings = Findings()
    file = parse(replace(source, text=above + source.text), findings)
    for diagnostic in findings.diagnostics[:1]:
        error = EditError(diagnostic.message, diagnostic.hint)
        assert diagnostic.span is not None
        place = Span(source, diagnostic.span.start - len(above), diagnostic.span.end - len(above))
        error.diagnostic = replace(diagnostic, span=place)
        raise error
    return file
