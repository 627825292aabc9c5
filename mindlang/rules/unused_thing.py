"""A thing of a task that nothing is about.

No sensor tells the robot of it, and no reward, event or count depends on it, so it might as well not be there.
Obstacles are of use by standing in the way, a power by charging the battery, and a zone by taking the task's items.
"""

from mindrun.things import ThingKind

from mindlang.analysis.study import Finding, Found, Study
from mindlang.compiler.diagnostic import Fix
from mindlang.compiler.syntax import Contains
from mindlang.editing.insertion import without_fact

ELSEWHERE = True
GOOD = (
    """
sensor ball_bearing is bearing of ball
task Carry in arena
  contains ball is item
  contains home is zone size 5
  contains rock is obstacle count 5
  lasts 9 s
  counts delivery of ball
""",
)
BAD = ("task Carry in arena\n  contains ball is item\n  lasts 9 s\n",)


def check(study: Study) -> Found:
    """Things that no sensor names, nor anything in their task."""
    sensed, named = {*study.senses.values()}, _named(study)
    charges = any(kind.battery for kind in study.sensors.values())
    for task in study.mind.tasks:
        delivers = any(thing.kind.can_be_delivered for thing in task.things)
        facts = {fact.name.text: fact for fact in task.declaration.facts if isinstance(fact, Contains)}
        for thing in task.things:
            is_known = thing.name in sensed or (task.name, thing.name) in named
            if not is_known and not _is_of_use(thing.kind, charges, delivers):
                fix = Fix(f"Remove {thing.name}", (without_fact(facts[thing.name]),), is_safe=False)
                hint = f"Reward or count something about {thing.name}, let a sensor tell of it, or take it out."
                message = f"No sensor, reward or event is about {thing.name}."
                yield Finding(thing.span, message, hint, fix=fix)


def _named(study: Study) -> set[tuple[str, str]]:
    """The things that the rewards and events of a task are about, each with the task."""
    facts = (fact for task in study.mind.tasks for fact in task.declaration.facts)
    own = {id(fact.name) for fact in facts if isinstance(fact, Contains)}
    about = (mention for mention in study.mentions if mention.noun == "thing" and id(mention.name) not in own)
    return {(mention.by.header.name.text, mention.name.text) for mention in about if mention.by}


def _is_of_use(kind: ThingKind, charges: bool, delivers: bool) -> bool:
    """Whether it does something although nothing is about it."""
    return kind.is_solid or (kind.charges and charges) or (kind.takes_items and delivers)
