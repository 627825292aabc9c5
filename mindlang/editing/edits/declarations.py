"""Edits that add, remove and move what is declared and said of it."""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Annotated

from mindlang.compiler.diagnostic import Findings, did_you_mean
from mindlang.compiler.parse import parse
from mindlang.compiler.source import Source, Span, Splice
from mindlang.compiler.syntax import NOUNS, Declaration, Fact, File, Number, verb_of
from mindlang.editing import insertion
from mindlang.editing.project import EditError, MindChange, Project, refuse_mentioned, suggestion


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
        declaration = project.declared(from_, noun, among=insertion.owners(words[0]) or NOUNS)
        said = {" ".join(fact.span.text.split()): fact for fact in reversed(declaration.facts)}  # the first of two
        text = " ".join(words)
        if text not in said:
            hint = did_you_mean(text, said) or "Say the line as it stands there, without its comment."
            raise EditError(f"{declaration.header.name.text} does not say: {text}.", hint, declaration.header.span)
        return MindChange((insertion.without_line(said[text]),))
    if name := _name_of_number(project, words, noun):
        return MindChange((_number(project, name),))
    declaration = _declaration(project, words, noun)
    project.refuse_used(declaration.header.noun.text, declaration.header.name.text, [declaration])
    return MindChange(insertion.without_declarations([declaration]))


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
    return insertion.without_line(project.names.numbers[name])


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


def split(project: Project, to: str, names: tuple[str, ...]) -> MindChange:
    """Move declarations to a new file, and use it.

    A name that two nouns have takes its noun with it: task:Avoid.

    Example: mindc edit split collect.mind wheels.mind left_wheel right_wheel
    """
    main = project.main.source
    path = (main.folder / to).resolve()
    if not path.is_relative_to(main.folder) or path.suffix != ".mind" or '"' in to or Path(to).is_absolute():
        message = f"{to} is no .mind file in the folder of {main.name} or below it."
        raise EditError(message, "Write for example skills.mind.")
    used = (file.source.path.resolve() for file in project.files)  # an editor may not have saved them
    if path.exists() or path in used:
        raise EditError(f"{to} exists already.", "Choose another name.")
    chosen = []
    for noun, _, own in (name.rpartition(":") for name in dict.fromkeys(names)):
        declaration = project.declared(own, noun, f"{{}}:{own}")
        if declaration.header.span.source is not main:
            raise EditError(f"{own} stands in another file.", "", declaration.header.name.span)
        chosen.append(declaration)
    splices = (*insertion.without_declarations(chosen), insertion.use_line(project.main, Path(to).as_posix()))
    return MindChange(splices, created={path: insertion.text_of(chosen)})
