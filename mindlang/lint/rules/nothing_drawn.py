"""A task in which nothing is drawn: all of its runs are the same run.

The robot starts where it is told and faces as it is told, all things stand at a place, and neither a reading nor a
command has noise. `bench` makes one run of it, and a skill that is taught there learns that one run by heart. That may
be meant: of a track, or of an examination.
"""

from mindrun.graph.tasks import is_one_world

from mindlang.lint.study import Finding, Found, Study

COURSE = """
task Course in arena size 40
  contains goal is zone size 4 at 10 0
  starts at -10 0{}
  lasts 9 s
  succeeds on reach of goal
"""
GOOD = (
    COURSE.format(""),
    COURSE.format(" facing 0 deg").replace(" at 10 0", ""),
    COURSE.format(" facing 0 deg\n  varies thrust of left_wheel 60 to 80"),
    COURSE.format(" facing 0 deg").replace("at 10 0", "at 10 0 or 0 10"),
    COURSE.format(" facing 0 deg").replace("reach of goal\n", "reach of goal\n  contains cat is walker at 5 5\n"),
    COURSE.format(" facing 0 deg") + "actuator left_wheel is wheel side left neutral 0.5 noise 1%\n"
    "actuator right_wheel is wheel side right neutral 0.5\n",
)
BAD = (
    COURSE.format(" facing 0 deg"),
    COURSE.format(" facing 0 deg").replace("arena size 40", "plain"),
    COURSE.format(" facing 0 deg\n  contains cat is walker along 0 5 to 5 5"),
)
HINT = "Let something be drawn: leave facing out, or write at 10 0 or 0 10, or varies thrust of left_wheel 70 to 90."


def check(study: Study) -> Found:
    for written, task in zip(study.mind.tasks, study.graph.tasks, strict=True):
        masters = {lesson.master for lesson in study.mind.lessons if lesson.task == task.name} or {study.mind.master}
        if all(is_one_world(study.graph, task, master) for master in masters):
            yield Finding(written.span, f"Nothing is drawn in {task.name}: all of its runs are one.", HINT)
