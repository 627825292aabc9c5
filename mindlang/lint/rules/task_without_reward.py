"""A lesson on a task that rewards nothing, or of which no reward is ever paid.

Every attempt is then as good as any other, and what is learnt is chance. A task that is only run or counted in a
benchmark needs no rewards.
"""

from mindlang.compiler.diagnostic import Label
from mindlang.lint.study import Finding, Found, Study

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
BAD = (COURSE, f"{COURSE}  rewards 0 per tick\n  rewards 1 per tick when eye > 1.5\n")


def check(study: Study) -> Found:
    for lesson in study.mind.lessons:
        task = study.tasks[lesson.task]
        if all(study.worlds[task.name].why_never_paid(reward) for reward in task.rewards):
            label = Label(task.span, "declared here")
            rewards = "never pays a reward" if task.rewards else "rewards nothing"
            message = f"{task.name} {rewards}, so {lesson.skill} has nothing to learn for."
            hint = f"Add for example rewards 0.01 * forward per tick to {task.name}."
            yield Finding(lesson.fact.task.span, message, hint, (label,))
