"""A long lesson of a mind for a robot in which no reading has noise.

`unit 8 cm` says that a mind is for a robot, whose readings are never exact. What is taught for a thousand generations
with exact ones may come to need that: of thirteen objects a skill brought one where its bearings were 5 % off. Noise in
one of the sensors that are read will do here; `mindc bench --worlds` says what noise costs a mind, and `mindrun report`
how much the sensors of a robot have.
"""

from mindrun.graph.skill_sets import learners
from mindrun.kinds.sensors.sensor import Physical

from mindlang.lint.study import Finding, Found, Study

LONG_GENERATIONS = 300  # what was taught for 100 lost little
ROBOT = """
unit 8 cm
sensor eye is range_finder at 0 deg{}
skill Go is mlp
  reads eye
  drives left_wheel
  drives right_wheel
task Roam in arena
  lasts 9 s{}
  rewards forward per tick
curriculum School is genetic
  teaches Go on Roam for 1000 generations
"""
GOOD = (
    ROBOT.format(" noise 2%", ""),
    ROBOT.format("", "\n  varies noise of eye 0 to 5%"),
    ROBOT.format("", "").replace("unit 8 cm", ""),
    ROBOT.format("", "").replace("1000", "100"),
)
BAD = ROBOT.format("", "")


def check(study: Study) -> Found:
    for written, lesson in zip(study.mind.lessons, study.graph.lessons, strict=True):
        if not study.mind.unit_metres or lesson.generations < LONG_GENERATIONS:
            continue
        reads = (name for learner in learners(study.graph, lesson) for name in study.skills[learner].reads)
        read = {root for name in reads for root in study.roots.get(name, ())}
        measured = (part for part in study.mind.sensors if part.name in read)
        noise = {part.name: part.kind.noise for part in measured if isinstance(part.kind, Physical)}
        varies = {(each.of, each.argument) for each in study.tasks[lesson.task].varies}
        if noise and not any(much or (name, "noise") in varies for name, much in noise.items()):
            taught = f"{lesson.skill} is taught for {lesson.generations:,} generations without noise, for a robot."
            hint = f"Write noise 2% in the line of {next(iter(noise))}, or as much as the real sensor has."
            yield Finding(written.fact.span, taught, hint)
