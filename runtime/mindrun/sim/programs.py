"""The postfix programs of a mind, one after the other in one table."""

from dataclasses import dataclass, field

from mindrun.graph.graph import Program
from mindrun.numbers.stack_machine import COMMAND, NEGATE, NUMBER, OPERATIONS


@dataclass(slots=True)
class Programs:
    """Collects programs: `rows` of (operation, argument, number), and the `depth` of the stack that they need."""

    rows: list[tuple[int, int, float]] = field(default_factory=list)
    depth: int = 1

    def add(self, program: Program) -> tuple[int, int]:
        """Where the program begins, and how long it is."""
        first, depth = len(self.rows), 0
        for name, value in program:
            op = OPERATIONS[name]
            depth += 1 if op <= COMMAND else 0 if op == NEGATE else -1
            self.depth = max(self.depth, depth)
            number = float(value) if op == NUMBER else 0.0
            self.rows.append((op, 0 if op == NUMBER else int(value), number))
        return first, len(self.rows) - first
