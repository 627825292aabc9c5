"""A task that no lesson uses.

Nobody learns there, and it counts nothing: a task that counts is for benchmarks, and a mind without any lesson only
runs in its tasks. Both are fine.
"""

from mindlang.lint.examples import LEARNS, REWARDED, SCHOOL
from mindlang.lint.study import Finding, Found, Study, removal

ELSEWHERE = True
BAD = f"{LEARNS}{SCHOOL}{REWARDED}task Other in arena\n  lasts 99 s\n  rewards forward per tick\n"
GOOD = (f"{BAD}  counts collision\n", REWARDED)


def check(study: Study) -> Found:
    used = {lesson.task for lesson in study.mind.lessons}
    for task in study.mind.tasks if used else ():
        if task.name not in used and not task.counts:
            hint = f"Add teaches SKILL on {task.name} for 1000 generations to a curriculum, or take the task out."
            yield Finding(task.span, f"No lesson is on {task.name}.", hint, fix=removal(task.declaration))
