"""A range that nobody says, of which the world uses hardly anything.

Where no line says a range, a distance is measured up to 40 units, a place up to 50, a speed up to 10 a second. In an
arena that is written in metres, of size 4, a position then reads 0.46 to 0.54, and what a skill learns from it drowns
in noise. The range that is proposed is the farthest that there is in any task, or the robot's top speed.
"""

from math import hypot

from mindlang.lint.study import Finding, Found, Study
from mindlang.lint.top_speed import farthest_step
from mindlang.lint.unsaid import phrases_without, saying, short

ROOM = """
body Robot is disc size 0.2
actuator left_wheel is wheel side left neutral 0.5 thrust 0.063
actuator right_wheel is wheel side right neutral 0.5 thrust 0.063
sensor {}
task Room in arena size 4
  contains dock is zone size 0.5
  lasts 9 s
  rewards forward per tick
"""
GOOD = tuple(
    map(
        ROOM.format,
        ("east is position along x range 2", "pace is speed range 0.5", "eye is eye of dock at 0 deg range 6"),
    )
)
BAD = tuple(map(ROOM.format, ("east is position along x", "pace is speed", "far is distance of dock")))
LEAST_SHARE = 0.2  # of a range that a world uses


def check(study: Study) -> Found:
    graph = study.graph
    speed = farthest_step(graph)[0] / graph.tick
    rooms = [task.scene.sides for task in graph.tasks]
    for sensor in study.mind.sensors:
        (low, high), unsaid = sensor.kind.ends, phrases_without(study, "sensor", [sensor], "range")
        if not high or not unsaid or not speed:
            continue
        far = max(max(sides) / 2 if low else hypot(*sides) for sides in rooms)
        most, unit = (speed, " a second") if sensor.kind.unit == "m/s" else (far, "")
        if most < LEAST_SHARE * high:
            message = f"{sensor.name} measures up to {high:g} units{unit}, and here are no more than {short(most)}."
            hint = f"Add range {short(most)}: it reads its whole 0 to 1 then."
            yield Finding(sensor.span, message, hint, fix=saying(unsaid, f"range {short(most)}"))
