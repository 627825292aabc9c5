"""A table about an actuator → ActuatorWire, checked against the actuator of the mind."""

from mindrun.graph import Actuator
from mindrun.wiring import ActuatorWire

from mindlang.compiler.diagnostic import Findings
from mindlang.wiring.driver import Wired
from mindlang.wiring.nodes import tell


def actuator_wire(wired: Wired, actuator: Actuator, findings: Findings) -> ActuatorWire | None:
    """The wire of an actuator, or None after reporting why it cannot be wired so."""
    own = {**wired.own}
    low, high = own.pop("limits", (0.0, 1.0))
    neutral = actuator.kind.neutral
    if low >= high:
        hint = "Write the smaller share first, [0.2, 0.8]; reversed: true turns the actuator round."
        tell(findings, "no-travel", wired.span("limits"), "Between these limits nothing can move.", hint)
        return None
    rest = neutral + own.get("trim", 0.0)
    if not low <= rest <= high:
        trimmed = " with its trim" * (rest != neutral)
        message = f"The neutral of {actuator.name}{trimmed}, {rest:g}, is outside of its limits."
        hint = f"It is what the mind says is safe: write limits that have {rest:g} between them."
        tell(findings, "neutral-outside", wired.span("limits"), message, hint)
        return None
    return ActuatorWire(actuator.name, wired.driver, low=float(low), high=float(high), **own)
