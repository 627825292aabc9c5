"""The code of drivers that mindrun does not have: a file's text, or an installed package, each named by its hash.

It runs where a device is opened, and where a bundle is built; to read a bundle runs none of it.
"""

import sys
from collections.abc import Iterator
from dataclasses import dataclass
from hashlib import sha256
from importlib.metadata import Distribution, EntryPoint, PackageNotFoundError, distribution
from importlib.util import find_spec
from pathlib import Path
from threading import Lock
from types import ModuleType
from typing import Any

from mindrun.driver import DeviceError

ENTRY_POINTS = "mindrun.drivers"  # the group under which a package says its drivers
REBUILD = "build the bundle again where that package is, or install that version here"

_loading = Lock()  # sensors are opened in threads of their own


@dataclass(frozen=True, slots=True)
class DriverCode:
    """Where a driver's class comes from: `name` is FILE.CLASS, or PACKAGE.NAME of an entry point.

    `lines` are those of the file, whose SHA-256 is `digest`. Where it has none, `package` is the name and version of an
    installed package, and `digest` that of all of its modules.
    """

    name: str
    digest: str
    lines: tuple[str, ...] = ()
    package: str = ""

    @property
    def origin(self) -> str:
        """What to call the file or the package."""
        return self.package or f"{self.name.split('.')[0]}.py"

    @property
    def text(self) -> str:
        """The file."""
        return "\n".join(self.lines)

    @property
    def is_whole(self) -> bool:
        """Whether the text of a file is the one that the hash names."""
        return bool(self.package) or sha256(self.text.encode()).hexdigest() == self.digest


def of_file(name: str, text: str) -> DriverCode:
    """The code of a class in a file with this text."""
    return DriverCode(name, sha256(text.encode()).hexdigest(), tuple(text.split("\n")))


def of_package(name: str) -> DriverCode | None:
    """The code that an installed package offers under PACKAGE.NAME; None where there is none. Nothing of it is run."""
    found = _offered(name)
    if found is None:
        return None
    package, entry = found
    return DriverCode(name, _package_digest(entry), package=f"{package.name} {package.version}")


def load_class(code: DriverCode) -> Any:
    """Run the code, once in a process, and give what it calls by the driver's name.

    DeviceError where it is not the code that was meant; AttributeError where it has no such name; whatever it raises.
    """
    if code.package:
        return _package_class(code)
    if not code.is_whole:
        raise DeviceError(f"the text of {code.origin} is not the one that its hash names")
    return getattr(module_of(code), code.name.split(".")[1])


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


def _package_class(code: DriverCode) -> Any:
    found = _offered(code.name)
    if found is None:
        raise DeviceError(f"{code.package} is not installed, or has no driver {code.name}", _install(code))
    package, entry = found
    if _package_digest(entry) != code.digest:
        here = f"{package.name} {package.version}"
        raise DeviceError(f"{here} is installed, and its code is not that of {code.package} in the bundle", REBUILD)
    with _loading:
        return entry.load()


def _install(code: DriverCode) -> str:
    return f"pip install '{code.package.replace(' ', '==')}'"


def _offered(name: str) -> tuple[Distribution, EntryPoint] | None:
    package, _, driver = name.partition(".")
    try:
        found = distribution(package)
    except (PackageNotFoundError, ValueError):
        return None
    entries = found.entry_points.select(group=ENTRY_POINTS, name=driver)
    return next(((found, entry) for entry in entries), None)


def _package_digest(entry: EntryPoint) -> str:
    """The SHA-256 of the names and contents of all modules beside the one of an entry point."""
    digest = sha256()
    for name, content in _modules(entry.module.split(".")[0]):
        digest.update(f"{name} {sha256(content).hexdigest()}\n".encode())
    return digest.hexdigest()


def _modules(name: str) -> Iterator[tuple[str, bytes]]:
    """The files of a package, or of a module alone, by their names in it; found without running any."""
    spec = find_spec(name)
    if spec is None:
        return
    for folder in spec.submodule_search_locations or ():
        for path in sorted(Path(folder).rglob("*.py")):
            yield path.relative_to(folder).as_posix(), path.read_bytes()
    if not spec.submodule_search_locations and spec.origin:
        yield Path(spec.origin).name, Path(spec.origin).read_bytes()
