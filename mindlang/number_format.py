"""Numbers for reading: scores, rates, times."""

from math import isfinite
from typing import Any


def score(value: float | None, digits: int = 2) -> str:
    """A score in a summary or a picture; None where it is not a finite number."""
    return f"{value:,.{digits}f}" if value is not None else "not a number"


def finite(value: float) -> float | None:
    """The number itself; None, as JSON has no other word for it, where it is not finite."""
    return float(value) if isfinite(value) else None


def short_score(value: float | None) -> str:
    """A score in a line of progress; – where there is none yet, or it is not finite."""
    return f"{value:.2f}" if value is not None and isfinite(value) else "–"


def tick_count(ticks: float) -> str:
    """A number of ticks for reading: 300, 45.2 k, 44.8 M, 104.4 G."""
    for size, letter in ((1e9, "G"), (1e6, "M"), (1e3, "k")):
        if ticks >= size:
            return f"{ticks / size:.1f} {letter}"
    return f"{ticks:.0f}"


def rate(ticks_per_second: float, of: str = "") -> str:
    """A number of ticks per second for reading, or of what else they are per."""
    per = f" ticks per {of}" if of else " ticks/s"
    if ticks_per_second >= 1e6:
        return f"{ticks_per_second / 1e6:.1f} M{per}"
    return f"{ticks_per_second / 1e3:.0f} k{per}"


def speed(found: dict[str, Any]) -> str:
    """The ticks per second of processor time, the same on a busy machine, or of the clock where that is not known."""
    cpu = found.get("ticks_per_cpu_second")
    return rate(found["ticks_per_second"]) if cpu is None else rate(cpu, "CPU second")


def duration(seconds: float) -> str:
    """A time for reading: 8 s, 2 min 5 s, 3 h 12 min."""
    whole = round(seconds)
    hours, minutes = whole // 3600, whole // 60 % 60
    if hours:
        return f"{hours} h {minutes} min"
    return f"{minutes} min {whole % 60} s" if minutes else f"{whole} s"
