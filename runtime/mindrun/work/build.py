"""What a worker's results depend on beside its job: our sources, and the versions of what they compute with."""

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
    found = {"mindrun": _sources(), "python": f"{major}.{minor}"}
    for package in PACKAGES:
        try:
            found[package] = version(package)
        except PackageNotFoundError:
            found[package] = "none"
    return found


def difference(asked: object, own: Build) -> str:
    """How the build that a job is for differs from one's own, in words; nothing where it does not."""
    if not isinstance(asked, Mapping):
        return "the job does not say of which build it is"
    for name, here in own.items():
        there = asked.get(name)
        if there != here:
            return f"{name} is {_shown(here)} at the worker, and {_shown(there)} where the job comes from"
    return ""


def _sources() -> str:
    digest = sha256()
    for path in sorted(SOURCES.rglob("*.py")):
        digest.update(path.relative_to(SOURCES).as_posix().encode() + b"\0" + path.read_bytes() + b"\0")
    return digest.hexdigest()


def _shown(what: object) -> str:
    return f"{what!s:.{SHOWN_CHARACTERS}}"
