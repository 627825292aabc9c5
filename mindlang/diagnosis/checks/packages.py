"""The packages without which nothing runs, each in a version that is known."""

from collections.abc import Iterator

from mindlang.diagnosis.finding import Finding, State
from mindlang.diagnosis.requirements import requirements


def check() -> Iterator[Finding]:
    """One finding for each."""
    for each in requirements():
        if each.extra:
            continue
        if each.is_met:
            yield Finding(each.name, State.FINE, f"{each.installed}")
        else:
            seen = f"{each.installed}, and {each.bounds} is needed" if each.installed else "not installed"
            yield Finding(each.name, State.WRONG, seen, each.remedy)
