"""A thing of a task that nothing is about.

No sensor tells the robot of it, and no reward, event or count depends on it, so it might as well not be there.
Obstacles are of use by standing in the way, a power by charging the battery, and a zone by taking the task's items.
"""

from mindlang.compiler.source import Source, Span
from mindlang.compiler.syntax import Contains, of_form
from mindlang.lint.study import Finding, Found, Study, removal

ELSEWHERE = True
CARRY = """
sensor ball_bearing is bearing of ball
task Carry in arena
  contains ball is item
  contains home is zone size 5
  contains rock is obstacle count 5
  lasts 9 s
  counts delivery of ball
"""
NAMES = """
sensor seen is eye of person or car at -20 20 deg
task Cross in arena
  contains person is item
  contains car is item
  lasts 9 s
"""
GOOD = (CARRY, NAMES)
BAD = "task Carry in arena\n  contains ball is item\n  lasts 9 s\n"


def check(study: Study) -> Found:
    sensed, named = frozenset[str]().union(*study.senses.values()), _named(study)
    charges = any(kind.battery for kind in study.sensors.values())
    used: set[Span] = set()
    idle: dict[Span, Contains] = {}
    for task in study.mind.tasks:
        delivers = any(thing.kind.can_be_delivered for thing in task.things)
        about = {name for fact in task.facts for name in named.get(_place(fact.span), ())} | sensed
        facts = {fact.name.text: fact for fact in of_form(task.facts, Contains)}
        for thing in task.things:
            kind = thing.kind
            is_of_use = kind.is_solid or (kind.charges and charges) or (kind.takes_items and delivers)
            if thing.name in about or is_of_use:
                used.add(thing.span)
            else:
                idle[thing.span] = facts[thing.name]
    for span, fact in idle.items():
        if span not in used:  # by another task that has it from the same line
            name = fact.name.text
            hint = f"Reward or count something about {name}, let a sensor tell of it, or take it out."
            fix = removal(fact, f"Remove {name}")
            yield Finding(span, f"No sensor, reward or event is about {name}.", hint, fix=fix)


def _named(study: Study) -> dict[tuple[Source, int], list[str]]:
    """The things that a line of a task is about, by the place of the line; not the one that it contains."""
    own = {fact.name.span for task in study.mind.tasks for fact in of_form(task.facts, Contains)}
    found: dict[tuple[Source, int], list[str]] = {}
    for mention in study.mentions:
        if mention.noun == "thing" and mention.name.span not in own:
            found.setdefault(_place(mention.name.span), []).append(mention.name.text)
    return found


def _place(span: Span) -> tuple[Source, int]:
    return span.source, span.line
