"""An event that ends a task or is counted in it, and can never happen.

In a plain scene without obstacles there is nothing to collide with, without a claw that closes nothing is delivered,
nor is what moves away as soon as it is reached, and a battery without drain never runs out; a condition may ask for
more than any reading says. The task goes on to the end of its time, and the count stays 0.
"""

from mindlang.compiler.syntax import Counts, of_form
from mindlang.lint.intervals import why_never
from mindlang.lint.study import Finding, Found, Study, removal

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
    for task in study.mind.tasks:
        world = study.worlds[task.name]
        counted = zip(of_form(task.facts, Counts), task.counts, strict=True)
        for fact, event in (*((end.fact, end.event) for end in task.ends), *counted):
            if fact.event and event and (why := event.hindrance(world)):
                yield Finding(fact.event.span, f"This never happens: {why[0]}.", why[1], fix=removal(fact))
        for end in task.ends:
            if end.when and (never := why_never(end.when, world.range_in(end))):
                hint = "Compare with something that is reached, or take the line out."
                yield Finding(end.when.span, f"This never happens: {never}.", hint, fix=removal(end.fact))
