"""What a task pays and judges: motion without what is counted, what a robot remembers, goals that want too much."""

from collections.abc import Iterator
from itertools import chain
from math import ceil

from mindlang.compiler.model import End, Reward
from mindlang.compiler.resolve.goals import GOAL_POINTS, PREFERENCE_POINTS
from mindlang.compiler.source import Span
from mindlang.compiler.syntax import Goal, Prefers, Wants, expressions_in, of_form
from mindlang.lint.study import Finding, Found, Study, rule

HINT = "Pay for what is counted, too; mindc audit says what each line really pays."


@rule(once_a_line=True)
def paid_motion(study: Study) -> Found:
    for task in study.mind.tasks:
        paid = [reward.on for reward in task.rewards if reward.on]
        if not task.counts or of_form(task.facts, Wants) or any(on in task.counts or on.is_of_success for on in paid):
            continue
        value = study.worlds[task.name].range_in
        for reward in task.rewards:
            if _is_motion(reward) and value(reward)(reward.amount)[1] > 0:
                message = "This pays for motion alone, and nothing pays for what the task counts."
                yield Finding(reward.fact.span, message, HINT)


def _is_motion(reward: Reward) -> bool:
    """True if a line pays per tick, on no condition, for how the robot moves and not for where."""
    measures = [term.operand for term in reward.amount.found("measure")]
    about_nothing = all(not each.things and not each.over and not each.is_outside for each in measures)
    return reward.on is None and reward.when is None and bool(measures) and about_nothing


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
