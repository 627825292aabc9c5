"""The contract of drivers: frozen dataclasses whose fields are their options in `robot.yaml`, and which open a device.

A driver imports the library of its hardware inside `open`, so that a robot needs only what is wired to it. Devices
speak in natural units (metres, degrees, volts); `Wiring` says which of these are the readings 0 and 1.
"""

from collections.abc import Sequence
from contextlib import suppress
from typing import Protocol

from mindrun.errors import MindError, text_of
from mindrun.kinds.registry import base, names


class DeviceError(MindError):
    """A device that cannot be opened, does not answer, or answers nonsense; `hint` may say what to install or wire."""


def failure(error: BaseException) -> str:
    """Why a device fails, in the words of its driver's error: with the hint, or the type where it is no DeviceError."""
    if not isinstance(error, DeviceError):
        return f"{type(error).__name__}: {text_of(error)}"
    return f"{text_of(error)}; {error.hint}" if error.hint else text_of(error)


def discard(device: "SensorDevice | ActuatorDevice | None") -> None:
    """Close a device that is of no use any more, whatever its driver raises."""
    if device is not None:
        with suppress(BaseException):
            device.close()


def driver_name(driver: object) -> str:
    """The name of a driver in robot.yaml; those of a user say it themselves."""
    return getattr(driver, "name", "") or names()[type(driver)]


class SensorDevice(Protocol):
    """A sensor that is open."""

    def read(self) -> Sequence[float | None]:
        """One value for each reading, in natural units, measured now; None where there is nothing to measure.

        DeviceError where the device fails. May take long: it is called outside of the control loop.
        """
        ...

    def close(self) -> None:
        """Let go of the hardware; never raises."""
        ...


class ActuatorDevice(Protocol):
    """An actuator that is open."""

    def write(self, value: float) -> None:
        """Command a share of the travel in 0..1; returns when it is acknowledged, DeviceError where it is not."""
        ...

    def close(self) -> None:
        """Let go of the hardware; never raises."""
        ...


@base("sensor driver")
class SensorDriver(Protocol):
    """How a sensor is wired: the `unit` of its values, how many there are, and which are `usual`ly readings 0 and 1.

    It may say more: the lowest and highest value that are `possible`; the value of something that is `near` (0 m where
    it measures metres); the same sensor `motionless`; how many `seconds` a measurement takes, for how many of these it
    needs its I2C `bus` (`bus_seconds`), and the `most` that it can measure. Sensors on what does only one thing at a
    time, such as a converter with several inputs, have its name as their `queue`, as others would name it.
    """

    @property
    def unit(self) -> str: ...

    @property
    def readings(self) -> int: ...

    @property
    def usual(self) -> tuple[float, float]: ...

    def open(self) -> SensorDevice:
        """The device; DeviceError where it cannot be opened, with the line that installs what is missing."""
        ...


@base("actuator driver")
class ActuatorDriver(Protocol):
    """How an actuator is wired; `device` names what only one process may drive, as others would name it, or is empty.

    A sensor's driver that moves something has one, too. `seconds` and `bus_seconds` are those of a command; the `queue`
    is the `device` where nothing else is said.
    """

    @property
    def device(self) -> str: ...

    def open(self) -> ActuatorDevice:
        """The device; DeviceError where it cannot be opened, with the line that installs what is missing."""
        ...
