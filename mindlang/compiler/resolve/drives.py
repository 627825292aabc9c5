"""Whether the actuators that are to move the body can: each kind of body has its own."""

from collections.abc import Sequence

from mindrun.kinds.actuators.actuator import ActuatorKind
from mindrun.kinds.bodies.body import BodyKind
from mindrun.kinds.registry import kinds, names

from mindlang.compiler.diagnostic import Findings, Label, a, listed
from mindlang.compiler.model import Part


def check_drives(body: Part[BodyKind], actuators: Sequence[Part[ActuatorKind]], findings: Findings) -> None:
    """Report actuators that would do nothing on a body, and a second steering."""
    is_, steering = names()[type(body.kind)], None
    for actuator in actuators:
        drive = actuator.kind.drive
        if drive is not None and drive not in body.kind.drives:
            bodies = [kind for kind, cls in kinds("body").items() if drive in cls.drives]
            hint = (
                f"{a(is_).capitalize()} takes {listed(body.kind.drives)}; {drive} belongs to {listed(map(a, bodies))}."
            )
            label = Label(body.span, "the body")
            findings.error(
                "foreign-drive", actuator.span, f"{a(drive).capitalize()} does nothing on {a(is_)}.", hint, label
            )
        elif drive == "steering" and steering:
            label = Label(steering.span, "the first one")
            hint = "Leave one of the two out, or let one be a servo."
            findings.error("second-steering", actuator.span, "A car has one steering.", hint, label)
        elif drive == "steering":
            steering = actuator
