"""A task that no lesson uses.

Nobody learns there, and it counts nothing: a task that counts is for benchmarks, and a mind without any lesson only
runs in its tasks. Both are fine.
"""

from mindlang.lint.study import Finding, Found, Study, removal

ELSEWHERE = True
COURSE = """
sensor eye is range_finder at 0 deg
skill Go is mlp
  reads eye
  drives left_wheel
curriculum School is genetic
  teaches Go on Course for 10 generations
task Course in arena
  lasts 9 s
  rewards forward per tick
task Other in arena
  lasts 99 s
  rewards forward per tick
"""
GOOD = (f"{COURSE}  counts collision\n", "task Course in arena\n  lasts 9 s\n  rewards forward per tick\n")
BAD = COURSE


def check(study: Study) -> Found:
    used = {lesson.task for lesson in study.mind.lessons}
    for task in study.mind.tasks if used else ():
        if task.name not in used and not task.counts:
            hint = f"Add teaches SKILL on {task.name} for 1000 generations to a curriculum, or take the task out."
            yield Finding(task.span, f"No lesson is on {task.name}.", hint, fix=removal(task.declaration))
