"""A lesson in a world that lacks what its skills sense.

A sensor about a thing that is not there reads the same in every tick, a bearing 0.5: whoever reads it learns nothing of
it, and a skill that goes there goes nowhere. A skill that is taught several times may do without in some lessons, as
long as one of them has the thing. A sensor about things of several names learns of each of them in a world that has it.
"""

from mindlang.compiler.diagnostic import Label, listed
from mindlang.lint.study import Finding, Found, Study

SEEK = """
sensor ball_bearing is bearing of ball
skill Go is mlp
  reads ball_bearing
  drives left_wheel
task Empty in arena
  lasts 9 s
  rewards forward per tick
task Seek in arena
  contains ball is item
  lasts 9 s
  rewards 10 on reach of ball
curriculum School is genetic
"""
EITHER = SEEK.replace("of ball\nskill", "of ball or car\nskill").replace(
    "arena\n  lasts", "arena\n  contains car is item\n  lasts"
)
GOOD = (
    f"{EITHER}  teaches Go on Seek for 10 generations\n  teaches Go on Empty for 10 generations\n",
    f"{SEEK}  teaches Go on Seek for 10 generations\n",
    f"{SEEK}  teaches Go on Empty for 10 generations\n  teaches Go on Seek for 10 generations\n",
)
BAD = (
    f"{SEEK}  teaches Go on Empty for 10 generations\n",
    f"{EITHER}  teaches Go on Seek for 10 generations\n",
)

Readers = dict[str, tuple[str, str]]  # by thing: a skill and the sensor about the thing that it reads


def check(study: Study) -> Found:
    readers = _readers(study) if study.mind.lessons else {}
    things = {task.name: {thing.name for thing in task.things} for task in study.mind.tasks}
    known: dict[str, set[str]] = {}
    for lesson in study.mind.lessons:
        known.setdefault(lesson.skill, set()).update(things[lesson.task])
    for lesson in study.mind.lessons:
        for thing, (skill, sensor) in readers[lesson.master].items():
            if thing not in known[lesson.skill]:
                having = [task for task, there in things.items() if thing in there]
                hint = f"Teach it on {listed(having[:3])}, or let {lesson.task} contain {thing}, too."
                message = f"{skill} reads {sensor}, but {lesson.task} contains no {thing}."
                label = Label(study.tasks[lesson.task].span, "this world")
                yield Finding(lesson.fact.task.span, message, hint, (label,))


def _readers(study: Study) -> dict[str, Readers]:
    """By skill, the things that it and those below it sense, each with a skill and a sensor that do."""
    found: dict[str, Readers] = {}
    for skill in study.children_first:
        own: Readers = {}
        for name in skill.subskills:
            own |= found[name]
        sensed = ((thing, name) for name in skill.reads for thing in sorted(study.senses.get(name, ())))
        own |= {thing: (skill.name, sensor) for thing, sensor in sensed}
        found[skill.name] = own
    return found
