"""The build that results depend on: the sources of mindrun, and the versions of what they compute with."""

import platform
from collections.abc import Mapping
from functools import cache
from hashlib import sha256
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

PACKAGES = ("numpy", "numba", "pymunk")
SOURCES = Path(__file__).parents[1]
SHOWN_CHARACTERS = 12  # of a hash

Build = Mapping[str, str]


@cache
def own_build() -> Build:
    """That of this process."""
    major, minor, _ = platform.python_version_tuple()
    found = {"mindrun": sources_hash(SOURCES), "python": f"{major}.{minor}"}
    for package in PACKAGES:
        try:
            found[package] = version(package)
        except PackageNotFoundError:
            found[package] = "none"
    return found


def difference(asked: Build, own: Build) -> str:
    """How the build that a job is for differs from one's own, in words; nothing where it does not."""
    for name in sorted(own.keys() | asked.keys()):
        here, there = own.get(name), asked.get(name)
        if there != here:
            return f"{name} is {_shown(here)} at the worker, and {_shown(there)} where the job comes from"
    return ""


def sources_hash(folder: Path) -> str:
    """The SHA-256 of the Python files below a folder, and of their names."""
    digest = sha256()
    for path in sorted(folder.rglob("*.py")):
        digest.update(path.relative_to(folder).as_posix().encode() + b"\0" + path.read_bytes() + b"\0")
    return digest.hexdigest()


def _shown(what: object) -> str:
    return f"{what!s:.{SHOWN_CHARACTERS}}"
