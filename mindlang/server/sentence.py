"""A line as far as it is written: its words, and the declaration to which it belongs."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from mindlang.compiler.syntax import Declaration, Drives, Influences, Reads
from mindlang.server.view import View, on_line


@dataclass(frozen=True, slots=True)
class Line:
    """What stands before a place in its line, and the declaration to which the line belongs."""

    view: View
    folder: Path
    words: Sequence[str]
    above: Declaration | None
    offset: int

    @property
    def noun(self) -> str:
        """The noun of the declaration above."""
        return self.above.header.noun.text if self.above else ""

    def said(self, *forms: type[Reads | Drives | Influences]) -> set[str]:
        """What the skill above says with these verbs on its other lines."""
        facts = [fact for fact in (self.above.facts if self.above else ()) if isinstance(fact, forms)]
        return {fact.name.text for fact in facts if not on_line(fact.span, self.offset)}
