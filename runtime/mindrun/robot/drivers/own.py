"""Drivers that a user brings: a class in a file beside robot.yaml, or in an installed package.

What the compiler has asked of the class stands here as data, so that a bundle is read without running it.
"""

import json
from contextlib import suppress
from dataclasses import dataclass, replace
from typing import Annotated, Any, Protocol

from mindrun.driver import ActuatorDevice, DeviceError, SensorDevice
from mindrun.kinds.registry import kind
from mindrun.numbers.quantity import NUMBER, Quantity, Reference
from mindrun.robot.driver_code import DriverCode, load_class
from mindrun.robot.driver_support import SWITCH, share

TEXT = Reference("text")
READINGS = Quantity("a number of readings", {"": 1.0}, low=1, high=1000, whole=True)
KIND = "of one's own"  # no word of robot.yaml: there stands the name of the class


class OwnDriver(Protocol):
    """What both nouns have in common: the code by its hash, and the options as JSON."""

    @property
    def name(self) -> str: ...

    @property
    def digest(self) -> str: ...

    @property
    def lines(self) -> tuple[str, ...]: ...

    @property
    def package(self) -> str: ...

    @property
    def options(self) -> str: ...


def code_of(driver: OwnDriver) -> DriverCode:
    """The code of a driver."""
    return DriverCode(driver.name, driver.digest, driver.lines, driver.package)


def check_whole(driver: OwnDriver) -> None:
    """Refuse a text that is not the one that its hash names."""
    if not code_of(driver).is_whole:
        raise ValueError("its text is not the one that its hash names")


def made(driver: OwnDriver) -> Any:
    """The user's driver itself; DeviceError where its code does not run."""
    try:
        return load_class(code_of(driver))(**decoded(driver.options))
    except DeviceError:
        raise
    except Exception as error:  # a user's code may raise anything, and the robot has to know
        raise DeviceError(f"the driver {driver.name} does not run: {type(error).__name__}: {error}") from error


def encoded(options: dict[str, Any]) -> str:
    """Options as one line of text."""
    return json.dumps(options, sort_keys=True)


def decoded(options: str) -> dict[str, Any]:
    """Options as they were, lists as tuples."""
    return {key: tuple(value) if isinstance(value, list) else value for key, value in json.loads(options).items()}


@dataclass(frozen=True, slots=True)
class CheckedActuatorDevice:
    """A user's device, which is never told what is no command, and whose end raises nothing."""

    device: ActuatorDevice

    def write(self, value: float) -> None:
        """Command a share of the travel; DeviceError where the user's method is one that does nothing when called."""
        done: object = self.device.write(share(value))  # type: ignore[func-returns-value]
        if hasattr(done, "__await__") or hasattr(done, "__next__"):
            raise DeviceError("its write is async, or yields, and has done nothing yet", "write a plain method")

    def close(self) -> None:
        """Let go."""
        with suppress(Exception):
            self.device.close()


@kind("sensor driver", KIND)
@dataclass(frozen=True, slots=True)
class OwnSensor:
    """A sensor's driver of a user, with what its class says of the options: unit, readings, and what they mean."""

    name: Annotated[str, TEXT]
    digest: Annotated[str, TEXT]
    lines: Annotated[tuple[str, ...], TEXT]
    package: Annotated[str, TEXT]
    options: Annotated[str, TEXT]
    unit: Annotated[str, TEXT]
    readings: Annotated[int, READINGS]
    usual: Annotated[tuple[float, float], NUMBER]
    possible: Annotated[tuple[float, float], NUMBER]
    near: Annotated[float | None, NUMBER]
    device: Annotated[str, TEXT]
    is_still: Annotated[bool, SWITCH] = False

    def __post_init__(self) -> None:
        check_whole(self)

    @property
    def motionless(self) -> "OwnSensor":
        """This driver without anything that it would move, where the user's class knows of that."""
        return replace(self, is_still=True)

    def open(self) -> SensorDevice:
        """The user's device."""
        driver = made(self)
        device: SensorDevice = (getattr(driver, "motionless", driver) if self.is_still else driver).open()
        return device


@kind("actuator driver", KIND)
@dataclass(frozen=True, slots=True)
class OwnActuator:
    """An actuator's driver of a user."""

    name: Annotated[str, TEXT]
    digest: Annotated[str, TEXT]
    lines: Annotated[tuple[str, ...], TEXT]
    package: Annotated[str, TEXT]
    options: Annotated[str, TEXT]
    device: Annotated[str, TEXT]

    def __post_init__(self) -> None:
        check_whole(self)

    def open(self) -> CheckedActuatorDevice:
        """The user's device."""
        return CheckedActuatorDevice(made(self).open())
