"""A thrust that nobody says, on a body that it does not fit.

Where no line says a thrust, a wheel and a thruster push with 80, a motor with 160: a body of size 2 goes two and a half
times its length a second. At the top speed its mass (density times area) times its linear_damping is the force. So one
that is written in metres, of size 0.2, would go 2500 times its length a second, and one of size 20 would take a minute
for a tenth of it. The thrust that is proposed takes the body twice its length a second, whatever its units are.
"""

from mindrun.kinds.actuators.actuator import THRUST
from mindrun.numbers.quantity import fits

from mindlang.compiler.diagnostic import listed
from mindlang.lint.study import Finding, Found, Study
from mindlang.lint.top_speed import farthest_step
from mindlang.lint.unsaid import phrases_without, saying, short

WHEELS = """
body Robot is disc size {0}
actuator left_wheel is wheel side left neutral 0.5{1}
actuator right_wheel is wheel side right neutral 0.5{1}
task Room in plain
  lasts 9 s
  rewards forward per tick
"""
GOOD = (WHEELS.format(2, ""), WHEELS.format(0.2, " thrust 0.063"))
BAD = (WHEELS.format(0.2, ""), WHEELS.format(20, ""))
LEAST_LENGTHS, PROPOSED_LENGTHS, MOST_LENGTHS = 0.25, 2.0, 10.0  # a second
TOO_LARGE = "No thrust is that large: write lengths in a larger unit, such as 0.2 in metres for 200 in millimetres."


def check(study: Study) -> Found:
    graph, body = study.graph, study.mind.body
    pushing = [part for part in study.mind.actuators if "thrust" in part.kind.varying]
    unsaid = phrases_without(study, "actuator", pushing, "thrust")
    varied = any(each.argument == "thrust" for task in graph.tasks for each in task.varies)
    speed, length = farthest_step(graph)[0] / graph.tick, 2 * graph.body.front
    if not speed or varied or len(unsaid) < len(pushing) or LEAST_LENGTHS <= speed / length <= MOST_LENGTHS:
        return
    default = float(pushing[0].kind.row(graph.body)["thrust"])  # that of all: wheels and thrusters have the same
    thrust = default * PROPOSED_LENGTHS * length / speed
    names = listed([part.name for part in pushing], "and")
    pace = f"{short(speed, 3)} units a second, {short(speed / length)} times its length"
    message = f"At full thrust {body.name} goes {pace}, with a thrust of {default:g} that nobody says."
    if not fits(THRUST, thrust):
        yield Finding(pushing[0].span, message, TOO_LARGE)
        return
    hint = f"Add thrust {short(thrust)} to {names}: {PROPOSED_LENGTHS:g} times its length a second."
    yield Finding(pushing[0].span, message, hint, fix=saying(unsaid, f"thrust {short(thrust)}"))
