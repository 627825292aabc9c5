"""A reward that is never paid.

Its condition cannot hold with readings between 0 and 1, its event cannot happen in this world with this robot, or its
amount is always 0. Learning goes on without it and nobody notices.
"""

from mindlang.lint.examples import COURSE, EYE
from mindlang.lint.study import Finding, Found, Study, removal

BEGIN = EYE + COURSE
GOOD = f"{BEGIN}  rewards 1 per tick when eye > 0.5\n  rewards -9 on collision\n"
BAD = (
    f"{BEGIN}  rewards 1 per tick when eye > 1.5\n",
    f"{BEGIN}  rewards 0 * eye per tick\n",
    "task Course in plain\n  lasts 9 s\n  rewards -9 on collision\n",
    """
sensor holding is held of ball
task Carry in arena
  contains ball is item
  contains home is zone size 5
  lasts 9 s
  rewards 9 on delivery of ball
  rewards 1 per tick when holding > 0.5
""",
)


def check(study: Study) -> Found:
    for task in study.mind.tasks:
        for reward in task.rewards:
            if why := study.worlds[task.name].why_never_paid(reward):
                span, message, hint = why
                fix = removal(reward.fact, "Remove the reward")
                yield Finding(span, f"This reward is never paid: {message}.", hint, fix=fix)
