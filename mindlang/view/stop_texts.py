"""Where breakpoints stop a run, as the page is told."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

from mindlang.view.texts import shown

if TYPE_CHECKING:
    from mindlang.breakpoints.watch import Stop


def stop_texts(stops: Iterable[Stop]) -> tuple[tuple[int, str], ...]:
    """The tick of each stop, and which line it is of."""
    return tuple((stop.tick, shown(f"line {stop.breakpoint.line}: {stop.breakpoint.text}")) for stop in stops)
