"""A lesson that has nobody to teach, because what it teaches is frozen.

A frozen skill keeps its weights, and training passes such a lesson over. Take `stays frozen` out if the skill is to
learn again, or the lesson if it is not.
"""

from mindlang.compiler.diagnostic import Fix
from mindlang.editing.insertion import without_fact
from mindlang.lint.study import Finding, Found, Study

GOOD = (
    """
sensor eye is range_finder at 0 deg
skill Go is mlp
  reads eye
  drives left_wheel
task Course in arena
  lasts 9 s
  rewards forward per tick
curriculum School is genetic
  teaches Go on Course for 10 generations
""",
)
BAD = (GOOD[0].replace("  reads eye", "  stays frozen\n  reads eye"),)


def check(study: Study) -> Found:
    """Lessons whose learners are all frozen."""
    can_learn = _can_learn(study) if any(lesson.with_subskills for lesson in study.mind.lessons) else set()
    for lesson in study.mind.lessons:
        if lesson.skill not in (can_learn if lesson.with_subskills else study.learning):
            also = " and so do all that learn below it" * lesson.with_subskills
            fix = Fix("Remove the lesson", (without_fact(lesson.fact),), is_safe=False)
            hint = f"{study.main.edit('unfreeze', lesson.skill)} lets it learn again; else take the lesson out."
            message = f"{lesson.skill} stays frozen{also}: this lesson teaches nobody."
            yield Finding(lesson.fact.skill.span, message, hint, fix=fix)


def _can_learn(study: Study) -> set[str]:
    """The skills that learn or have one below them that does."""
    found = set(study.learning)
    for skill in study.children_first:
        if any(name in found for name in skill.subskills):
            found.add(skill.name)
    return found
