"""The guardian's plan, as one line of JSON: the tick, and each actuator with its neutral and its driver.

Not the bundle itself: to read that takes numpy, and the guardian has no use for a mind's weights and procedures.
"""

import json
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from mindrun.driver import ActuatorDriver
from mindrun.errors import MindError, system_errors_as
from mindrun.files.regular_files import read_regular
from mindrun.files.strict_json import parsed
from mindrun.graph.codec import decode, encode
from mindrun.kinds.registry import left_out
from mindrun.numbers.quantity import RATIO, SECONDS, Quantity
from mindrun.robot.guardian.messages import MAX_COMMANDS

if TYPE_CHECKING:
    from mindrun.graph.wiring import Wiring  # which brings all kinds along

MAX_PLAN_BYTES = 1 << 20
RATIO_EITHER_WAY = Quantity("a share of the travel", {}, low=-1.0, high=1.0)
NOT_NEGATIVE = Quantity("a number", {}, low=0.0)


@dataclass(frozen=True, slots=True)
class Channel:
    """An actuator: the command of its mind at which nothing happens, its driver, and what its wire says."""

    actuator: str
    neutral: Annotated[float, RATIO]
    driver: ActuatorDriver
    trim: Annotated[float, RATIO_EITHER_WAY] = 0.0
    low: Annotated[float, RATIO] = 0.0
    high: Annotated[float, RATIO] = 1.0
    slew: Annotated[float, NOT_NEGATIVE] = 0.0
    reversed: bool = False
    least: Annotated[float, RATIO] = left_out(0.0)

    @property
    def rest(self) -> float:
        """Neutral with the trim, which corrects where a wheel stands still; limits and slew do not hold it."""
        return min(max(self.neutral + self.trim, 0.0), 1.0)


@dataclass(frozen=True, slots=True)
class Plan:
    """All actuators in the order of the commands, and how long a tick is.

    MindError where there are too few or too many actuators, or limits that no command meets.
    """

    tick: Annotated[float, SECONDS]
    channels: tuple[Channel, ...]

    def __post_init__(self) -> None:
        if not 1 <= len(self.channels) <= MAX_COMMANDS:
            raise MindError(f"a robot has 1 to {MAX_COMMANDS} actuators, not {len(self.channels)}")
        for channel in self.channels:
            if channel.low > channel.high:
                raise MindError(f"{channel.actuator}: `low` {channel.low:g} is above `high` {channel.high:g}")


def plan_of(tick: float, neutrals: Mapping[str, float], wiring: "Wiring") -> Plan:
    """The plan of a robot whose mind declares these neutral commands by the names of its actuators."""
    channels = (
        Channel(w.actuator, neutrals[w.actuator], w.driver, w.trim, w.low, w.high, w.slew, w.reversed, w.least)
        for w in wiring.actuators
    )
    return Plan(tick, tuple(channels))


def to_json(plan: Plan) -> str:
    return json.dumps(encode(plan), ensure_ascii=True, allow_nan=False)


def from_json(text: str | bytes) -> Plan:
    """The plan in this text; MindError unless it is one."""
    try:
        plan: Plan = decode(Plan, parsed(text, MAX_PLAN_BYTES), "plan")
    except ValueError as error:
        raise MindError(f"this is no plan of a robot: {error}") from error
    return plan


def read_plan(path: Path) -> Plan:
    """The plan in a file, which may be a bundle with a wiring; MindError where there is none."""
    with system_errors_as(MindError, f"cannot read {path}"):
        data = read_regular(path, MAX_PLAN_BYTES)
    if not data.startswith(b"PK"):
        return from_json(data)
    from mindrun.graph.bundle import read_bundle  # which needs numpy

    bundle = read_bundle(path)
    if bundle.wiring is None:
        raise MindError(f"{path} is for no robot", "build it with its wiring")
    return plan_of(bundle.graph.tick, {each.name: each.kind.neutral for each in bundle.graph.actuators}, bundle.wiring)
