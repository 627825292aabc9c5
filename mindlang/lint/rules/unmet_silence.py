"""A learner never meets that nobody has said an order.

Before anybody has said one, and after a silence of more than `timeout`, an order whose neutral is none of them reads 0
in all of its readings. Where each run of a lesson has an order, what the skill does then is what nobody taught.
"""

from mindrun.graph.skill_sets import learners

from mindlang.lint.study import Finding, Found, Study

TAUGHT = """
sensor wanted is order 1 to 3{}
skill Go is mlp
  reads wanted
  drives left_wheel
  drives right_wheel
task Roam in arena
  lasts 9 s
  rewards forward per tick
curriculum School is genetic
  teaches Go on Roam for 10 generations
"""
GOOD = (
    TAUGHT.format(" lost 10%"),
    TAUGHT.format(" neutral 1"),
    TAUGHT.format("").replace("1 to 3", "0 to 3"),
)
BAD = TAUGHT.format("")


def check(study: Study) -> Found:
    taught = {learner for lesson in study.graph.lessons for learner in learners(study.graph, lesson)}
    reads = {name for learner in taught for name in study.skills[learner].reads}
    read = {root for name in reads for root in study.roots.get(name, ())}
    for part in study.mind.sensors:
        kind = part.kind
        is_none = kind.shape and not any(kind.numbers)  # nothing is lost, and neutral is none of several
        if kind.is_order and part.name in read and is_none:
            said = f"{part.name} is one of several in every task, and on the robot none until somebody says one."
            hint = "Write lost 10%, so that what learns meets that, or one of them as neutral 1."
            yield Finding(part.span, said, hint)
