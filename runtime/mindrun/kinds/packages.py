"""Installed packages that bring something of their own: found by entry points, named by version and hash, not run."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache
from hashlib import sha256
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from importlib.metadata import EntryPoint

KINDS = "mindlang.kinds"  # the group under which a package says its modules of kinds
REBUILD = "build the bundle again where that package is, or install that version here"


@cache
def entries() -> tuple[EntryPoint, ...]:
    """The modules of kinds of all packages, in the order of these."""
    from importlib.metadata import entry_points  # a command without a kind of one's own does not need it

    return tuple(sorted(entry_points(group=KINDS), key=lambda entry: (package(entry), entry.name)))


def package(entry: EntryPoint) -> str:
    """The name and version of the package of an entry point."""
    return f"{entry.dist.name} {entry.dist.version}" if entry.dist else entry.module


def package_digest(entry: EntryPoint) -> str:
    """The SHA-256 of the names and contents of all modules beside the one of an entry point."""
    digest = sha256()
    for name, content in _modules(entry.module.split(".")[0]):
        digest.update(f"{name} {sha256(content).hexdigest()}\n".encode())
    return digest.hexdigest()


def missing(wanted: str, digest: str) -> str:
    """Why the kinds of a package of this name, version and hash are not here, and what to do; empty where they are."""
    name = wanted.partition(" ")[0]
    found = [entry for entry in entries() if package(entry).partition(" ")[0] == name]
    if not found:
        return f"this mind needs {wanted}, which is not installed: pip install '{wanted.replace(' ', '==')}'"
    if wanted not in map(package, found):
        return f"this mind needs {wanted}, and {package(found[0])} is installed: {REBUILD}"
    if digest not in map(package_digest, found):
        return f"the code of {wanted} is not that with which this bundle was built: {REBUILD}"
    return ""


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
