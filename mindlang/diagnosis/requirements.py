"""The packages that the installed mindlang asks for, always and for each extra, held against those that are there."""

from importlib.metadata import PackageNotFoundError, metadata, requires, version

from packaging.requirements import Requirement
from packaging.specifiers import SpecifierSet


def requirements(extra: str = "") -> list[Requirement]:
    """What an extra needs beyond what is always needed, or the latter; PackageNotFoundError where no mindlang is."""
    found = map(Requirement, requires("mindlang") or ())
    return [each for each in found if _is_for(each, extra) and not (extra and _is_for(each, ""))]


def extras() -> list[str]:
    """The extras of the installed mindlang by name."""
    return metadata("mindlang").get_all("Provides-Extra") or []


def python_bounds() -> SpecifierSet:
    """The versions of Python that it is made for."""
    return SpecifierSet(metadata("mindlang")["Requires-Python"] or "")


def installed(package: Requirement) -> str | None:
    """The version that is there, if any."""
    try:
        return version(package.name)
    except PackageNotFoundError:
        return None


def is_met(package: Requirement) -> bool:
    """Whether a version within the bounds is there."""
    found = installed(package)
    return found is not None and package.specifier.contains(found, prereleases=True)


def _is_for(package: Requirement, extra: str) -> bool:
    return package.marker is None or package.marker.evaluate({"extra": extra})
