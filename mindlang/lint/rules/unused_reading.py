"""A rule that reads what it does not use.

Only the values and the conditions of its lines say what a rule does. A reading in none of them changes nothing, except
that the rule falls silent when that sensor fails.
"""

from mindlang.compiler.syntax import Reads, of_form
from mindlang.lint.study import Finding, Found, Study, readings, removal

EYES = "sensor left_eye is range_finder at 40 deg\nsensor right_eye is range_finder at -40 deg\n"
GO = "skill Go is rule\n  reads left_eye\n  reads right_eye\n"
GOOD = f"{EYES}{GO}  drives left_wheel at right_eye\n  drives right_wheel at left_eye\n"
BAD = f"{EYES}{GO}  drives left_wheel at right_eye\n  drives right_wheel at right_eye\n"


def check(study: Study) -> Found:
    for skill in (skill for skill in study.mind.skills if not skill.function.has_outputs):
        used = readings(*((edge.at, edge.gate) for edge in skill.edges))
        for fact in of_form(skill.declaration.facts, Reads):
            if fact.name.text not in used:
                message = f"{skill.name} reads {fact.name.text}, but no value of it depends on that."
                hint = f"Use {fact.name.text} in a value after at, or take the line out."
                yield Finding(fact.span, message, hint, fix=removal(fact))
