"""Python: a version for which mind is made."""

import platform
import sys
from collections.abc import Iterator
from importlib.metadata import metadata

from mindlang.diagnosis.finding import Finding, State
from mindlang.diagnosis.requirements import parsed


def check() -> Iterator[Finding]:
    """One finding."""
    bounds = parsed(f"python{metadata('mindlang')['Requires-Python'] or ''}")
    found = platform.python_version()
    if bounds.admits(found):
        yield Finding("Python", State.FINE, f"{found}, {sys.executable}")
    else:
        mend = f"python3 -m venv .venv with a Python {bounds.bounds}, and install mind there"
        yield Finding("Python", State.WRONG, f"{found}, and mind is made for {bounds.bounds}", mend)
