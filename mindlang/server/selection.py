"""What is selected of a file, and what stands there."""

from dataclasses import dataclass
from pathlib import Path

from mindlang.compiler.syntax import Declaration, Fact
from mindlang.editing.project import Project
from mindlang.server.view import on_line


@dataclass(frozen=True, slots=True)
class Selection:
    """What is selected of a file: from offset `start` up to `end`, which is the same where the cursor just stands."""

    project: Project
    path: Path
    start: int
    end: int

    @property
    def declarations(self) -> list[Declaration]:
        """The declarations of the file whose headers are selected."""
        return [each for each in self._own if self.start <= each.header.span.start and each.header.span.end <= self.end]

    @property
    def declaration(self) -> Declaration | None:
        """The declaration on one of whose lines the selection begins."""
        lines = ((each, span) for each in self._own for span in [each.header.span, *(f.span for f in each.facts)])
        return next((each for each, span in lines if on_line(span, self.start)), None)

    @property
    def _own(self) -> tuple[Declaration, ...]:
        file = self.project.paths.get(self.path)
        return file.declarations if file else ()

    def touches(self, fact: Fact) -> bool:
        """Whether the line of a fact is selected, or some of it."""
        return on_line(fact.span, self.start) or (self.start <= fact.span.end and fact.span.start < self.end)
