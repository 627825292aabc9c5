"""The checks, in the order in which they are told: each module has a `check` of what its first line says."""

from collections.abc import Iterator
from importlib import import_module

from mindlang.diagnosis.finding import Finding, State

ORDER = ("programs", "python", "machine", "packages", "machine_code", "viewer", "browser", "extras")


def findings() -> Iterator[Finding]:
    """What all checks have seen. One that fails is itself a finding: a broken package must not hide the others."""
    for name in ORDER:
        try:
            yield from import_module(f"{__name__}.{name}").check()
        except Exception as error:
            yield Finding(name.replace("_", " "), State.WRONG, f"{type(error).__name__}: {error}".split("\n")[0])
