"""What skills promise: conditions over any readings of the mind."""

from collections.abc import Mapping

from mindlang.compiler import model
from mindlang.compiler.diagnostic import Findings
from mindlang.compiler.families import said
from mindlang.compiler.format import spaced
from mindlang.compiler.names import Names
from mindlang.compiler.resolve.expressions import Visible, resolve_expressions
from mindlang.compiler.resolve.parts import ONE_OF_TWO, said_once
from mindlang.compiler.syntax import Declaration, Promise, of_form


def resolve_promises(
    declaration: Declaration, names: Names, widths: Mapping[str, int], findings: Findings
) -> tuple[model.Promise, ...]:
    """The promises of a skill in the order of their lines; they need not be of what it reads itself."""
    visible = Visible(
        widths, unread=names.unread, made_of="numbers, sensors and memories", where="What a skill promises"
    )
    facts = of_form(declaration.facts, Promise)
    lines = said_once(facts, lambda fact: f"The skill already {spaced(said(fact))}.", findings, ONE_OF_TWO)
    return tuple(model.Promise(resolve_expressions(fact, visible, findings), fact) for fact in lines)
