"""A reward that is never paid.

Its condition cannot hold with readings between 0 and 1, its event cannot happen in this world with this robot, or its
amount is always 0. Learning goes on without it and nobody notices.
"""

from mindlang.compiler.diagnostic import Fix
from mindlang.compiler.model import Reward
from mindlang.compiler.source import Span
from mindlang.editing.insertion import without_fact
from mindlang.lint.conditions import why_never
from mindlang.lint.study import Finding, Found, Study
from mindlang.lint.worlds import AnalysedWorld, world

BEGIN = """
sensor eye is range_finder at 0 deg
task Course in arena
  lasts 9 s
"""
GOOD = (f"{BEGIN}  rewards 1 per tick when eye > 0.5\n  rewards -9 on collision\n",)
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
    """Rewards whose event never happens, whose condition never holds or whose amount is 0."""
    for task in study.mind.tasks:
        place = world(study, task)
        for reward in task.rewards:
            if why := why_never_paid(place, reward):
                span, message, hint = why
                fix = Fix("Remove the reward", (without_fact(reward.fact),), is_safe=False)
                yield Finding(span, f"This reward is never paid: {message}.", hint, fix=fix)


def why_never_paid(place: AnalysedWorld, reward: Reward) -> tuple[Span, str, str] | None:
    """Where and why a reward is never paid, and what to do; None of one that may be."""
    fact = reward.fact
    if reward.on and fact.on and (why := reward.on.prevented(place)):
        return fact.on.span, *why
    if reward.when and fact.when and (never := why_never(reward.when, lambda side: place.value(side, reward))):
        hint = "Compare with something that is reached, or take the reward out."
        return fact.when.span, never, hint
    if place.value(reward.amount, reward) == (0, 0):
        return fact.amount.span, "its amount is always 0", "Give it another amount, or take it out."
    return None
