"""A thing that is reached for a reward or a count without a word on what follows.

It stays where it is, and is reached again only after the robot has left it. Files of before things said so meant
`reached moves`: there a thing appeared elsewhere as soon as a line of its task named its reach. `mindc migrate` brings
such a file along.
"""

from mindlang.compiler.diagnostic import Fix
from mindlang.compiler.splice import Splice
from mindlang.compiler.syntax import Contains, of_form
from mindlang.lint.study import Finding, Found, Study, once_a_line

REACHED = "reached"  # the argument that is left out
DOCK = """
sensor dock_bearing is bearing of dock
task Dock in plain
  contains dock is zone size 5{}
  lasts 9 s
{}  rewards 10 on reach of dock
"""
GOOD = (DOCK.format(" reached stays", ""), DOCK.format("", "  ends on reach of dock\n"))
BAD = DOCK.format("", "")


@once_a_line
def check(study: Study) -> Found:
    for task in study.mind.tasks:
        events = [*task.counts, *(reward.on for reward in task.rewards if reward.on)]
        ending = {end.event for end in task.ends if end.times == 1 and not end.opens}
        reached = {event.thing for event in events if event.outcome == REACHED and event not in ending}
        for name, phrase in ((fact.name, fact.phrase) for fact in of_form(task.facts, Contains)):
            if name.text in reached and all(argument.key.text != REACHED for argument in phrase.arguments):
                end = phrase.span.end
                fix = Fix("Say reached moves", (Splice(phrase.span.source, end, end, " reached moves"),), is_safe=False)
                hint = "Write reached stays, or reached moves to have it appear elsewhere as it once did."
                yield Finding(name.span, f"{name.text} stays where it is when it is reached.", hint, fix=fix)
