"""A rule that reads what it does not use.

Only the values and the conditions of its lines say what a rule does. A reading in none of them changes nothing, except
that the rule falls silent when that sensor fails.
"""

from mindlang.compiler.diagnostic import Fix
from mindlang.compiler.model import Reading
from mindlang.compiler.syntax import Reads
from mindlang.editing.insertion import without_fact
from mindlang.lint.study import Finding, Found, Study

EYES = "sensor left_eye is range_finder at 40 deg\nsensor right_eye is range_finder at -40 deg\n"
GO = "skill Go is rule\n  reads left_eye\n  reads right_eye\n"
GOOD = (f"{EYES}{GO}  drives left_wheel at right_eye\n  drives right_wheel at left_eye\n",)
BAD = (f"{EYES}{GO}  drives left_wheel at right_eye\n  drives right_wheel at right_eye\n",)


def check(study: Study) -> Found:
    """Lines of rules that read what stands after none of their `at`."""
    for skill in study.mind.skills:
        if not skill.function.has_outputs:
            values = [value for edge in skill.edges for value in edge.expressions]
            used = {term.name for value in values for term in value.terms if isinstance(term, Reading)}
            for fact in skill.declaration.facts:
                if isinstance(fact, Reads) and fact.name.text not in used:
                    fix = Fix("Remove the line", (without_fact(fact),), is_safe=False)
                    message = f"{skill.name} reads {fact.name.text}, but no value of it depends on that."
                    hint = f"Use {fact.name.text} in a value after at, or take the line out."
                    yield Finding(fact.span, message, hint, fix=fix)
