"""A lesson on a task that rewards nothing, or of which no reward is ever paid.

Every attempt is then as good as any other, and what is learnt is chance. A task that is only run or counted in a
benchmark needs no rewards.
"""

from mindlang.compiler.diagnostic import Label
from mindlang.lint.examples import COURSE, LEARNS, SCHOOL
from mindlang.lint.study import Finding, Found, Study

BEGIN = LEARNS + SCHOOL + COURSE
GOOD = (f"{BEGIN}  rewards forward per tick\n", "task Show in arena\n  lasts 9 s\n  counts collision\n")
BAD = (BEGIN, f"{BEGIN}  rewards 0 per tick\n  rewards 1 per tick when eye > 1.5\n")


def check(study: Study) -> Found:
    for lesson in study.mind.lessons:
        task = study.tasks[lesson.task]
        if all(study.worlds[task.name].why_never_paid(reward) for reward in task.rewards):
            label = Label(task.span, "declared here")
            rewards = "never pays a reward" if task.rewards else "rewards nothing"
            message = f"{task.name} {rewards}, so {lesson.skill} has nothing to learn for."
            hint = f"Add for example rewards 0.01 * forward per tick to {task.name}."
            yield Finding(lesson.fact.task.span, message, hint, (label,))
