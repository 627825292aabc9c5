"""A skill whose weights were taught in a world that is not the mind's any more.

Its body, a sensor, an actuator, the tick, the task with its rewards, the learner or a subskill has changed since it was
taught. Its weights still fit, so it acts, but in what it was never taught: `mindc train` teaches it again. Where it
does well all the same, `mindc status FILE --accept SKILL` says so, and the finding is gone.
"""

from pathlib import Path

from mindrun.terminal.command_line import command_line

from mindlang.lint.study import Finding, Found, Study
from mindlang.lock.status import Trained, status
from mindlang.lock.training_world import TrainingWorld

LESSON = {"task": "Course", "master": "Go", "with_subskills": False, "from_scratch": False}
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
        "lesson": {**LESSON, "learner": LEARNER},
    }
)
LINE = (
    f"Go is mlp hidden 2 width 3 | reads eye | sends left_wheel | weights {'0' * 64}"
    " | task Course master Go generations 9 population 9 seed 1 score 1.0"
)
LOCK = f"-- mind.lock --\n# mind lock 2: what has been taught.\n{LINE} | taught in {WORLD.name}\n\n{WORLD.text()}\n"
LEARNS = """
skill Go is mlp
  reads eye
  drives left_wheel
task Course in plain
  lasts 100 ticks
  rewards forward per tick
curriculum School is genetic population 9
  teaches Go on Course for 9 generations
"""
GOOD = f"sensor eye is range_finder at 0 deg range 12\n{LEARNS}{LOCK}"
BAD = f"sensor eye is range_finder at 0 deg range 3\n{LEARNS}{LOCK}"


def check(study: Study) -> Found:
    for name, state in status(study.graph, study.lock, study.main.folder).items():
        if isinstance(state, Trained) and state.is_elsewhere and not study.skills[name].like:
            message = f"{name} was taught elsewhere: {'; '.join(state.changes)}."
            accept = command_line("mindc", "status", Path(study.main.path.name), "--accept", name)
            hint = f"mindc train teaches it again; {accept} leaves it as it is."
            if not state.outdated:
                hint = f"No lesson teaches {name} in this world: write one, or take back what has changed."
            yield Finding(study.skills[name].span, message, hint)
