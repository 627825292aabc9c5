"""The versions whose insides the simulator knows: those of `numba_internals`."""

from collections.abc import Mapping
from importlib.metadata import version

from packaging.specifiers import SpecifierSet

from mindrun.errors import MindError

# pyproject.toml asks for the same.
KNOWN: Mapping[str, str] = {"llvmlite": ">=0.46,<0.51", "numba": ">=0.63,<0.69"}


def refuse_unknown() -> None:
    """Raise MindError where a version is installed whose internals are not known here."""
    for name, known in KNOWN.items():
        found = version(name)
        if not SpecifierSet(known).contains(found, prereleases=True):
            raise MindError(f"{name} {found} is installed, and the simulator knows {known}", remedy(name))


def remedy(name: str) -> str:
    """The line that installs a version that is known."""
    return f"pip install '{name}{KNOWN[name]}'"
