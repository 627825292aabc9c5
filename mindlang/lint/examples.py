"""What the examples of several rules have in common."""

from mindlang.lock.training_world import TrainingWorld

EYE = "sensor eye is range_finder at 0 deg\n"
READS = f"{EYE}skill Go is rule\n  reads eye\n"
LEARNS = f"{EYE}skill Go is mlp\n  reads eye\n  drives left_wheel\n"
TURN = "skill Turn is mlp\n  reads eye\n  drives left_wheel\n"  # beside Go
COURSE = "task Course in arena\n  lasts 9 s\n"
REWARDED = f"{COURSE}  rewards forward per tick\n"
LESSON = "  teaches Go on Course for 10 generations\n"
SCHOOL = f"curriculum School is genetic\n{LESSON}"
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
LINE = (
    f"Go is mlp hidden 2 width 3 | reads eye | sends left_wheel | weights {'0' * 64}"
    " | task Course master Go generations 9 population 9 seed 1 score 1.0"
)
LOCK = f"-- mind.lock --\n# mind lock 5: what has been taught.\n{LINE} | taught in {WORLD.name}\n\n{WORLD.text()}\n"
