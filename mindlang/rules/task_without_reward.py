"""A lesson on a task that rewards nothing.

Every attempt is then as good as any other, and what is learnt is chance. A task that is only run or counted in a
benchmark needs no rewards.
"""

from mindlang.analysis.study import Finding, Found, Study
from mindlang.compiler.diagnostic import Label

COURSE = """
sensor eye is range_finder at 0 deg
skill Go is mlp
  reads eye
  drives left_wheel
curriculum School is genetic
  teaches Go on Course for 10 generations
task Course in arena
  lasts 9 s
"""
GOOD = (f"{COURSE}  rewards forward per tick\n", "task Show in arena\n  lasts 9 s\n  counts collision\n")
BAD = (COURSE,)


def check(study: Study) -> Found:
    """Lessons whose task has no reward."""
    for lesson in study.mind.lessons:
        task = study.tasks[lesson.task]
        if not task.rewards:
            label = Label(task.declaration.header.name.span, "declared here")
            message = f"{task.name} rewards nothing, so {lesson.skill} has nothing to learn for."
            hint = f"Add for example rewards 0.01 * forward per tick to {task.name}."
            yield Finding(lesson.fact.task.span, message, hint, (label,))
