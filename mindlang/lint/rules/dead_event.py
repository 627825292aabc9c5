"""An event that ends a task or is counted in it, and can never happen.

In a plain scene without obstacles there is nothing to collide with, without a claw that closes nothing is delivered,
nor is what moves away as soon as it is reached, and a battery without drain never runs out; a condition may ask for
more than any reading says. The task goes on to the end of its time, and the count stays 0.
"""

from mindlang.compiler.diagnostic import Fix
from mindlang.compiler.source import Span
from mindlang.compiler.syntax import Counts, Ends, Succeeds
from mindlang.editing.insertion import without_fact
from mindlang.lint.conditions import why_never
from mindlang.lint.study import Finding, Found, Study
from mindlang.lint.worlds import world

GOOD = (
    "task Course in arena\n  lasts 9 s\n  ends on collision\n  counts collision\n",
    "task Course in plain\n  contains rock is obstacle count 9\n  lasts 9 s\n  ends on collision\n",
)
BAD = (
    "task Course in plain\n  lasts 9 s\n  ends on collision\n",
    "task Course in plain\n  lasts 9 s\n  counts collision\n",
    "task Course in plain\n  lasts 9 s\n  succeeds on 3 collision\n",
    "task Course in plain\n  lasts 9 s\n  ends when left_wheel > 1\n",
    "task Course in plain\n  lasts 9 s\n  succeeds when left_wheel > 0.9 and left_wheel < 0.8\n",
)


def check(study: Study) -> Found:
    """Events after `ends on`, `succeeds on` and `counts` that the world of their task prevents; conditions, too."""
    for task in study.mind.tasks:
        place = world(study, task)
        counts = (fact for fact in task.facts if isinstance(fact, Counts))
        counted = ((fact, fact.event, event) for fact, event in zip(counts, task.counts, strict=True))
        ending = ((end.fact, end.fact.event, end.event) for end in task.ends)
        for fact, written, event in (*ending, *counted):
            if written and event and (why := event.prevented(place)):
                yield _finding(fact, written.span, f"{why[0]}.", why[1])
        for end in task.ends:
            if end.when and end.fact.when and (why_not := why_never(end.when, place.range_of)):
                hint = "Compare with something that is reached, or take the line out."
                yield _finding(end.fact, end.fact.when.span, f"{why_not}.", hint)


def _finding(fact: Ends | Succeeds | Counts, span: Span, why: str, hint: str) -> Finding:
    fix = Fix("Remove the line", (without_fact(fact),), is_safe=False)
    return Finding(span, f"This never happens: {why}", hint, fix=fix)
