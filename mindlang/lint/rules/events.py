"""What ends a task, is paid or counted."""

from collections.abc import Iterator
from itertools import chain
from math import ceil

from mindlang.compiler.model import End, Reward
from mindlang.compiler.resolve.goals import GOAL_POINTS, PREFERENCE_POINTS
from mindlang.compiler.source import Span
from mindlang.compiler.syntax import Contains, Counts, Goal, Prefers, Wants, expressions_in, of_form
from mindlang.lint.intervals import why_never
from mindlang.lint.study import Finding, Found, Study, removal, rule, saying


@rule()
def dead_event(study: Study) -> Found:
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


@rule()
def dead_reward(study: Study) -> Found:
    for task in study.mind.tasks:
        for reward in task.rewards:
            if why := study.worlds[task.name].why_never_paid(reward):
                span, message, hint = why
                fix = removal(reward.fact, "Remove the reward")
                yield Finding(span, f"This reward is never paid: {message}.", hint, fix=fix)


@rule(once_a_line=True)
def judged_memory(study: Study) -> Found:
    memories = {memory.name for memory in study.mind.memories}
    for task in study.mind.tasks:
        judging: tuple[Reward | End, ...] = (*task.rewards, *task.ends)
        for name, span in chain.from_iterable(map(_judged, judging)):
            if of := sorted(study.roots.get(name, {name}) & memories):
                what = f"{name} is a memory" if name in of else f"{name} is computed from the memory {of[0]}"
                message = f"{what}: what the robot remembers is no deed, and who teaches cannot see it."
                hint = "Judge what the world shows: an event, a measure, a reading of it, or a command that tells it."
                yield Finding(span, message, hint)


def _judged(line: Reward | End) -> Iterator[tuple[str, Span]]:
    """The readings on which a reward or an end depends, and where each is named."""
    if isinstance(line, Reward) and (each := line.fact.each):
        yield each.sensor.text, each.sensor.span
    for expression in expressions_in(line.amount if isinstance(line, Reward) else None, line.when):
        yield from ((term.operand, term.span) for term in expression.found("reading"))


@rule()
def goal_quantum(study: Study) -> Found:
    for task in study.mind.tasks:
        goals = [fact for fact in task.facts if isinstance(fact, Goal)]
        beside = 1 + PREFERENCE_POINTS * bool(of_form(task.facts, Prefers))
        for fact in of_form(task.facts, Wants):
            times = fact.times.number if fact.times else 1
            if (points := GOAL_POINTS / len(goals) / times) <= beside:
                message = f"One more of it is worth {points:.2g} points, and what counts less is worth {beside:g}."
                yield Finding(
                    fact.span, message, f"Want it at most {ceil(GOAL_POINTS / len(goals) / beside) - 1} times."
                )


REACHED = "reached"  # the argument that is left out


@rule(once_a_line=True)
def unsaid_outcome(study: Study) -> Found:
    for task in study.mind.tasks:
        events = [*task.counts, *(reward.on for reward in task.rewards if reward.on)]
        ending = {end.event for end in task.ends if end.times == 1 and not end.opens}
        reached = {event.thing for event in events if event.outcome == REACHED and event not in ending}
        for name, phrase in ((fact.name, fact.phrase) for fact in of_form(task.facts, Contains)):
            if name.text in reached and all(argument.key.text != REACHED for argument in phrase.arguments):
                hint = "Write reached stays, or reached moves to have it appear elsewhere as it once did."
                fix = saying([phrase], "reached moves")
                yield Finding(name.span, f"{name.text} stays where it is when it is reached.", hint, fix=fix)
