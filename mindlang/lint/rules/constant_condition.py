"""A condition that holds always, or on what a skill sends, never.

Every reading, command and memory is between 0 and 1, so `when eye > 20` and `when eye < 20%` and `and eye > 80%` are
never true, `when eye > -1` always is. The line says the same without its condition, or without what only that lets by;
most often the number lacks a % or stands on the wrong side. A reward that is never paid is for `dead-reward`, an end
that never comes for `dead-event`.
"""

from collections.abc import Iterator
from functools import partial

from mindlang.compiler.model import Skill, Task
from mindlang.lint.conditions import why_always, why_never
from mindlang.lint.study import Finding, Found, Study
from mindlang.lint.worlds import any_world, world

READS = """
sensor eye is range_finder at 0 deg
skill Go is rule
  reads eye
"""
COURSE = "sensor eye is range_finder at 0 deg\ntask Course in arena\n  lasts 9 s\n"
GOOD = (
    f"{READS}  drives left_wheel at 1 when eye > 0.2 and eye < 0.8 otherwise 0.5\n",
    f"{COURSE}  rewards 1 per tick when eye > 0.5\n  ends when eye <= 0\n",
)
BAD = (
    f"{READS}  drives left_wheel at 1 when eye > 20\n",
    f"{READS}  drives left_wheel at 1 when eye < 20% and eye > 80% otherwise 0.5\n",
    f"{READS}  drives left_wheel at 1 when eye > -1\n",
    f"{COURSE}  rewards 1 per tick when eye < 2\n",
    f"{COURSE}  ends when eye < 20 or eye > 80\n",
)
REMEDY = "Compare with something that is sometimes reached, or leave the condition out."


def check(study: Study) -> Found:
    """Conditions of what skills send, of rewards and of ends."""
    for skill in (each for each in study.mind.skills if not each.like):
        yield from _of_edges(study, skill)
    for task in study.mind.tasks:
        yield from _of_task(study, task)


def _of_edges(study: Study, skill: Skill) -> Iterator[Finding]:
    place = any_world(study)
    for edge in skill.edges:
        if edge.gate and edge.fact.gate:
            span = edge.fact.gate.when.span
            if never := why_never(edge.gate.when, place.range_of):
                yield Finding(span, f"This condition never holds: {never}.", REMEDY)
            elif always := why_always(edge.gate.when, place.range_of):
                yield Finding(span, f"This condition always holds: {always}.", REMEDY)


def _of_task(study: Study, task: Task) -> Iterator[Finding]:
    place = world(study, task)
    for reward in task.rewards:
        value = partial(place.value, reward=reward)
        if reward.when and reward.fact.when and (always := why_always(reward.when, value)):
            yield Finding(reward.fact.when.span, f"This condition always holds: {always}.", REMEDY)
    for end in task.ends:
        if end.when and end.fact.when and (always := why_always(end.when, place.range_of)):
            hint = "A run would end with its first tick: compare with something that is sometimes reached."
            yield Finding(end.fact.when.span, f"This condition always holds: {always}.", hint)
