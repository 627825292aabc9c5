"""What happens to a robot alone: it has to stop, and sensors are faulty. The simulator knows neither."""

from collections.abc import Sequence
from dataclasses import dataclass

from mindlang.compiler.diagnostic import Findings, listed
from mindlang.compiler.resolve.kinds import a_name
from mindlang.compiler.syntax import Phrase

STOPPED, FAULT, OF = "stopped", "fault", "of"
WORDS = (STOPPED, FAULT)


@dataclass(frozen=True, slots=True)
class Stopped:
    """All actuators become neutral, whatever the skills command."""


@dataclass(frozen=True, slots=True)
class Fault:
    """A sensor becomes faulty: the one of that name, or any of those that are wired where it is empty."""

    sensor: str = ""


RobotEvent = Stopped | Fault


def robot_events(sensors: Sequence[str]) -> tuple[RobotEvent, ...]:
    """All events of a robot with these wired sensors, in the order of the columns of `times`."""
    return Stopped(), Fault(), *map(Fault, sensors)


def robot_event(written: Phrase, sensors: Sequence[str] | None, findings: Findings) -> RobotEvent | None:
    """The event of a phrase that begins with one of the WORDS; what is wrong with it is reported."""
    word, said = written.kind.text, written.arguments
    if sensors is None:
        hint = "It is for the recording of one: mindc view day.rec NAME.bundle --break FILE."
        findings.error(
            "impossible-event", written.span, f"{word} is what happens to a robot, not in the simulator.", hint
        )
    elif word == STOPPED and said:
        findings.error("unknown-argument", written.span, f"{word} takes no arguments.", f"Write stop on {word}.")
    elif word == FAULT and said and (len(said) > 1 or said[0].key.text != OF):
        hint = "Write stop on fault of SENSOR."
        findings.error("unknown-argument", written.span, f"{word} takes of and the name of a sensor.", hint)
    elif not said:
        return Stopped() if word == STOPPED else Fault()
    elif (name := a_name(said[0], "Here stands the name of a sensor.", findings)) and name.text in sensors:
        return Fault(name.text)
    elif name:
        hint = findings.suggest(name.text, sensors) or (f"Wired are {listed(sensors, 'and')}." if sensors else "")
        hint = hint or "No sensor of this robot is wired."
        findings.error("unknown-sensor", name.span, f"The robot has no wired sensor called {name.text}.", hint)
    return None
