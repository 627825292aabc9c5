"""A lesson that has nobody to teach, because what it teaches is frozen.

A frozen skill keeps its weights, and training passes such a lesson over. Take `stays frozen` out if the skill is to
learn again, or the lesson if it is not.
"""

from mindlang.compiler.hierarchy import with_descendants
from mindlang.lint.examples import LEARNS, REWARDED, SCHOOL
from mindlang.lint.study import Finding, Found, Study, removal

GOOD = LEARNS + REWARDED + SCHOOL
BAD = GOOD.replace("  reads eye", "  stays frozen\n  reads eye")


def check(study: Study) -> Found:
    for lesson in study.mind.lessons:
        taught = with_descendants(study.mind.influences, [lesson.skill]) if lesson.with_subskills else {lesson.skill}
        if taught.isdisjoint(study.learning):
            also = " and so do all that learn below it" * lesson.with_subskills
            hint = f"{study.main.edit('unfreeze', lesson.skill)} lets it learn again; else take the lesson out."
            message = f"{lesson.skill} stays frozen{also}: this lesson teaches nobody."
            fix = removal(lesson.fact, "Remove the lesson")
            yield Finding(lesson.fact.skill.span, message, hint, fix=fix)
