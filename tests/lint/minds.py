"""Minds of which the tests of rules make others, beside those that explain the rules."""

from mindlang.explaining.collection import codes
from mindlang.lock.training_world import TrainingWorld

EYE = "sensor eye is range_finder at 0 deg\n"
READS = f"{EYE}skill Go is rule\n  reads eye\n"
LEARNS = f"{EYE}skill Go is mlp\n  reads eye\n  drives left_wheel\n"
COURSE = "task Course in arena\n  lasts 9 s\n"
SCHOOL = (
    LEARNS
    + f"{COURSE}  rewards forward per tick\n"
    + ("curriculum School is {}\n  teaches Go on Course for 20 generations{}\n")
)
CROWDED = *codes()["crowded-world"].right, *codes()["crowded-world"].wrong
CHOICES = codes()["deep-hierarchy"].wrong[0]
IDLE = codes()["idle-influence"].wrong[0]
BINS = """
sensor bin_bearing is bearing of bin
task Sort in arena size {}
  contains bin is zone size 5 count 12 away 0 to 100
  contains rock is obstacle count {} size 3
  lasts 9 s
  rewards 10 on reach of bin
"""
HALL = """
task Hall in arena size 40
  contains crate is box size {} at 10 0
  contains coin is item size 2 at 13 0
  lasts 9 s
  counts reach of coin
"""
SENSORS = "sensor north is compass\nsensor off is computed at greatest of north (1 - north)\n"
SKILL = "skill Go is rule\n  reads north\n  drives left_wheel at 1 when"
PAID = """
sensor charge is battery start 60%
sensor in_goal is inside of goal
task Course in arena size 40
  contains goal is zone size 12 at 10 0
  contains coin is item size 1 at -10 2
  lasts 9 s
  starts at -10 0
  rewards 1 on reach of goal
"""
WALLED_HALL = """
task Hall in arena size 40
  contains fence is wall from -20 0 to {} 0
  contains goal is zone size 4{}
  lasts 9 s
  succeeds on reach of goal
"""
BACK = """
master Live
sensor eye is range_finder at 0 deg
skill Back is rule
  drives left_wheel at 0
skill Go is rule
  drives left_wheel at 1
skill Live is rule
  reads eye
  influences Go at eye
"""
NECK = """
sensor eye is range_finder at 0 deg
actuator neck is wheel side left neutral 0.5
master Live
skill Up is rule
  drives neck at 1
skill Down is rule
  drives neck at 0
skill Look is rule
  reads eye
  influences Up at eye
  influences Down at 1 - eye
skill Live is rule
  reads eye
"""
WHEELS = """
tick {}
body Robot is disc size {}
actuator left_wheel is wheel side left neutral 0.5 thrust {}
actuator right_wheel is wheel side right neutral 0.5 thrust {}
task Room in arena size 40
  lasts 9 s
  rewards 1 per tick
"""
TAUGHT = {"task": "Course", "master": "Go", "with_subskills": False, "from_scratch": False}
LEARNER = {
    "is": "genetic", "population": 9, "attempts": 1, "layouts": 2, "elite": 0.1, "mutation": 0.5, "mutated": 0.1,
    "octaves": 0, "patience": 0,
}  # fmt: skip
WORLD = TrainingWorld(
    {
        "tick": 1 / 60,
        "body": {"is": "disc", "size": 2.0, "density": 2.0, "linear_damping": 5.0, "angular_damping": 20.0},
        "sensor eye": {"is": "range_finder", "at": [0.0], "range": 12.0, "dead_zone": 0.005},
        "actuator left_wheel": {"is": "wheel", "side": "left", "neutral": 0.5, "thrust": 80.0, "delay": 0},
        "skill Go": {"sends": []},
        "task": {"scene": {"is": "plain"}, "ticks": 100, "ends": []},
        "rewards": [["forward", "per tick"]],
        "lesson": {**TAUGHT, "learner": LEARNER},
    }
)
