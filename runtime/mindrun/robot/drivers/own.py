"""Drivers that a user brings: a class in a file beside robot.yaml, or in an installed package, each named by its hash.

What the compiler has asked of the class stands here as data, so that a bundle is read without running it: that is done
where a device is opened, and where a bundle is built.
"""

import json
import sys
from contextlib import suppress
from dataclasses import dataclass, replace
from hashlib import sha256
from importlib.metadata import Distribution, EntryPoint, PackageNotFoundError, distribution
from threading import Lock
from types import ModuleType
from typing import Annotated, Any

from mindrun.driver import ActuatorDevice, DeviceError, SensorDevice
from mindrun.kinds.packages import REBUILD, package_digest
from mindrun.kinds.registry import kind
from mindrun.numbers.quantity import NUMBER, Quantity
from mindrun.robot.driver_support import SWITCH, TEXT, share

READINGS = Quantity("a number of readings", {"": 1.0}, low=1, high=1000, whole=True)
KIND = "of one's own"  # no word of robot.yaml: there stands the name of the class
ENTRY_POINTS = "mindrun.drivers"  # the group under which a package says its drivers

_loading = Lock()  # sensors are opened in threads of their own


@dataclass(frozen=True, slots=True)
class DriverCode:
    """Where a driver's class comes from: `name` is FILE.CLASS, or PACKAGE.NAME of an entry point.

    `lines` are those of the file, whose SHA-256 is `digest`. Where it has none, `package` is the name and version of an
    installed package, and `digest` that of all of its modules.
    """

    name: Annotated[str, TEXT]
    digest: Annotated[str, TEXT]
    lines: Annotated[tuple[str, ...], TEXT]
    package: Annotated[str, TEXT]

    def __post_init__(self) -> None:
        if not self.package and sha256(self.text.encode()).hexdigest() != self.digest:
            raise ValueError("its text is not the one that its hash names")

    @property
    def origin(self) -> str:
        """The name of the file or the package, for messages."""
        return self.package or f"{self.name.split('.')[0]}.py"

    @property
    def text(self) -> str:
        return "\n".join(self.lines)


def of_file(name: str, text: str) -> DriverCode:
    """The code of a class in a file with this text."""
    return DriverCode(name, sha256(text.encode()).hexdigest(), tuple(text.split("\n")), "")


def of_package(name: str) -> DriverCode | None:
    """The code that an installed package offers under PACKAGE.NAME; None where there is none. Nothing of it is run."""
    found = _offered(name)
    if found is None:
        return None
    package, entry = found
    return DriverCode(name, package_digest(entry), (), f"{package.name} {package.version}")


def load_class(code: DriverCode) -> Any:
    """Run the code, once in a process, and give what it calls by the driver's name.

    DeviceError where it is not the code that was meant; AttributeError where it has no such name; whatever it raises.
    """
    if not code.package:
        return getattr(module_of(code), code.name.split(".")[1])
    found = _offered(code.name)
    if found is None:
        install = f"pip install '{code.package.replace(' ', '==')}'"
        raise DeviceError(f"{code.package} is not installed, or has no driver {code.name}", install)
    package, entry = found
    if package_digest(entry) != code.digest:
        here = f"{package.name} {package.version}"
        raise DeviceError(f"{here} is installed, and its code is not that of {code.package} in the bundle", REBUILD)
    with _loading:
        return entry.load()


def module_of(code: DriverCode) -> ModuleType:
    """The module of a file, which is run unless it has been."""
    name = f"mindrun_driver_{code.digest}"
    with _loading:
        if name in sys.modules:
            return sys.modules[name]
        module = ModuleType(name)
        sys.modules[name] = module  # dataclasses look their module up while it is run
        try:
            exec(compile(code.text, code.origin, "exec"), module.__dict__)
        except BaseException:
            del sys.modules[name]
            raise
        return module


def _offered(name: str) -> tuple[Distribution, EntryPoint] | None:
    package, _, driver = name.partition(".")
    try:
        found = distribution(package)
    except (PackageNotFoundError, ValueError):
        return None
    entries = found.entry_points.select(group=ENTRY_POINTS, name=driver)
    return next(((found, entry) for entry in entries), None)


def encoded(options: dict[str, Any]) -> str:
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
        with suppress(Exception):
            self.device.close()


@dataclass(frozen=True, slots=True)
class OwnDriver(DriverCode):
    """A driver of a user: its code by the hash, and its options as JSON."""

    options: Annotated[str, TEXT]

    def made(self) -> Any:
        """The user's driver itself; DeviceError where its code does not run."""
        try:
            return load_class(self)(**decoded(self.options))
        except DeviceError:
            raise
        except Exception as error:  # a user's code may raise anything, and the robot has to know
            raise DeviceError(f"the driver {self.name} does not run: {type(error).__name__}: {error}") from error


@kind("sensor driver", KIND)
class OwnSensor(OwnDriver):
    """A sensor's driver of a user, with what its class says of the options: unit, readings, and what they mean."""

    unit: Annotated[str, TEXT]
    readings: Annotated[int, READINGS]
    usual: Annotated[tuple[float, float], NUMBER]
    possible: Annotated[tuple[float, float], NUMBER]
    near: Annotated[float | None, NUMBER]
    device: Annotated[str, TEXT]
    is_still: Annotated[bool, SWITCH] = False

    @property
    def motionless(self) -> "OwnSensor":
        """This driver without anything that it would move, where the user's class knows of that."""
        return replace(self, is_still=True)

    def open(self) -> SensorDevice:
        driver = self.made()
        device: SensorDevice = (getattr(driver, "motionless", driver) if self.is_still else driver).open()
        return device


@kind("actuator driver", KIND)
class OwnActuator(OwnDriver):
    """An actuator's driver of a user."""

    device: Annotated[str, TEXT]

    def open(self) -> CheckedActuatorDevice:
        return CheckedActuatorDevice(self.made().open())
