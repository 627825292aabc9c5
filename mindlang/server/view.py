"""What an editor looks at: the files of one mind as they are now, parsed even where they do not compile."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path

from mindrun.errors import MindError

from mindlang.compiler.compile import Compiled, load
from mindlang.compiler.diagnostic import Diagnostic, Findings
from mindlang.compiler.expand import expand
from mindlang.compiler.names import Names, gather
from mindlang.compiler.references import Mention, mentions
from mindlang.compiler.source import Span
from mindlang.compiler.syntax import Declaration, Fact, File, Setting
from mindlang.compiler.use import files

Texts = Mapping[Path, str]


@dataclass(frozen=True)
class MindView:
    """The files of a mind, main one first, and what is declared in them."""

    main: Path
    compiled: Compiled
    files: tuple[File, ...]
    names: Names

    @property
    def paths(self) -> list[Path]:
        """Where the files stand."""
        return [file.source.path for file in self.files]

    def file(self, path: Path) -> File | None:
        """The file at a path, if it is one of these."""
        return next((file for file in self.files if file.source.path == path), None)

    @cached_property
    def whole(self) -> Names:
        """What is declared, with all that scenes and tasks say which others are like."""
        return expand(self.names, {}, 1.0, Findings())

    @cached_property
    def mentions(self) -> tuple[Mention, ...]:
        """Every name in the files that is declared in one of them."""
        return tuple(mentions(self.files, self.names))

    def mention_at(self, path: Path, offset: int) -> Mention | None:
        """The name in which, or right behind which, an offset lies."""
        return next((m for m in self.mentions if m.name.span.source.path == path and _holds(m.name.span, offset)), None)

    @cached_property
    def findings(self) -> tuple[Diagnostic, ...]:
        """What is wrong, and where nothing is, what is hardly meant; a damaged lock is a finding, too."""
        from mindlang.lint.lint import lint
        from mindlang.lint.settings_file import settings_of

        settings = settings_of(self.main)
        try:
            found = lint(self.compiled, settings.codes(self.main))
            return (*map(self._in_first_line, settings.wrong), *found)
        except MindError as error:
            where = Span(self.compiled.sources[0], 0, 0)
            damage = Diagnostic("damaged-lock", f"{error}.", where, error.hint, severity="warning")
            return (*self.compiled.diagnostics, damage)

    def _in_first_line(self, diagnostic: Diagnostic) -> Diagnostic:
        """What is wrong in another file, said in the first line of the mind's own: an editor has that one open."""
        where = f"{diagnostic.span.source.name}:{diagnostic.span.line}: " if diagnostic.span else ""
        here = Span(self.compiled.sources[0], 0, 0) if self.compiled.sources else None
        return replace(diagnostic, message=f"{where}{diagnostic.message}", span=here, severity="warning")


def view(main: Path, texts: Texts) -> MindView:
    """The mind whose main file stands at a path; files in `texts` are taken from there."""
    compiled = load(main, texts)
    if compiled.mind:
        found = compiled.mind.files
    elif compiled.sources:
        found = tuple(files(compiled.sources[0], main, Findings(), texts)[0])
    else:
        found = ()
    return MindView(main, compiled, found, gather(found, Findings()))


def declaration_at(file: File, offset: int) -> Declaration | None:
    """The declaration to which a line at an offset belongs: the one whose header stands last before it."""
    lines: list[tuple[int, Setting | Declaration]] = [(setting.span.start, setting) for setting in file.settings]
    lines += [(declaration.header.span.start, declaration) for declaration in file.declarations]
    above = max((line for line in lines if line[0] <= offset), key=lambda line: line[0], default=(0, None))[1]
    return above if isinstance(above, Declaration) else None


def fact_at(declaration: Declaration, offset: int) -> Fact | None:
    """The fact on whose line an offset lies."""
    return next((fact for fact in declaration.facts if on_line(fact.span, offset)), None)


def on_line(span: Span, offset: int) -> bool:
    """Whether an offset lies on the line of a span."""
    text = span.source.text
    end = text.find("\n", span.end)
    return text.rfind("\n", 0, span.start) < offset <= (len(text) if end < 0 else end)


def _holds(span: Span, offset: int) -> bool:
    return span.start <= offset <= span.end
