"""Where a run stopped, as plain data and for reading."""

from collections.abc import Sequence
from math import isfinite
from typing import Any

from rich.text import Text

from mindlang.breakpoints.watch import Stop


def stopped_data(stops: Sequence[Stop], file: str, tick_seconds: float) -> dict[str, Any] | None:
    """The first tick of a run in which lines of the file stop it, and which lines; None where none does."""
    if not stops:
        return None
    tick = stops[0].tick
    return {
        "tick": tick,
        "seconds": tick * tick_seconds,
        "by": [
            {
                "file": file,
                "line": stop.breakpoint.line,
                "text": stop.breakpoint.text,
                "values": {name: value if isfinite(value) else None for name, value in stop.values},
            }
            for stop in stops
            if stop.tick == tick
        ],
    }


def stop_summary(stopped: dict[str, Any] | None) -> Text:
    """Where a run stopped, and the values that made the lines true."""
    if stopped is None:
        return Text("stopped nowhere\n")
    found = Text.assemble(("stopped", "bold"), f" in tick {stopped['tick']:,}, after {stopped['seconds']:.2f} s\n")
    for each in stopped["by"]:
        found.append(f"{each['file']}:{each['line']}: {each['text']}\n")
        values = (f"{name} {'nan' if value is None else f'{value:g}'}" for name, value in each["values"].items())
        found.append("".join(f"  {value}\n" for value in values), "dim")
    return found
