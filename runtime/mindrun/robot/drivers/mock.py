"""Mock devices: sensors that always read the same, actuators that write nowhere."""

from dataclasses import dataclass
from typing import Annotated

from mindrun.kinds.registry import kind
from mindrun.numbers.quantity import COUNT, NUMBER
from mindrun.robot.driver_support import OpenSensor, share


@dataclass(slots=True)
class MockActuatorDevice:
    """Takes every command in 0..1, and remembers the last."""

    value: float | None = None

    def write(self, value: float) -> None:
        self.value = share(value)

    def close(self) -> None:
        """Nothing to let go."""


@kind("sensor driver", "mock")
class MockSensor:
    """A sensor that always reads `value`, `count` times: to try a mind without hardware."""

    value: Annotated[float, NUMBER] = 0.5
    count: Annotated[int, COUNT] = 1

    unit = ""
    usual = (0.0, 1.0)

    @property
    def readings(self) -> int:
        return self.count

    def open(self) -> OpenSensor:
        return OpenSensor(lambda: (self.value,) * self.count, lambda: None)


@kind("actuator driver", "mock")
class MockActuator:
    """An actuator that moves nothing."""

    device = ""

    def open(self) -> MockActuatorDevice:
        return MockActuatorDevice()
