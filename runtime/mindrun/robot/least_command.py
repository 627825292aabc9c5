"""The least share of a command that moves a motor: raised slowly, one way and then the other, until it is seen to move.

All other actuators are at neutral meanwhile, and so is this one in between; the guardian alone moves anything.
"""

import os
import sys
from collections import deque
from collections.abc import Callable
from contextlib import ExitStack
from dataclasses import dataclass, field, replace
from math import ceil
from select import select

from mindrun.errors import MindError
from mindrun.graph.graph import Graph
from mindrun.graph.wiring import SensorWire, Wiring, still
from mindrun.robot.guardian.client import Guardian
from mindrun.robot.guardian.plan import plan_of
from mindrun.robot.loop import Rate
from mindrun.robot.ownership import hold_devices
from mindrun.robot.processes import stopping
from mindrun.robot.sensing import Sample, Sampler

STEP_SHARE, STEP_SECONDS = 0.01, 0.5  # by how much the command is raised, and how long it stays there
MOST_SHARE = 0.5  # of the way to full speed
REST_SECONDS = 3.0  # at neutral, before each way
REST_SAMPLES = 10  # last ones at neutral, beyond whose range twice over a motor moves
MOVING_SAMPLES = 2  # in a row
GRACE_SECONDS = 2.0  # after a signal
MAX_KEYS = 1024


@dataclass(slots=True)
class Witness:
    """Who sees that a motor moves: a person who presses Enter, or a sensor; whoever is first."""

    pressed: Callable[[], bool] | None
    latest: Callable[[], Sample | None] | None = None
    at_rest: deque[float] = field(default_factory=lambda: deque(maxlen=REST_SAMPLES))
    moving: int = 0
    last: Sample | None = None

    def rest(self) -> None:
        """See what it is like at rest: a tick of it."""
        if self.pressed:
            self.pressed()  # too early
        self.moving = 0
        if (value := self._value()) is not None:
            self.at_rest.append(value)

    def moves(self) -> bool:
        """True where it has been seen to move."""
        if (value := self._value()) is not None:
            low, high = min(self.at_rest, default=value), max(self.at_rest, default=value)
            is_still = 2 * low - high <= value <= 2 * high - low
            self.moving = 0 if is_still else self.moving + 1
        return self.moving >= MOVING_SAMPLES or bool(self.pressed and self.pressed())

    def _value(self) -> float | None:
        """What the sensor says, where it has said something new; MindError where it does not work."""
        sample = self.latest() if self.latest else None
        if sample is None or sample is self.last:
            return None
        self.last = sample
        if sample.fault or sample.values[0] is None:
            raise MindError(f"the sensor that would see it move {sample.fault or 'has nothing to measure'}")
        return sample.values[0]


def least_shares(
    neutral: float, tick: float, send: Callable[[float], None], witness: Witness, tell: Callable[[str], None]
) -> dict[str, float]:
    """The least share of a command, "forward" and "backward", that moves a motor, as far as it has these ways.

    `send` sends a command and lasts a tick. MindError where it does not move.
    """
    found = {}

    def moves(command: float) -> bool:
        send(command)
        return witness.moves()

    for way, end in (("forward", 1.0), ("backward", 0.0)):
        if end == neutral:
            continue
        for _ in range(ceil(REST_SECONDS / tick)):
            send(neutral)
            witness.rest()
        for step in range(1, round(MOST_SHARE / STEP_SHARE) + 1):
            tell(f"{way} {step * STEP_SHARE:.0%}")
            command = neutral + step * STEP_SHARE * (end - neutral)
            if any(moves(command) for _ in range(ceil(STEP_SECONDS / tick))):
                found[way] = step * STEP_SHARE
                break
        else:
            hint = "is its supply on, is it wired as robot.yaml says, and do its limits let it?"
            raise MindError(f"nothing has moved {way} up to {MOST_SHARE:.0%} of a command", hint)
    send(neutral)
    return found


def measured_least(
    graph: Graph, wiring: Wiring, name: str, eye: SensorWire | None, tell: Callable[[str], None]
) -> dict[str, float]:
    """The `least_shares` of an actuator of the robot; `eye` is a sensor that sees it, beside who presses Enter."""
    neutrals = {actuator.name: actuator.kind.neutral for actuator in graph.actuators}
    commands, neutral, pace = {**neutrals}, neutrals[name], Rate(graph.tick)
    wires = (replace(wire, least=0.0) if wire.actuator == name else wire for wire in wiring.actuators)
    plan = plan_of(graph.tick, neutrals, replace(wiring, actuators=tuple(wires)))
    with ExitStack() as stack:
        stop = stack.enter_context(stopping(GRACE_SECONDS))
        held = stack.enter_context(hold_devices(wiring))
        guardian = stack.enter_context(Guardian(plan, inherited=held))
        stack.callback(stop.in_order)

        def send(command: float) -> None:
            if stop:
                raise KeyboardInterrupt
            if command != neutral and guardian.holds:
                raise MindError(f"the guardian holds every actuator at neutral: {guardian.holds}")
            commands[name] = command
            pace.wait()
            guardian.send(commands.values(), True)

        witness = Witness(_enter_pressed if eye is None or sys.stdin.isatty() else None)
        if eye:
            sampler = Sampler(still(eye))
            sampler.start()
            stack.callback(sampler.stop)
            witness.latest = lambda: sampler.latest
        pace.begin()
        return least_shares(neutral, graph.tick, send, witness, tell)


def _enter_pressed() -> bool:
    """True if a line has been typed since this was asked last; MindError where nobody can type one any more."""
    if not select([0], [], [], 0)[0]:
        return False
    if not os.read(0, MAX_KEYS):
        raise MindError("nobody can say when it moves: the standard input has ended", "run it in a terminal")
    return True
