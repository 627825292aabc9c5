"""A skill whose weights were taught in a world that is not the mind's any more.

Its body, a sensor, an actuator, the tick, the task with its rewards, the learner or a subskill has changed since it was
taught. Its weights still fit, so it acts, but in what it was never taught: `mindc train` teaches it again. Where it
does well all the same, `mindc status FILE --accept SKILL` says so, and the finding is gone.
"""

from pathlib import Path

from mindrun.terminal.command_line import command_line

from mindlang.lint.examples import LOCK
from mindlang.lint.study import Finding, Found, Study
from mindlang.lock.status import Trained, status

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
