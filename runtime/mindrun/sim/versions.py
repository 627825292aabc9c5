"""The versions whose insides the simulator knows: those of `numba_internals` and of `chipmunk_internals`."""

import re
from collections.abc import Mapping
from importlib.metadata import version

from mindrun.errors import MindError

# From the first to below the last; pyproject.toml asks for the same. Numba 0.62 has no `_reload_init` to link with.
KNOWN: Mapping[str, tuple[str, str]] = {"llvmlite": ("0.46", "0.51"), "numba": ("0.63", "0.69"), "pymunk": ("7.2", "8")}


def refuse_unknown() -> None:
    """MindError where a version is installed whose insides nobody has looked at."""
    for name, (first, last) in KNOWN.items():
        found = version(name)
        if not _numbers(first) <= _numbers(found) < _numbers(last):
            message = f"{name} {found} is installed, and the simulator knows {first} to below {last}"
            raise MindError(message, remedy(name))


def remedy(name: str) -> str:
    """What to install."""
    first, last = KNOWN[name]
    return f"pip install '{name}>={first},<{last}'"


def _numbers(text: str) -> tuple[int, ...]:
    return tuple(int(digits) for digits in re.findall(r"\d+", text)[:3])
