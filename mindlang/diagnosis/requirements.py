"""What this installation of mindlang asks for, by itself and for each extra, and which versions are there."""

import re
from collections.abc import Iterator
from dataclasses import dataclass
from importlib.metadata import PackageNotFoundError, requires, version

_LINE = re.compile(r"(?P<name>[\w.-]+)\s*(?P<bounds>[^;]*?)\s*(?:;.*extra == ['\"](?P<extra>[\w-]+)['\"].*)?$")
_BOUND = re.compile(r"(>=|<)\s*([\d.]+)")


@dataclass(frozen=True, slots=True)
class Requirement:
    """A package with the bounds of its version, and the extra that needs it; "" for what is always needed."""

    name: str
    bounds: str
    extra: str

    @property
    def installed(self) -> str | None:
        """The version that is there, if any."""
        try:
            return version(self.name)
        except PackageNotFoundError:
            return None

    @property
    def is_met(self) -> bool:
        """Whether a version within the bounds is there."""
        found = self.installed
        return found is not None and self.admits(found)

    def admits(self, found: str) -> bool:
        """Whether a version is within the bounds."""
        return all(
            _numbers(found) >= _numbers(bound) if sign == ">=" else _numbers(found) < _numbers(bound)
            for sign, bound in _BOUND.findall(self.bounds)
        )

    @property
    def remedy(self) -> str:
        """The line that installs it."""
        return f"pip install '{self.name}{self.bounds}'"


def requirements() -> list[Requirement]:
    """Those of the installed mindlang, in the order in which it says them; PackageNotFoundError where none is."""
    return list(map(parsed, requires("mindlang") or ()))


def parsed(line: str) -> Requirement:
    """A line of metadata: 'smbus2>=0.4; extra == "robot"'."""
    found = _LINE.match(line)
    assert found
    return Requirement(found["name"], found["bounds"].strip("() "), found["extra"] or "")


def extras() -> Iterator[tuple[str, list[Requirement]]]:
    """Each extra with what it needs."""
    needed = requirements()
    for extra in dict.fromkeys(each.extra for each in needed if each.extra):
        yield extra, [each for each in needed if each.extra == extra]


def _numbers(text: str) -> tuple[int, ...]:
    return tuple(int(digits) for digits in re.findall(r"\d+", text)[:3])
