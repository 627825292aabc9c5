"""The extras: what not everybody needs."""

from collections.abc import Iterator

from mindlang.diagnosis.finding import Finding, State
from mindlang.diagnosis.requirements import Requirement, extras

LISTED_PACKAGES = 3  # of an extra; of more only their number is told


def check() -> Iterator[Finding]:
    """One finding for each extra."""
    for extra, needed in extras():
        if missing := [_wanted(each) for each in needed if not each.is_met]:
            seen = f"without {', '.join(missing)}"
            yield Finding(f"[{extra}]", State.ABSENT, seen, f"pip install 'mindlang[{extra}]'")
        elif len(needed) > LISTED_PACKAGES:
            yield Finding(f"[{extra}]", State.FINE, f"all {len(needed)} packages")
        else:
            yield Finding(f"[{extra}]", State.FINE, ", ".join(f"{each.name} {each.installed}" for each in needed))


def _wanted(package: Requirement) -> str:
    return package.name if package.installed is None else f"{package.name}{package.bounds}"
