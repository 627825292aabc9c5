"""mindc and mindrun: which they are, and that both are of one version."""

from collections.abc import Iterator
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

import mindrun

import mindlang
from mindlang.diagnosis.finding import Finding, State


def check() -> Iterator[Finding]:
    """One finding for each program."""
    place = Path(mindlang.__file__).parent
    try:
        known = version("mindlang")
    except PackageNotFoundError:
        known = ""
        yield Finding("mindc", State.WRONG, f"in {place}, not installed as a package", "pip install .")
    else:
        yield Finding("mindc", State.FINE, f"{known}, in {place}")
    runtime = f"{mindrun.VERSION}, in {Path(mindrun.__file__).parent}"
    if known and known != mindrun.VERSION:
        mend = "pip uninstall mindrun mindlang, then pip install mindlang, which brings mindrun along"
        yield Finding("mindrun", State.WRONG, f"{runtime}; mindc is {known}", mend)
    elif _has_own_package():
        yield Finding("mindrun", State.WRONG, f"{runtime}, and installed by itself as well", "pip uninstall mindrun")
    else:
        yield Finding("mindrun", State.FINE, runtime)


def _has_own_package() -> bool:
    try:
        version("mindrun")
    except PackageNotFoundError:
        return False
    return True
