"""An event that ends a task or is counted in it, and can never happen.

In a plain scene without obstacles there is nothing to collide with, without a claw that closes nothing is delivered,
nor is what moves away as soon as it is reached, and a battery without drain never runs out. The task goes on to the end
of its time, and the count stays 0.
"""

from mindlang.analysis.study import Finding, Found, Study
from mindlang.analysis.worlds import world
from mindlang.compiler.diagnostic import Fix
from mindlang.compiler.syntax import Counts, Ends
from mindlang.editing.insertion import without_fact

GOOD = (
    "task Course in arena\n  lasts 9 s\n  ends on collision\n  counts collision\n",
    "task Course in plain\n  contains rock is obstacle count 9\n  lasts 9 s\n  ends on collision\n",
)
BAD = (
    "task Course in plain\n  lasts 9 s\n  ends on collision\n",
    "task Course in plain\n  lasts 9 s\n  counts collision\n",
)


def check(study: Study) -> Found:
    """Events after `ends on` and `counts` that the world of their task prevents."""
    for task in study.mind.tasks:
        ends = (fact for fact in task.facts if isinstance(fact, Ends) and fact.event)
        counts = (fact for fact in task.facts if isinstance(fact, Counts))
        facts: list[Ends | Counts] = [*ends, *counts]
        place = world(study, task)
        for fact, event in zip(facts, [*task.ends, *task.counts], strict=True):
            if why := event.prevented(place):
                fix = Fix("Remove the line", (without_fact(fact),), is_safe=False)
                written = fact.event or fact
                yield Finding(written.span, f"This never happens: {why[0]}.", why[1], fix=fix)
