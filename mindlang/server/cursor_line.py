"""Where the cursor stands in a file."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from mindlang.compiler.syntax import Declaration, Drives, Influences, Reads
from mindlang.server.view import MindView, on_line


@dataclass(frozen=True, slots=True)
class CursorLine:
    """What stands before a place in its line, and the declaration to which the line belongs."""

    view: MindView
    folder: Path
    words: Sequence[str]
    above: Declaration | None
    offset: int

    @property
    def noun(self) -> str:
        """The noun of the declaration above."""
        return self.above.header.noun.text if self.above else ""

    def names_after(self, *forms: type[Reads | Drives | Influences]) -> set[str]:
        """What the skill above says with these verbs on its other lines."""
        facts = [fact for fact in (self.above.facts if self.above else ()) if isinstance(fact, forms)]
        return {fact.name.text for fact in facts if not on_line(fact.span, self.offset)}
