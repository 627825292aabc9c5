"""A lesson whose learner has settings under which nothing can evolve.

What comes of such a lesson is the best of its first genomes, which are random, or what the skill knew before: where the
elite is nearly everybody, no weight is ever mutated, or by next to nothing.
"""

from mindrun.graph.skill_sets import genes, learners

from mindlang.lint.examples import LEARNS, REWARDED
from mindlang.lint.study import Finding, Found, Study

SCHOOL = LEARNS + REWARDED + "curriculum School is {}\n  teaches Go on Course for 20 generations{}\n"
GOOD = (
    SCHOOL.format("genetic", ""),
    SCHOOL.format("genetic elite 50% mutated 5%", ""),
    SCHOOL.format("evolution_strategy mutation 0.01", ""),
)
BAD = (
    SCHOOL.format("genetic population 20 elite 100%", ""),
    SCHOOL.format("genetic mutated 0%", ""),
    SCHOOL.format("restarting", " mutation 0.000001"),
    SCHOOL.format("evolution_strategy mutation 0.0001", ""),
    SCHOOL.format("genetic", "").replace("20 generations", "1 generations"),
)
MORE_HINT = "Write more generations: for 100 generations."
HINT = "Leave it out: what the learner does where nothing is said is what has learnt best."


def check(study: Study) -> Found:
    skills = {skill.name: skill for skill in study.graph.skills}
    for written, lesson in zip(study.mind.lessons, study.graph.lessons, strict=True):
        weights = sum(genes(skills[name]) for name in learners(study.graph, lesson))
        if weights and (why := lesson.learner.standstill(weights, lesson.generations)):
            yield Finding(written.fact.span, f"{why}.", HINT if lesson.generations > 1 else MORE_HINT)
